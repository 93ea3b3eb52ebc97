"""The simulator node: a timer, fixed steps, messages out."""

import math
import time
from collections.abc import Callable, Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

from rclpy.clock import Clock, ClockType
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_msgs.msg import Float64
from std_srvs.srv import SetBool, Trigger

from yawdamp_ros.analysis.peaks import Peaks
from yawdamp_ros.dynamics import LinearModel, linear_model
from yawdamp_ros.logs import BackgroundWriter, default_run_directory
from yawdamp_ros.manoeuvres import SETTINGS, make_manoeuvre
from yawdamp_ros.nodes.errors import NodeError
from yawdamp_ros.nodes.messages import INPUT_TYPES, OutputMessages
from yawdamp_ros.nodes.parameters import SimParameters, declare_parameters
from yawdamp_ros.nodes.recording import open_run, run_messages
from yawdamp_ros.stepping import Pacer, SteeringInput, Stepper, TimeGrid
from yawdamp_ros.stepping.time_grid import SECOND
from yawdamp_ros.vehicle import VehicleSource, load_vehicle, vehicle_text

QUEUE_DEPTH = 10
CATCH_UP_NS = SECOND // 10
"""Longest delay that is made up for by steps in a burst; more is given up, and counted."""
WARNING_PERIOD = 5.0
"""Seconds between warnings of one kind."""


