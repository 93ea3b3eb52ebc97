"""From samples to messages."""

import math
from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
from geometry_msgs.msg import Quaternion
from nav_msgs.msg import Odometry
from rclpy.serialization import serialize_message
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import Empty, Float64

from yawdamp_ros.stepping import AppliedInput, Sample
from yawdamp_ros.stepping.time_grid import SECOND

STANDARD_GRAVITY = 9.80665
"""In m/s^2; an accelerometer at rest shows it upwards (REP-145)."""
SCALARS = ("yaw", "yaw_rate", "lateral_acceleration")
INPUT_TYPES: Mapping[str, type] = MappingProxyType({"steering": Float64, "speed": Float64, "reset": Empty})
"""Messages in which a run holds what acted on the model, by the name of the input and its topic."""


class Noise(NamedTuple):
    """Normally distributed noise on what the imu topics hold, and nothing else.

    It depends on the seed and the step alone, so that it repeats wherever a run is taken up.

    Attributes
    ----------
    yaw, yaw_rate, lateral_acceleration : float
        Standard deviations in rad, rad/s and m/s^2.
    seed : int
    """

    yaw: float = 0.0
    yaw_rate: float = 0.0
    lateral_acceleration: float = 0.0
    seed: int = 0

    def of_step(self, step: int, units: int) -> list[list[float]]:
        """Noise on yaw, yaw rate and lateral acceleration of every unit at a step."""
        if not any(self[:3]):
            return [[0.0] * units] * 3
        generator = np.random.default_rng([self.seed, step])
        drawn: list[list[float]] = (generator.standard_normal((units, 3)) * self[:3]).T.tolist()
        return drawn


class OutputMessages:
    """The messages of one instant, the same objects filled anew each time.

    Parameters
    ----------
    unit_names : sequence of str
    publish_scalars : bool
        Whether yaw, yaw rate and lateral acceleration also go out as plain numbers.
    noise : Noise, optional
    frame_prefix : str
        Put before the names of frames.

    Attributes
    ----------
    types : dict of str to type
        Message class by relative topic, in the order in which `serialised` gives them.
    """

    def __init__(
        self,
        unit_names: Sequence[str],
        *,
        publish_scalars: bool,
        noise: Noise | None = None,
        frame_prefix: str = "",
    ) -> None:
        self._noise = noise or Noise()
        self._imus = [_imu(frame_prefix + name, self._noise) for name in unit_names]
        self._odometries = [_odometry(frame_prefix, name) for name in unit_names]
        self._joints = _joint_states(len(unit_names) - 1)
        self._scalars = [Float64() for _ in unit_names for _ in SCALARS] if publish_scalars else []
        self._last_steering: tuple[int, float] | None = None
        topics = [f"{name}/imu" for name in unit_names]
        topics += [f"{name}/odom" for name in unit_names]
        topics.append("joint_states")
        if publish_scalars:
            topics += [f"{name}/{scalar}" for name in unit_names for scalar in SCALARS]
        self._messages = [*self._imus, *self._odometries, self._joints, *self._scalars]
        self.types: dict[str, type] = {
            topic: type(message) for topic, message in zip(topics, self._messages, strict=True)
        }

    def go_on_from(self, stamp: int, steering_angle: float) -> None:
        """Take up a run after a sample of a stamp in ns: the steering rate is told from one to the next."""
        self._last_steering = stamp, steering_angle

    def serialised(self, sample: Sample, stamp: int) -> Iterator[bytes]:
        """Messages of a sample in CDR, all with one stamp in ns, in the order of `types`."""
        seconds, nanoseconds = divmod(stamp, SECOND)
        for message in (*self._imus, *self._odometries, self._joints):
            message.header.stamp.sec = seconds
            message.header.stamp.nanosec = nanoseconds
        self._fill_units(sample)
        self._fill_joints(sample, stamp)
        for message in self._messages:
            yield serialize_message(message)

    def _fill_units(self, sample: Sample) -> None:
        x, y = sample.x.tolist(), sample.y.tolist()
        yaw, yaw_rate = sample.yaw.tolist(), sample.yaw_rate.tolist()
        velocity, acceleration = (
            sample.lateral_velocity.tolist(),
            sample.lateral_acceleration.tolist(),
        )
        noise = self._noise.of_step(sample.step, len(yaw))
        for index, (imu, odometry) in enumerate(zip(self._imus, self._odometries, strict=True)):
            turn(imu.orientation, yaw[index] + noise[0][index])
            imu.angular_velocity.z = yaw_rate[index] + noise[1][index]
            imu.linear_acceleration.y = acceleration[index] + noise[2][index]
            turn(odometry.pose.pose.orientation, yaw[index])
            odometry.pose.pose.position.x = x[index]
            odometry.pose.pose.position.y = y[index]
            odometry.twist.twist.linear.x = sample.speed
            odometry.twist.twist.linear.y = velocity[index]
            odometry.twist.twist.angular.z = yaw_rate[index]
        if self._scalars:
            values = zip(yaw, yaw_rate, acceleration, strict=True)
            for scalar, value in zip(
                self._scalars, (value for unit in values for value in unit), strict=True
            ):
                scalar.data = value

    def _fill_joints(self, sample: Sample, stamp: int) -> None:
        steering_rate = 0.0
        if self._last_steering is not None and stamp > self._last_steering[0]:
            elapsed = (stamp - self._last_steering[0]) / SECOND
            steering_rate = (sample.steering_angle - self._last_steering[1]) / elapsed
        self._last_steering = stamp, sample.steering_angle
        self._joints.position = [sample.steering_angle, *sample.articulation.tolist()]
        self._joints.velocity = [steering_rate, *sample.articulation_rate.tolist()]


def serialised_input(applied: AppliedInput) -> bytes:
    """Message of an applied input in CDR."""
    kind = INPUT_TYPES[applied.name]
    message = Float64(data=applied.value) if kind is Float64 else kind()
    data: bytes = serialize_message(message)
    return data


def type_name(message_class: Any) -> str:  # noqa: ANN401 - generated classes share no base
    """Name of a message class, as in ``sensor_msgs/msg/Imu``."""
    return f"{message_class.__module__.split('.')[0]}/msg/{message_class.__name__}"


def _imu(frame: str, noise: Noise) -> Imu:
    message = Imu()
    message.header.frame_id = frame
    message.linear_acceleration.z = STANDARD_GRAVITY
    # All zeros mean that a covariance is not known (REP-145); without noise there is none to know.
    for covariance, deviation in (
        (message.orientation_covariance, noise.yaw),
        (message.angular_velocity_covariance, noise.yaw_rate),
        (message.linear_acceleration_covariance, noise.lateral_acceleration),
    ):
        covariance[::4] = deviation**2
    return message


def _odometry(frame_prefix: str, unit_name: str) -> Odometry:
    message = Odometry()
    message.header.frame_id = f"{frame_prefix}odom"
    message.child_frame_id = frame_prefix + unit_name
    return message


def _joint_states(joints: int) -> JointState:
    message = JointState()
    message.name = ["steering", *(f"articulation_{joint}" for joint in range(1, joints + 1))]
    # Filled though it means nothing here: a message that ends in an empty float64[] is padded in a way
    # that some readers reject.
    message.effort = [0.0] * (joints + 1)
    return message


def turn(orientation: Quaternion, yaw: float) -> None:
    """Set an orientation to a yaw in rad."""
    orientation.z = math.sin(0.5 * yaw)
    orientation.w = math.cos(0.5 * yaw)
