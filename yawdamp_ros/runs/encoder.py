"""From samples to messages, each serialised once for all receivers."""

from collections.abc import Callable, Mapping, Sequence
from functools import cache
from importlib import import_module
from types import MappingProxyType
from typing import Any, NamedTuple, Protocol

import numpy as np

from yawdamp_ros.dynamics.kinematics import ComplexArray, FloatArray
from yawdamp_ros.runs.frames import Frames
from yawdamp_ros.runs.outputs import FLOAT64, Of, Output, available, quantity, wheel_names
from yawdamp_ros.runs.sensors import Sensors
from yawdamp_ros.runs.templates import Blank, Templates
from yawdamp_ros.simulation import SimParameters
from yawdamp_ros.stepping import Event, Motion, Sample, TimeGrid
from yawdamp_ros.stepping.pose import half_turns
from yawdamp_ros.stepping.stamps import Stamps
from yawdamp_ros.stepping.time_grid import SECOND
from yawdamp_ros.vehicle import STANDARD_GRAVITY, complete

TWISTS = ("rate of the pose", "small angles")
"""Kinds of twist in an odometry message; earlier recordings hold the linear model's, for small angles."""


class Jump(NamedTuple):
    """Jump of the time stamps of a step and all later ones.

    Attributes
    ----------
    step : int
    nanoseconds : int
        Later by so much than the grid has it.
    """

    step: int
    nanoseconds: int


class Encoded(NamedTuple):
    """A sample and its messages.

    Attributes
    ----------
    sample : Sample
        Sample of m instants.
    stamps : list of int
        Time stamps of the instants [ns].
    names : tuple of str
        Relative topics.
    messages : list of list of bytes
        Message of every name for each instant, in CDR.
    stamp : callable
        Stamp in ns of any step.
    jump : Jump or None
        Jump of the time stamps since the previous sample.
    frames : list of bytes
        Message of `Frames.moving` for each instant; empty without frames.
    """

    sample: Sample
    stamps: list[int]
    names: tuple[str, ...]
    messages: list[list[bytes]]
    stamp: Callable[[int], int]
    jump: Jump | None = None
    frames: Sequence[bytes] = ()


class EncodedSink(Protocol):
    """Receiver of samples with their messages: publishers, a recording."""

    def write(self, encoded: Encoded) -> None:
        """Take a sample."""

    def tell(self, events: Sequence[tuple[int, Event]]) -> None:
        """Take events that no sample bears, each with its stamp [ns]."""

    def close(self) -> None:
        """Finish."""