class SimNode(Node):
    """Steps the model as the steady clock asks for, and publishes and records every sample.

    Parameters
    ----------
    overrides : mapping of str to object
        Parameters that win over those of the command line's ``--ros-args``.

    Raises
    ------
    YawdampError
        If a parameter, the vehicle or the run directory cannot be used.
    """

    def __init__(self, overrides: Mapping[str, Any]) -> None:
        super().__init__(
            "yawdamp_sim",
            parameter_overrides=[Parameter(name, value=value) for name, value in overrides.items()],
        )
        self.settings = declare_parameters(self)
        self.model = _model(self.settings)
        self.grid = TimeGrid.of(self.settings.step_size, 1.0 / self.settings.publish_rate)
        self.peaks = Peaks(len(self.model.vehicle.units))
        self.steps_given_up = 0
        self.samples_published = 0
        self._stepper = Stepper(self.model, self.grid.step_size)
        self._input = SteeringInput(
            ratio=self.settings.steering_ratio,
            limit=self.settings.max_steering_angle,
            timeout_steps=int(self.settings.steering_timeout * SECOND) // self.grid.step_ns,
            zero_on_timeout=self.settings.on_steering_timeout == "zero",
        )
        self._steering = self._steering_source()
        self._outputs = OutputMessages(
            self.model.vehicle.unit_names, publish_scalars=self.settings.publish_scalars
        )
        self._output_publishers = [
            self.create_publisher(kind, topic, QUEUE_DEPTH) for topic, kind in self._outputs.types.items()
        ]
        self._new_speed: float | None = None
        self._reset_wanted = False
        self.add_post_set_parameters_callback(self._on_parameters)
        self.create_service(Trigger, "~/reset", self._on_reset)
        self.create_service(SetBool, "~/pause", self._on_pause)
        self.create_service(Trigger, "~/step", self._on_step)
        self._start_time = self.get_clock().now().nanoseconds
        self.recorder = self._open_recorder() if self.settings.record else None

    @property
    def samples_wanted(self) -> int | None:
        """Samples after which the run is over; None if it is not."""
        if not self.settings.duration:
            return None
        return 1 + self.grid.samples_in(self.settings.duration)

    @property
    def finished(self) -> bool:
        """Whether the run has lasted as long as it was to."""
        return self.samples_wanted is not None and self.samples_published >= self.samples_wanted

    @property
    def simulated_time(self) -> float:
        """Simulated time since the start in s."""
        return self.grid.seconds(self._stepper.step)

    def start(self) -> None:
        """Publish the first sample; from now on the steady clock counts."""
        self._publish(steps=0)
        period = self.grid.period_ns
        # The pacer comes before the timer, so that a period is over whenever the timer fires.
        self._pacer = Pacer(period, max(CATCH_UP_NS // period, QUEUE_DEPTH), time.monotonic_ns())
        self._timer = self.create_timer(
            period / SECOND,
            self._on_timer,
            clock=Clock(clock_type=ClockType.STEADY_TIME),
        )

    def close(self) -> None:
        """Finish the recording and let subscribers have what was published."""
        if self.recorder is not None:
            self.recorder.close()
            if self.recorder.failure is not None:
                self.get_logger().error(
                    f"{self.recorder.failure}; {self.recorder.lost} messages not recorded"
                )
        for publisher in self._output_publishers:
            publisher.wait_for_all_acked(Duration(seconds=1))

    def _on_timer(self) -> None:
        due = self._pacer.due(time.monotonic_ns())
        if due.given_up:
            self.steps_given_up += due.given_up * self.grid.steps_per_sample
            self.get_logger().warning(
                f"late by more than can be made up for: {self.steps_given_up} steps given up so far",
                throttle_duration_sec=WARNING_PERIOD,
            )
        for _ in range(due.periods):
            self._advance()

    def _advance(self) -> None:
        if self.finished:
            self._timer.cancel()
        else:
            self._publish(steps=self.grid.steps_per_sample)

    def _drive(self, stepper: Stepper) -> None:
        """Let what came in since the last step act from this step on."""
        if self._reset_wanted:
            stepper.reset()
            self._reset_wanted = False
        if self._new_speed is not None:
            stepper.change_speed(self._new_speed)
            self._new_speed = None
        stepper.steer(self._steering(stepper.step))

    def _publish(self, steps: int) -> None:
        sample = self._stepper.run(steps, self._drive)
        stamp = self._start_time + sample.step * self.grid.step_ns
        outputs = list(self._outputs.serialised(sample, stamp))
        for publisher, data in zip(self._output_publishers, outputs, strict=True):
            publisher.publish(data)
        self.samples_published += 1
        self.peaks.update(sample)
        if self.recorder is not None:
            for message in run_messages(sample, outputs, self.grid, self._start_time):
                self.recorder.offer(*message)
            if self.recorder.lost:
                self._warn_of_lost(self.recorder)

    def _warn_of_lost(self, recorder: BackgroundWriter) -> None:
        reason = recorder.failure or "the disk does not keep up"
        self.get_logger().error(
            f"{reason}; {recorder.lost} messages not recorded, the simulation goes on",
            throttle_duration_sec=WARNING_PERIOD,
        )

    def _on_steering(self, message: Float64) -> None:
        clamped = self._input.clamped
        if not self._input.offer(message.data, self._stepper.step):
            self.get_logger().warning(
                f"steering: {message.data}: not a finite angle; {self._input.rejected} rejected so far",
                throttle_duration_sec=WARNING_PERIOD,
            )
        elif self._input.clamped > clamped:
            self.get_logger().warning(
                f"steering: {message.data}: clamped to max_steering_angle, {self._input.clamped} so far",
                throttle_duration_sec=WARNING_PERIOD,
            )

    def _on_parameters(self, parameters: list[Parameter]) -> None:
        for parameter in parameters:
            if parameter.name == "speed":
                self._new_speed = parameter.value or self.model.vehicle.speed

    def _on_reset(self, _request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        self._reset_wanted = True
        response.success, response.message = True, "at rest at the origin from the next step on"
        return response

    def _on_pause(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        if request.data:
            self._pacer.pause(time.monotonic_ns())
        else:
            self._pacer.resume(time.monotonic_ns())
        response.success, response.message = True, "paused" if request.data else "running"
        return response

    def _on_step(self, _request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        response.success = self._pacer.paused
        if response.success:
            self._advance()
            response.message = f"simulated time {self.simulated_time:.9g} s"
        else:
            response.message = "not paused: steps are for a simulation that stands"
        return response

    def _steering_source(self) -> Callable[[int], float]:
        given = {name: value for name in SETTINGS if not math.isnan(value := getattr(self.settings, name))}
        if self.settings.manoeuvre != "none":
            manoeuvre = make_manoeuvre(self.settings.manoeuvre, given)
            return lambda step: manoeuvre(self.grid.seconds(step))
        if given:
            message = f"parameter {next(iter(given))}: there is no manoeuvre to use it"
            raise NodeError(message)
        self.create_subscription(Float64, "steering", self._on_steering, QUEUE_DEPTH)
        return self._input.at

    def _open_recorder(self) -> BackgroundWriter:
        directory = (
            Path(self.settings.record_directory)
            if self.settings.record_directory
            else default_run_directory(self.model.vehicle.name)
        )
        run = open_run(
            directory,
            self._outputs,
            self.model,
            self.grid,
            start_time=self._start_time,
            parameters=asdict(self.settings),
            vehicle=VehicleSource(vehicle_text(self.settings.vehicle), _vehicle_overrides(self.settings)),
            topics=[
                *(self.resolve_topic_name(name) for name in INPUT_TYPES),
                *(publisher.topic_name for publisher in self._output_publishers),
            ],
        )
        self.get_logger().info(f"recording to {directory}")
        return BackgroundWriter(run)


def _model(settings: SimParameters) -> LinearModel:
    vehicle = load_vehicle(settings.vehicle, _vehicle_overrides(settings))
    return linear_model(vehicle, settings.speed or None, settings.model)


def _vehicle_overrides(settings: SimParameters) -> tuple[str, ...]:
    return tuple(override for override in settings.vehicle_overrides if override)
