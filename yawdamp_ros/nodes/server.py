"""Serves a simulator by a steady clock, services and parameters."""

import time
from dataclasses import replace

from diagnostic_msgs.msg import DiagnosticArray
from rcl_interfaces.msg import SetParametersResult
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_srvs.srv import SetBool, Trigger

from yawdamp_ros.analysis import least_damping_ratio
from yawdamp_ros.errors import YawdampError
from yawdamp_ros.nodes.diagnostics import Diagnosis, InputReading, Readings
from yawdamp_ros.nodes.errors import NodeError
from yawdamp_ros.nodes.neighbours import Neighbours
from yawdamp_ros.nodes.parameters import changed
from yawdamp_ros.nodes.sim import Simulator
from yawdamp_ros.nodes.states import RecorderState, Reply, answer
from yawdamp_ros.nodes.subscriptions import STEADY, WARNING_PERIOD
from yawdamp_ros.runs.run_writer import QUEUE_DEPTH
from yawdamp_ros.stepping import Pacer
from yawdamp_ros.stepping.pacer import CATCH_UP_NS
from yawdamp_ros.stepping.time_grid import SECOND, nanoseconds

DIAGNOSTICS_PERIOD = 1.0
"""Period of the diagnostics in real time [s]."""


class Server:
    """Advances a simulator by the steady clock, and serves its services and parameters.

    Parameters
    ----------
    node : Node
    simulator : Simulator
        Simulator whose first sample is published.

    Attributes
    ----------
    steps_dropped : int
        Number of steps too late to be caught up.
    """

    def __init__(self, node: Node, simulator: Simulator) -> None:
        self._node = node
        self._simulator = simulator
        self.steps_dropped = 0
        self._worst_lateness = 0.0
        self._loss_said = 0
        self._silence_said = False
        self._silent: set[str] = set()
        self._tells_speed = False
        self._diagnosis = Diagnosis(
            node.get_fully_qualified_name(),
            simulator.motion.vehicle.name,
            node.resolve_topic_name(simulator.steering_topic),
        )
        self._diagnostics = node.create_publisher(DiagnosticArray, "/diagnostics", QUEUE_DEPTH)
        self._guard = guard = simulator.guard
        self._neighbours = Neighbours(node, simulator.input_topics, simulator.topics.names)
        node.add_on_set_parameters_callback(self._check_parameters)
        node.add_post_set_parameters_callback(self._use_parameters)
        node.create_service(Trigger, "~/reset", guard(self._on_reset))
        node.create_service(SetBool, "~/pause", guard(self._on_pause))
        node.create_service(Trigger, "~/step", guard(self._on_step))
        node.create_service(SetBool, "~/record", guard(self._on_record))
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        node.create_timer(DIAGNOSTICS_PERIOD, guard(self._diagnose), clock=steady)
        self._looked_at = time.monotonic_ns()
        # The pacer is made before the timer, so that a period is over when the timer fires.
        rate = simulator.settings.real_time_factor
        # Half of the time that is caught up: a slower start shows as a jump of the stamps.
        since = max(simulator.started_at, time.monotonic_ns() - CATCH_UP_NS // 2)
        self._pacer = Pacer(simulator.grid.period_ns, rate, since)
        self._waiting = simulator.settings.wait_for_command
        if self._waiting or simulator.settings.start_paused:
            self._pacer.pause(time.monotonic_ns())
            awaited = "the first command" if self._waiting else "~/pause or ~/step"
            node.get_logger().info(f"time stands until {awaited} comes")
        self._timer = node.create_timer(self._timer_period(), guard(self._on_timer), clock=steady)

    def _on_timer(self) -> None:
        now = time.monotonic_ns()
        if self._waiting and self._simulator.commands.commanded:
            self._waiting = False
            self._pacer.resume(now)
        clock = ros_time(now)
        due = self._pacer.due(now)
        self._worst_lateness = max(self._worst_lateness, due.lateness / SECOND)
        if due.dropped:
            self.steps_dropped += due.dropped * self._simulator.grid.steps_per_sample
            self._node.get_logger().warning(
                f"late by more than can be caught up: {self.steps_dropped} steps dropped so far",
                throttle_duration_sec=WARNING_PERIOD,
                throttle_time_source_type=STEADY,
            )
        # Due time of the first sample; the others follow on the grid.
        first_due = None if clock is None else clock - round(due.lateness)
        for index in range(due.periods):
            if self._simulator.finished:
                self._timer.cancel()
                break
            self._simulator.advance(None if index else first_due)

    def _timer_period(self) -> float:
        rate = self._simulator.settings.real_time_factor
        return self._simulator.grid.period_ns / SECOND / rate if rate else 0.0

    def _check_parameters(self, parameters: list[Parameter]) -> SetParametersResult:
        if self._tells_speed:
            return SetParametersResult(successful=True)
        try:
            changed(self._simulator.settings, parameters)
        except NodeError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _use_parameters(self, parameters: list[Parameter]) -> None:
        if self._tells_speed:
            return
        before = self._simulator.settings
        self._simulator.change(changed(before, parameters))
        rate = self._simulator.settings.real_time_factor
        if rate != before.real_time_factor:
            self._pacer.change_rate(rate, time.monotonic_ns())
            self._timer.timer_period_ns = nanoseconds(self._timer_period())

    def _on_reset(self, _request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        self._simulator.commands.reset()
        response.success = True
        response.message = answer(Reply.RESET, "at the start from the next step on")
        return response

    def _on_pause(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        self._waiting = False
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
        run = self._simulator.run
        response.success = self._pacer.paused and not self._simulator.finished
        if response.success:
            for index in range(self._simulator.settings.step_samples):
                if self._simulator.finished:
                    break
                self._simulator.advance(None if index else time.time_ns())
            response.success = run.stopped is None
            response.message = (
                answer(Reply.STOPPED, run.stopped.reason)
                if run.stopped
                else answer(Reply.STEPPED, f"simulated time {run.time:.9g} s")
            )
        elif self._simulator.finished:
            response.message = answer(Reply.STOPPED, "the run is over")
        else:
            response.message = answer(Reply.NOT_PAUSED, "call ~/pause first")
        return response

    def _on_record(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        recorder = self._simulator.recorder
        try:
            if request.data:
                self._simulator.start_recording(numbered=True)
                self._node.get_logger().info(f"recording to {recorder.directory}")
            else:
                recorder.stop()
        except YawdampError as error:
            response.success, response.message = False, answer(RecorderState.FAILED, str(error))
            return response
        response.success = recorder.failure is None
        response.message = answer(recorder.state, recorder.detail)
        return response

    def _diagnose(self) -> None:
        now = time.monotonic_ns()
        elapsed, self._looked_at = (now - self._looked_at) / SECOND, now
        self._diagnostics.publish(self._diagnosis.of(self._readings(), elapsed, time.time_ns()))
        self._worst_lateness = 0.0
        if self._pacer.paused and self._simulator.run.samples == 1:
            # A controller that waits for a sample before its first command would wait for ever.
            self._simulator.topics.repeat()
        self._tell_silence()
        self._tell_speed()
        recorder = self._simulator.recorder
        if recorder.lost > self._loss_said:
            self._loss_said = recorder.lost
            reason = recorder.failure or "the disk does not keep up"
            self._node.get_logger().error(
                f"{reason}; {self._loss_said} messages not recorded, the simulation goes on",
                throttle_duration_sec=WARNING_PERIOD,
                throttle_time_source_type=STEADY,
            )

    def _tell_silence(self) -> None:
        """Log each steering timeout once."""
        simulator = self._simulator
        silent = simulator.commands.steering_input.timed_out(simulator.motion.step)
        if silent and not self._silence_said:
            settings = simulator.settings
            becomes = "returned to zero" if settings.on_steering_timeout == "zero" else "held"
            self._node.get_logger().warning(
                f"steering: no command for {settings.steering_timeout:g} s; the last one is {becomes}"
            )
        self._silence_said = silent
        inputs = set(simulator.commands.silent)
        for name in sorted(inputs - self._silent):
            timeout = simulator.settings.steering_timeout
            self._node.get_logger().warning(f"{name}: no command for {timeout:g} s; the last one is held")
        self._silent = inputs

    def _tell_speed(self) -> None:
        """Set the parameter to the speed in force."""
        speed = self._simulator.motion.speed
        if (
            self._simulator.settings.longitudinal_source != "parameter"
            and self._node.get_parameter("speed").value != speed
        ):
            self._tells_speed = True
            self._node.set_parameters([Parameter("speed", value=speed)])
            self._tells_speed = False
            self._simulator.change(replace(self._simulator.settings, speed=speed))

    def _readings(self) -> Readings:
        simulator = self._simulator
        settings, motion, commands = simulator.settings, simulator.motion, simulator.commands
        steering, recorder = commands.steering_input, simulator.recorder
        silence = steering.steps_since_command(motion.step)
        silent = commands.silent
        return Readings(
            samples=simulator.run.samples,
            rate_wanted=settings.publish_rate * settings.real_time_factor,
            worst_lateness=self._worst_lateness,
            steps_dropped=self.steps_dropped,
            simulated_time=simulator.run.time,
            paused=self._pacer.paused,
            steering_age=None if silence is None else simulator.grid.seconds(silence),
            steering_timed_out=steering.timed_out(motion.step),
            manoeuvre="" if settings.manoeuvre == "none" else settings.manoeuvre,
            commands=dict(steering.counts),
            inputs={
                name: InputReading(
                    held.value,
                    None
                    if (since := held.steps_since_command(motion.step)) is None
                    else simulator.grid.seconds(since),
                    dict(held.counts),
                    timed_out=name in silent,
                )
                for name, held in commands.held.items()
            },
            neighbourhood=self._neighbours.look(),
            recorder=recorder.state,
            recorder_detail=recorder.detail,
            messages_lost=recorder.lost,
            least_damping_ratio=least_damping_ratio(motion.linearise()),
            beyond="" if (beyond := simulator.range.look()) is None else beyond.reason,
            speed=motion.speed,
            callback_failures=self._guard.failures,
            events=tuple(
                f"{event.name} of {event.where} at {simulator.grid.seconds(event.step):g} s"
                for event in simulator.run.events
            ),
        )


def ros_time(now: int) -> int | None:
    """System time at a steady time of just now [ns]; None if the process was held up in between."""
    clock = time.time_ns()
    return clock if time.monotonic_ns() - now < SECOND // 1000 else None
