"""The simulator of a node: a run whose samples are published and recorded."""

import time
from dataclasses import replace
from pathlib import Path

from rclpy.node import Node

from yawdamp_ros.analysis import growth
from yawdamp_ros.analysis.peaks import Peaks
from yawdamp_ros.nodes.guard import Guard
from yawdamp_ros.nodes.outputs import Topics
from yawdamp_ros.nodes.parameters import declare_derived, declare_parameters
from yawdamp_ros.nodes.recorder import Recorder
from yawdamp_ros.nodes.subscriptions import InputSubscription, SteeringSubscription
from yawdamp_ros.runs import default_run_directory, make_run_directory
from yawdamp_ros.runs.encoder import Encoder
from yawdamp_ros.runs.recipe import Recipe
from yawdamp_ros.simulation import Commands, Limits, LinearRange, Run, SimParameters, Sink, Stop, make_motion
from yawdamp_ros.stepping import Sample, TimeGrid
from yawdamp_ros.vehicle import examined_vehicle, vehicle_source


class Simulator:
    """A run that a node's topics drive, and whose samples it publishes and records.

    Parameters
    ----------
    node : Node
        Node with the parameters, the subscriptions and the publishers.

    Raises
    ------
    YawdampError
        If a parameter, the vehicle or the run directory cannot be used.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self.guard = Guard(node)
        self.settings = settings = declare_parameters(node)
        # Read once: the file may change or go while the node runs, but its vehicle does not.
        changes = tuple(change for change in settings.vehicle_overrides if change)
        source = vehicle_source(settings.vehicle, changes)
        vehicle, doubts = examined_vehicle(source.text, settings.vehicle, source.overrides)
        self._doubts = doubts
        self.grid = TimeGrid.of(settings.step_size, 1.0 / settings.publish_rate)
        self.motion = make_motion(
            vehicle, settings.model, settings.first_speed, self.grid.step_size, settings.first_pose
        )
        speed = self.motion.speed if settings.speed is None else settings.speed
        self.settings = settings = replace(settings, speed=speed, initial_speed=self.motion.speed)
        declare_derived(
            node, {"speed": speed, "initial_speed": self.motion.speed, "publish_clock": settings.clock}
        )
        self.model = self.motion.linearise()
        self.commands = Commands(settings, self.grid, self.motion)
        self.steering_topic = "steering"
        others = list(self.commands.held)
        self._subscriptions: list[SteeringSubscription | InputSubscription] = []
        if settings.autoware:
            # Imported here: few need it.
            from yawdamp_ros.nodes import autoware  # noqa: PLC0415

            self.steering_topic = autoware.CONTROL
            if "gear" in others:
                others.remove("gear")
                self._subscriptions.append(autoware.gear_subscription(node, self.commands, self.guard))
        self._subscriptions += [InputSubscription(node, name, self.commands, self.guard) for name in others]
        if settings.manoeuvre == "none":
            steering = SteeringSubscription(
                node,
                settings.steering_type,
                settings.steering_joint,
                self.commands,
                now=self._now,
                guard=self.guard,
                topic=self.steering_topic,
            )
            self._subscriptions.append(steering)
        # Time stamps and the pace of the samples are counted from one instant.
        self.started_at, start_time = time.monotonic_ns(), time.time_ns()
        self._encoder = encoder = Encoder(self.motion, settings, self.grid, start_time)
        self.topics = Topics(node, vehicle, encoder, settings, events=bool(self.motion.quantity_names))
        recipe = Recipe(
            self.motion,
            self.grid,
            settings,
            source,
            stamps=encoder.stamps,
            types=encoder.types,
            frames=encoder.frames,
            sensors=encoder.sensors,
            resolve=node.resolve_topic_name,
        )
        self.recorder = Recorder(lambda directory: recipe.open(directory, self.settings))
        encoder.sinks += [self.topics, self.recorder]
        if settings.autoware:
            world = settings.world_frame or "map"
            encoder.sinks.append(autoware.AutowareStatus(node, vehicle.units[0], self.commands, world))
        self.peaks = Peaks(len(vehicle.units))
        self.range = LinearRange(vehicle.unit_names, Limits.warning(settings), self._tell_range)
        sinks: list[Sink] = [encoder, self.peaks, self.range, _EventLog(node, self.grid)]
        self.run = Run(self.motion, self.grid, self.commands, sinks, Limits.of(settings))
        if settings.record:
            self.start_recording(numbered=not settings.record_directory)

    @property
    def input_topics(self) -> list[str]:
        """Topics of all inputs, as the node subscribes to them."""
        return [subscription.topic for subscription in self._subscriptions]

    @property
    def finished(self) -> bool:
        """True if the run has reached its duration or was stopped before."""
        duration = self.settings.duration
        lasted = bool(duration) and self.run.samples > self.grid.samples_in(duration)
        return lasted or self.run.stopped is not None

    @property
    def flawless(self) -> bool:
        """True if the run was not stopped and recorded everything."""
        return not (self.run.stopped or self.recorder.lost or self.recorder.failure)

    def publish_first(self) -> None:
        """Publish the first sample, then log: rclpy's first log message takes long.

        It is at rest under the steering of the manoeuvre, or none: a command that has come by then acts from
        the first step on, so that runs begin alike however long the start takes.
        """
        self.run.start()
        self._tell_stop()
        for doubt in self._doubts:
            self._node.get_logger().warning(doubt)
        if growing := growth(self.model):
            self._node.get_logger().warning(growing)
        if self.recorder.directory is not None:
            self._node.get_logger().info(f"recording to {self.recorder.directory}")
        if self.settings.publish_tf and self.topics.without_tf:
            self._node.get_logger().info(f"no frames on /tf, only in recordings: {self.topics.without_tf}")
        if self._node.get_parameter("use_sim_time").value:
            self._node.get_logger().warning("use_sim_time: not followed, for this node makes the time")

    def advance(self, clock: int | None) -> None:
        """Take a sample period with the pending commands, and publish its sample.

        Parameters
        ----------
        clock : int or None
            ROS time at which the sample is due [ns], which its stamp follows where there is no /clock.
        """
        if clock is not None and not self.topics.clock:
            self._encoder.follow(clock)
        for subscription in self._subscriptions:
            subscription.take()
        self.run.advance()
        self._tell_stop()

    def change(self, settings: SimParameters) -> None:
        """Apply other settings from now on."""
        self.settings = settings
        if settings.clock:
            self.topics.publish_clock()
        self.commands.change(settings)
        self.run.limits = Limits.of(settings)
        self.range.levels = Limits.warning(settings)

    def start_recording(self, *, numbered: bool) -> None:
        """Start a run on disk.

        Parameters
        ----------
        numbered : bool
            Whether a directory with a number behind its name will do where it exists.

        Raises
        ------
        LogError
            If there is no writing there.
        """
        wanted = self.settings.record_directory or default_run_directory(self.motion.vehicle.name)
        self.recorder.start(make_run_directory(Path(wanted), numbered=numbered))

    def close(self) -> None:
        """Finish the recording, and wait until subscribers have received all messages."""
        self.recorder.close()
        if self.recorder.lost or self.recorder.failure is not None:
            reason = f"{self.recorder.failure}; " if self.recorder.failure is not None else ""
            self._node.get_logger().error(f"{reason}{self.recorder.lost} messages not recorded")
        self.topics.close()

    def _tell_stop(self) -> None:
        if self.run.stopped is not None:
            self._encoder.tell(self.run.unwritten)
            self._node.get_logger().error(f"stopped at {self.run.time:g} s: {self.run.stopped.reason}")

    def _tell_range(self, beyond: Stop) -> None:
        time_ = self.grid.seconds(beyond.step)
        self._node.get_logger().warning(f"beyond the linear range from {time_:g} s: {beyond.reason}")

    def _now(self) -> int:
        """Time on the clock that the senders of commands can see."""
        if self.topics.clock:
            return self._encoder.stamps.of(self.motion.step)
        return time.time_ns()


class _EventLog:
    """Sink that logs the events of the vehicle."""

    def __init__(self, node: Node, grid: TimeGrid) -> None:
        self._node, self._grid = node, grid

    def write(self, sample: Sample) -> None:
        """Log the events before a sample."""
        for event in sample.events:
            time_ = self._grid.seconds(event.step)
            self._node.get_logger().warning(f"{event.name} of {event.where} at {time_:g} s")

    def close(self) -> None:
        """Do nothing: there is nothing to close."""
