"""The simulator of a node: a timer, fixed steps, messages out."""

import time
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray
from rcl_interfaces.msg import SetParametersResult
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_srvs.srv import SetBool, Trigger

from yawdamp_ros.analysis import growth, least_damping_ratio
from yawdamp_ros.analysis.peaks import Peaks
from yawdamp_ros.dynamics import linear_model
from yawdamp_ros.errors import YawdampError
from yawdamp_ros.logs import RunWriter, default_run_directory, make_run_directory
from yawdamp_ros.manoeuvres import make_manoeuvre
from yawdamp_ros.nodes.diagnostics import Diagnosis, Readings
from yawdamp_ros.nodes.errors import NodeError
from yawdamp_ros.nodes.messages import INPUT_TYPES
from yawdamp_ros.nodes.neighbours import Neighbours
from yawdamp_ros.nodes.outputs import Outputs
from yawdamp_ros.nodes.parameters import changed, declare_parameters
from yawdamp_ros.nodes.recorder import Recorder
from yawdamp_ros.nodes.recording import open_run, run_messages
from yawdamp_ros.nodes.states import RecorderState, Reply, answer
from yawdamp_ros.nodes.subscriptions import STEADY, SteeringSubscription, subscribe_speed
from yawdamp_ros.simulation.settings import SimParameters
from yawdamp_ros.stepping import (
    Pacer,
    Sample,
    SpeedInput,
    SteeringActuator,
    SteeringInput,
    Stepper,
    TimeGrid,
    meaningless,
)
from yawdamp_ros.stepping.time_grid import SECOND, nanoseconds
from yawdamp_ros.vehicle import VehicleSource, parse_vehicle, vehicle_text

WARNING_PERIOD = 5.0
"""Seconds between warnings of one kind."""
DIAGNOSTICS_PERIOD = 1.0
"""Seconds of real time."""