class Encoder:
    """Serialises samples, and hands each to the publishers and the recording.

    Parameters
    ----------
    motion : Motion
        Motion that the samples come from.
    settings : SimParameters
    grid : TimeGrid
    start_time : int
        Stamp of step 0 [ns].
    twist : str
        One of `TWISTS`; the second only for runs that were recorded with it.
    surge : bool
        Whether the imu shows the longitudinal acceleration; early recordings do not.

    Attributes
    ----------
    stamps : Stamps
        Time stamps of the steps to come.
    frames : Frames or None
        Frames of the units, if the settings ask for them.
    types : dict of str to str
        Message type by relative topic, in the order of `Encoded.names`.
    sensors : Sensors
        Sensors that the imu topics show.
    sinks : list of EncodedSink
        Receivers of every sample, in this order.
    """

    def __init__(  # noqa: PLR0913 - the last two are of early recordings alone
        self,
        motion: Motion,
        settings: SimParameters,
        grid: TimeGrid,
        start_time: int,
        twist: str = TWISTS[0],
        *,
        surge: bool = True,
    ) -> None:
        self.types: dict[str, str] = {}
        self.sinks: list[EncodedSink] = []
        self._grid = grid
        self._twist = twist
        self.stamps = Stamps(grid.step_ns, start_time)
        self._jump: Jump | None = None
        self.frames: Frames | None = None
        if settings.publish_tf:
            hitches = settings.publish_tf_hitches
            self.frames = Frames(
                motion.vehicle, settings.frame_prefix, hitches=hitches, world=settings.world_frame
            )
        self._surge = surge
        self._last_speed = motion.step, motion.speed
        self._unit_names = motion.vehicle.unit_names
        self.sensors = Sensors(settings, grid, len(self._unit_names))
        self._frame_prefix = settings.frame_prefix
        self._last_steering: tuple[int, float] | None = None
        outputs = [
            output
            for output in available(motion.quantity_names)
            if output.type_name and (settings.publish_scalars or output.type_name != FLOAT64)
        ]
        self._own = {output.name: output.value for output in outputs if output.value is not None}
        self._columns: dict[str, int] = {}
        self._width = 0
        self._quantity_names = frozenset(motion.quantity_names)
        self._vehicle = motion.vehicle
        blanks = [
            self._blank(output, index, name)
            for output in outputs
            for index, name in enumerate(output.names(self._unit_names))
        ]
        for output in outputs:
            self.types |= dict.fromkeys(output.names(self._unit_names), output.type_name)
        self._names = tuple(self.types)
        self._templates = Templates(blanks)

    def go_on_from(self, step: int, steering_angle: float) -> None:
        """Resume a run after a sample: the steering rate is the difference between two samples."""
        self._last_steering = step, steering_angle

    def follow(self, clock: int) -> None:
        """Set the next stamp to a clock's time [ns] if it would differ by more than a period."""
        last = self._last_speed[0]
        step = last + self._grid.steps_per_sample
        if jump := self.stamps.follow(step, clock, self._grid.period_ns):
            self._jump = Jump(last + 1, jump)

    def jump(self, jump: Jump) -> None:
        """Repeat a recorded jump of the stamps."""
        self.stamps.jump(jump.nanoseconds)
        self._jump = jump

    def write(self, sample: Sample) -> None:
        """Serialise a sample and hand it on."""
        encoded = self.encoded(sample)
        for sink in self.sinks:
            sink.write(encoded)

    def tell(self, events: Sequence[Event]) -> None:
        """Hand on events that no sample bears, as of a run that ended before its next sample."""
        stamped = [(self.stamps.of(event.step), event) for event in events]
        for sink in self.sinks:
            sink.tell(stamped)

    def close(self) -> None:
        """Close all sinks."""
        for sink in self.sinks:
            sink.close()

    def encoded(self, sample: Sample) -> Encoded:
        """A sample with its messages."""
        steps = np.atleast_1d(sample.step).tolist()
        stamps = [self.stamps.of(step) for step in steps]
        known = self._made(sample, steps)
        jump, self._jump = self._jump, None
        found = [known[name] if name in known else quantity(sample, name) for name in self._columns]
        if len(stamps) == 1:
            values = np.concatenate(found, axis=None)[np.newaxis]
        else:
            values = np.hstack([np.reshape(each, (len(stamps), -1)) for each in found])
        messages = self._templates.filled(values, stamps)
        frames = () if self.frames is None else self.frames.moving(sample, stamps)
        return Encoded(sample, stamps, self._names, messages, self.stamps.of, jump, frames)

    def _made(self, sample: Sample, steps: Sequence[int]) -> dict[str, FloatArray]:
        """Quantities that are derived from samples."""
        half = half_turns(sample.heading)
        velocity = sample.velocity if self._twist == TWISTS[0] else _small_angles(sample)
        known = {
            "z": half.imag,
            "w": half.real,
            "imu_z": half.imag,
            "imu_w": half.real,
            "imu_yaw_rate": sample.yaw_rate,
            "imu_lateral_acceleration": sample.lateral_acceleration,
            "forward": velocity.real,
            "sideways": velocity.imag,
            "steering_rate": self._steering_rates(sample.steering_angle, steps),
            "imu_longitudinal_acceleration": self._longitudinal(sample, steps),
        }
        if not self.sensors.exact:
            known |= self.sensors.readings(
                steps,
                half,
                sample.yaw_rate,
                known["imu_longitudinal_acceleration"],
                sample.lateral_acceleration,
            )
        for name, value in self._own.items():
            known[name] = value(sample)
        return known

    def _steering_rates(self, angles: FloatArray, steps: Sequence[int]) -> FloatArray:
        rates = []
        for step, angle in zip(steps, np.atleast_1d(angles).tolist(), strict=True):
            rates.append(self._rate(self._last_steering, step, angle))
            self._last_steering = step, angle
        return np.array(rates)

    def _longitudinal(self, sample: Sample, steps: Sequence[int]) -> FloatArray:
        """Longitudinal acceleration of every unit; a common speed is differentiated from sample to sample."""
        if "longitudinal_acceleration" in sample.extra:
            return sample.extra["longitudinal_acceleration"]
        speeds = np.atleast_1d(sample.velocity.real[..., 0]).tolist()
        rates = []
        for step, speed in zip(steps, speeds, strict=True):
            rates.append(self._rate(self._last_speed, step, speed) if self._surge else 0.0)
            self._last_speed = step, speed
        of_units = np.empty_like(sample.yaw)
        of_units.T[:] = rates
        return of_units

    def _rate(self, last: tuple[int, float] | None, step: int, value: float) -> float:
        """Rate of change of a value since an earlier step; 0 where there is none."""
        if last is None or step <= last[0]:
            return 0.0
        return (value - last[1]) / ((step - last[0]) * self._grid.step_ns / SECOND)

    def _blank(self, output: Output, index: int, name: str) -> Blank:
        """Message of a unit, a joint or the run, and the places of its numbers."""
        message = message_class(output.type_name)()
        if prepare := self._PREPARATIONS.get(output.name):
            prepare(self, message, name.rpartition("/")[0])
        some = {path: name for path, name in output.some_fields.items() if name in self._quantity_names}
        places: dict[str, int] = {}
        for path, wanted in {**output.fields, **some}.items():
            if "{" not in path:
                places[path] = index + self._column(wanted, len(output.names(self._unit_names)))
            elif output.of is Of.RUN:
                joints = len(self._unit_names) - 1
                start = self._column(wanted, joints)
                places |= {
                    path.format(joint=joint + 1, **_entries(joints + 1, joint)): start + joint
                    for joint in range(joints)
                }
            else:
                wheels = [2 * len(unit.axles) for unit in self._vehicle.units]
                start = self._column(wanted, sum(wheels)) + sum(wheels[:index])
                places |= {path.format(**_entries(0, wheel)): start + wheel for wheel in range(wheels[index])}
        return Blank(message, places)

    def _column(self, name: str, width: int) -> int:
        """First column of the values of a quantity."""
        if name not in self._columns:
            self._columns[name] = self._width
            self._width += width
        return self._columns[name]

    def _prepare_imu(self, message: Any, unit: str) -> None:  # noqa: ANN401 - a generated message
        message.header.frame_id = self._frame_prefix + unit
        # An accelerometer at rest shows gravity upwards (REP-145).
        message.linear_acceleration.z = STANDARD_GRAVITY
        # All zeros mean that a covariance is not known (REP-145); without noise there is none to know.
        covariances = (
            message.orientation_covariance,
            message.angular_velocity_covariance,
            message.linear_acceleration_covariance,
        )
        for covariance, deviation in zip(covariances, self.sensors.deviations, strict=True):
            covariance[::4] = deviation**2

    def _prepare_odometry(self, message: Any, unit: str) -> None:  # noqa: ANN401
        message.header.frame_id = f"{self._frame_prefix}odom"
        message.child_frame_id = self._frame_prefix + unit

    def _prepare_joint_states(self, message: Any, _: str) -> None:  # noqa: ANN401
        joints = range(1, len(self._unit_names))
        message.name = ["steering", *(f"articulation_{joint}" for joint in joints)]
        if "hitch_force_x" in self._quantity_names:
            message.name += [f"hitch_{joint}_{axis}" for joint in joints for axis in "xyz"]
        # Filled without a meaning: some readers reject the padding of a message that ends in an empty
        # float64[].
        message.position = message.velocity = message.effort = [0.0] * len(message.name)

    def _prepare_axles(self, message: Any, unit: str) -> None:  # noqa: ANN401
        message.header.frame_id = self._frame_prefix + unit
        axles = complete(self._vehicle).units[self._unit_names.index(unit)].axles
        message.name = [f"{wheel}_{axis}" for wheel in wheel_names(len(axles)) for axis in "xyz"]
        message.position = [
            place
            for axle in axles
            for side in (0.5, -0.5)
            for place in (axle.position, side * (axle.track_width or 0.0), 0.0)
        ]
        message.velocity = message.effort = [0.0] * len(message.name)

    _PREPARATIONS: Mapping[str, Callable[["Encoder", Any, str], None]] = MappingProxyType(
        {
            "imu": _prepare_imu,
            "odom": _prepare_odometry,
            "joint_states": _prepare_joint_states,
            "axles": _prepare_axles,
        }
    )


def _entries(first: int, place: int) -> dict[str, int]:
    """Entries x, y and z of a hitch or a wheel in the arrays of a message."""
    return {axis: first + 3 * place + index for index, axis in enumerate("xyz")}


def _small_angles(sample: Sample) -> ComplexArray:
    """Velocities in the frames of the units as the linear model has them."""
    velocity = np.empty_like(sample.velocity)
    velocity.real, velocity.imag = sample.velocity.real[..., :1], sample.lateral_velocity
    return velocity


@cache
def message_class(type_name: str) -> Any:  # noqa: ANN401 - generated classes share no base
    """Class of a message type such as ``sensor_msgs/msg/Imu``.

    Raises
    ------
    ImportError, AttributeError
        If the package that defines it is not installed.
    """
    package, _, name = type_name.split("/")
    return getattr(import_module(f"{package}.msg"), name)


def type_name(message_class: Any) -> str:  # noqa: ANN401
    """Name of a message class, as in ``sensor_msgs/msg/Imu``."""
    return f"{message_class.__module__.split('.')[0]}/msg/{message_class.__name__}"