class Simulator:
    """Steps the model as the steady clock asks for, and publishes and records every sample.

    Parameters
    ----------
    node : Node
        What it declares its parameters on, listens by and publishes by.

    Raises
    ------
    YawdampError
        If a parameter, the vehicle or the run directory cannot be used.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self.settings = declare_parameters(node)
        # Read once: the file may change or go while the node runs, but its vehicle does not.
        changes = tuple(change for change in self.settings.vehicle_overrides if change)
        self._source = VehicleSource(vehicle_text(self.settings.vehicle), changes)
        self.model = linear_model(
            parse_vehicle(self._source.text, self.settings.vehicle, changes),
            self.settings.speed or None,
            self.settings.model,
        )
        self.grid = TimeGrid.of(self.settings.step_size, 1.0 / self.settings.publish_rate)
        self.peaks = Peaks(len(self.model.vehicle.units))
        self.steps_given_up = 0
        self.samples_published = 0
        self.stopped = ""
        self._worst_lateness = 0.0
        self._reset_wanted = False
        self._loss_said = 0
        self._stepper = Stepper(self.model, self.grid.step_size)
        self._speed = SpeedInput(self.model.speed)
        self._input = SteeringInput(ratio=self.settings.steering_ratio, **_of_input(self.settings, self.grid))
        self._actuator = SteeringActuator(
            self.grid.step_size,
            self.settings.steering_time_constant,
            self.settings.steering_rate_limit,
        )
        self._subscription: SteeringSubscription | None = None
        self._command = self._command_source()
        if self.settings.speed_source == "topic":
            subscribe_speed(node, self._speed)
        self._outputs = Outputs(node, self.model.vehicle, self.settings)
        self._start_time = time.time_ns()
        self.recorder = Recorder(self._open_run)
        if self.settings.record:
            self.recorder.start(self._new_directory(numbered=not self.settings.record_directory))

    @property
    def finished(self) -> bool:
        """Whether the run has lasted as long as it was to, or was stopped before."""
        duration = self.settings.duration
        lasted = bool(duration) and self.samples_published > self.grid.samples_in(duration)
        return lasted or bool(self.stopped)

    @property
    def flawless(self) -> bool:
        """Whether the run was not stopped and everything was recorded that was to be."""
        return not (self.stopped or self.recorder.lost or self.recorder.failure)

    @property
    def simulated_time(self) -> float:
        """Simulated time since the start in s."""
        return self.grid.seconds(self._stepper.step)

    def publish_first(self) -> None:
        """Publish the first sample, then say what there is to be said: rclpy's first word takes long.

        It is at rest under the steering of the manoeuvre, or none: a command that has come by then acts from
        the first step on, so that runs begin alike however long the start takes.
        """
        self._stepper.steer(self._angle(step=0))
        self._publish(self._stepper.sample())
        if growing := growth(self.model):
            self._node.get_logger().warning(growing)
        if self.recorder.directory is not None:
            self._node.get_logger().info(f"recording to {self.recorder.directory}")
        if self.settings.publish_tf and self._outputs.without_tf:
            self._node.get_logger().info(f"no frames on /tf: {self._outputs.without_tf}")
        if self._node.get_parameter("use_sim_time").value:
            self._node.get_logger().warning("use_sim_time: not followed, for this node makes the time")

    def start(self) -> None:
        """Begin to serve: from now on the steady clock counts."""
        # The pacer comes before the timer, so that a period is over whenever the timer fires.
        self._pacer = Pacer(self.grid.period_ns, self.settings.real_time_factor, time.monotonic_ns())
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = self._node.create_timer(self._timer_period(), self._on_timer, clock=steady)
        self._node.add_on_set_parameters_callback(self._check_parameters)
        self._node.add_post_set_parameters_callback(self._use_parameters)
        self._node.create_service(Trigger, "~/reset", self._on_reset)
        self._node.create_service(SetBool, "~/pause", self._on_pause)
        self._node.create_service(Trigger, "~/step", self._on_step)
        self._node.create_service(SetBool, "~/record", self._on_record)
        self._diagnosis = Diagnosis(self._node.get_fully_qualified_name(), self.model.vehicle.name)
        self._diagnostics = self._node.create_publisher(DiagnosticArray, "/diagnostics", 10)
        self._neighbours = Neighbours(self._node, ("steering", "speed"), self._outputs.topics)
        self._looked_at = time.monotonic_ns()
        self._node.create_timer(DIAGNOSTICS_PERIOD, self._diagnose, clock=steady)

    def close(self) -> None:
        """Finish the recording and let subscribers have what was published."""
        self.recorder.stop()
        if self.recorder.lost or self.recorder.failure is not None:
            reason = f"{self.recorder.failure}; " if self.recorder.failure is not None else ""
            self._node.get_logger().error(f"{reason}{self.recorder.lost} messages not recorded")
        if self._node.context.ok():
            self._outputs.close()

    def _on_timer(self) -> None:
        due = self._pacer.due(time.monotonic_ns())
        self._worst_lateness = max(self._worst_lateness, due.lateness / SECOND)
        if due.given_up:
            self.steps_given_up += due.given_up * self.grid.steps_per_sample
            self._node.get_logger().warning(
                f"late by more than can be made up for: {self.steps_given_up} steps given up so far",
                throttle_duration_sec=WARNING_PERIOD,
                throttle_time_source_type=STEADY,
            )
        for _ in range(due.periods):
            self._advance()

    def _advance(self) -> None:
        if self.finished:
            self._timer.cancel()
        else:
            self._publish(self._step(self.grid.steps_per_sample))

    def _publish(self, sample: Sample) -> None:
        limits = self.settings.max_lateral_acceleration, self.settings.max_articulation
        if wrong := meaningless(sample, self.model.vehicle.unit_names, *limits):
            self.stopped = f"{wrong}, where the linear model means nothing"
            self._node.get_logger().error(f"stopped at {self.simulated_time:g} s: {self.stopped}")
            return
        stamp = self._stamp(self._stepper.step)
        serialised = self._outputs.publish(sample, stamp)
        self.samples_published += 1
        self.peaks.update(sample)
        if self.recorder.recording:
            self.recorder.offer(run_messages(sample, [serialised], self.grid, self._start_time))

    def _step(self, steps: int) -> Sample:
        """Take steps, with what came in since the last of them acting from the first of these on."""
        stepper = self._stepper
        if self._subscription is not None:
            self._subscription.take()
        if self._reset_wanted or self._speed.speed != stepper.model.speed:
            stepper.advance()
            if self._reset_wanted:
                stepper.reset()
                self._reset_wanted = False
            stepper.change_speed(self._speed.speed)
            stepper.steer(self._angle(stepper.step))
            if steps == 1:
                return stepper.sample()
            steps -= 1
        return stepper.run([self._angle(step) for step in range(stepper.step + 1, stepper.step + 1 + steps)])

    def _angle(self, step: int) -> float:
        return self._actuator.follow(self._command(step))

    def _stamp(self, step: int) -> int:
        return self._start_time + step * self.grid.step_ns

    def _now(self) -> int:
        """Time that the stamps of commands are held against: what their senders' clock shows."""
        if self.settings.publish_clock:
            return self._stamp(self._stepper.step)
        return time.time_ns()

    def _timer_period(self) -> float:
        rate = self.settings.real_time_factor
        return self.grid.period_ns / SECOND / rate if rate else 0.0

    def _command_source(self) -> Callable[[int], float]:
        if self.settings.manoeuvre != "none":
            manoeuvre = make_manoeuvre(self.settings.manoeuvre, self.settings.manoeuvre_settings)
            return lambda step: manoeuvre(self.grid.seconds(step))
        self._subscription = SteeringSubscription(
            self._node,
            self.settings.steering_type,
            self.settings.steering_joint,
            self._input,
            step=lambda: self._stepper.step,
            now=self._now,
        )
        return self._input.at

    def _check_parameters(self, parameters: list[Parameter]) -> SetParametersResult:
        try:
            changed(self.settings, parameters)
        except NodeError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _use_parameters(self, parameters: list[Parameter]) -> None:
        before, self.settings = self.settings, changed(self.settings, parameters)
        if self.settings.speed != before.speed:
            self._speed.speed = self.settings.speed or self.model.vehicle.speed
        for name, value in _of_input(self.settings, self.grid).items():
            setattr(self._input, name, value)
        if self.settings.real_time_factor != before.real_time_factor:
            self._pacer.change_rate(self.settings.real_time_factor, time.monotonic_ns())
            self._timer.timer_period_ns = nanoseconds(self._timer_period())

    def _on_reset(self, _request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        self._reset_wanted = True
        response.success = True
        response.message = answer(Reply.RESET, "at rest at the origin from the next step on")
        return response

    def _on_pause(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        if request.data:
            self._pacer.pause(time.monotonic_ns())
        else:
            self._pacer.resume(time.monotonic_ns())
        response.success = True
        response.message = (
            answer(Reply.PAUSED, "time stands") if request.data else answer(Reply.RUNNING, "time goes on")
        )
        return response

    def _on_step(self, _request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        response.success = self._pacer.paused and not self.finished
        if response.success:
            self._advance()
            response.success = not self.stopped
            response.message = (
                answer(Reply.STOPPED, self.stopped)
                if self.stopped
                else answer(Reply.STEPPED, f"simulated time {self.simulated_time:.9g} s")
            )
        elif self.finished:
            response.message = answer(Reply.STOPPED, "the run is over")
        else:
            response.message = answer(Reply.NOT_PAUSED, "call ~/pause first")
        return response

    def _on_record(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        try:
            if request.data:
                self.recorder.start(self._new_directory(numbered=True))
                self._node.get_logger().info(f"recording to {self.recorder.directory}")
            else:
                self.recorder.stop()
        except YawdampError as error:
            response.success, response.message = False, answer(RecorderState.FAILED, str(error))
            return response
        response.success = self.recorder.failure is None
        response.message = answer(self.recorder.state, self.recorder.detail)
        return response

    def _new_directory(self, *, numbered: bool) -> Path:
        wanted = self.settings.record_directory or default_run_directory(self.model.vehicle.name)
        return make_run_directory(Path(wanted), numbered=numbered)

    def _open_run(self, directory: Path) -> RunWriter:
        return open_run(
            directory,
            self._outputs.messages,
            self._stepper,
            self.grid,
            start_time=self._start_time,
            parameters=asdict(self.settings),
            vehicle=self._source,
            topics=[*(self._node.resolve_topic_name(name) for name in INPUT_TYPES), *self._outputs.topics],
        )

    def _diagnose(self) -> None:
        now = time.monotonic_ns()
        elapsed, self._looked_at = (now - self._looked_at) / SECOND, now
        silence = self._input.silence(self._stepper.step)
        readings = Readings(
            samples=self.samples_published,
            rate_wanted=self.settings.publish_rate * self.settings.real_time_factor,
            worst_lateness=self._worst_lateness,
            steps_dropped=self.steps_given_up,
            simulated_time=self.simulated_time,
            paused=self._pacer.paused,
            steering_age=None if silence is None else self.grid.seconds(silence),
            steering_timed_out=self._input.timed_out(self._stepper.step),
            manoeuvre="" if self._subscription is not None else self.settings.manoeuvre,
            commands=dict(self._input.counts),
            speeds=dict(self._speed.counts),
            neighbourhood=self._neighbours.look(),
            recorder=self.recorder.state,
            recorder_detail=self.recorder.detail,
            messages_lost=self.recorder.lost,
            least_damping_ratio=least_damping_ratio(self._stepper.model),
            speed=self._stepper.model.speed,
        )
        self._worst_lateness = 0.0
        if self.recorder.lost > self._loss_said:
            self._loss_said = self.recorder.lost
            reason = self.recorder.failure or "the disk does not keep up"
            self._node.get_logger().error(
                f"{reason}; {self._loss_said} messages not recorded, the simulation goes on",
                throttle_duration_sec=WARNING_PERIOD,
                throttle_time_source_type=STEADY,
            )
        self._diagnostics.publish(self._diagnosis.of(readings, elapsed, time.time_ns()))


def _of_input(settings: SimParameters, grid: TimeGrid) -> dict[str, Any]:
    """What of the settings a `SteeringInput` goes by while running."""
    return {
        "limit": settings.max_steering_angle,
        "timeout_steps": nanoseconds(settings.steering_timeout) // grid.step_ns,
        "zero_on_timeout": settings.on_steering_timeout == "zero",
        "max_age": settings.max_steering_age,
    }
