"""From samples to messages."""

import math
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
from geometry_msgs.msg import Quaternion
from nav_msgs.msg import Odometry
from rclpy.serialization import serialize_message
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import Empty, Float64

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.nodes.templates import Blank, Templates
from yawdamp_ros.stepping import AppliedInput, Sample
from yawdamp_ros.stepping.time_grid import SECOND

STANDARD_GRAVITY = 9.80665
"""In m/s^2; an accelerometer at rest shows it upwards (REP-145)."""
TWISTS = ("rate of the pose", "small angles")
"""What the twist of an odometry message is: earlier recordings hold that of the linear model."""
SCALARS = ("yaw", "yaw_rate", "lateral_acceleration")
_OF_UNITS = (
    *("imu_z", "imu_w", "imu_yaw_rate", "imu_lateral_acceleration"),
    *("x", "y", "z", "w", "yaw", "yaw_rate", "forward", "sideways", "lateral_acceleration"),
)
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

    @property
    def present(self) -> bool:
        """Whether there is any."""
        return any(self[:3])

    def of_step(self, step: int, units: int) -> FloatArray:
        """Noise on yaw, yaw rate and lateral acceleration of every unit at a step, shape (3, units)."""
        generator = np.random.default_rng([self.seed, step])
        return (generator.standard_normal((units, 3)) * self[:3]).T


class OutputMessages:
    """The messages of an instant.

    Parameters
    ----------
    unit_names : sequence of str
    publish_scalars : bool
        Whether yaw, yaw rate and lateral acceleration also go out as plain numbers.
    noise : Noise, optional
    frame_prefix : str
        Put before the names of frames.
    twist : str
        One of `TWISTS`; other than the first only of what was recorded so.

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
        twist: str = TWISTS[0],
    ) -> None:
        self._small_angles = twist != TWISTS[0]
        self._noise = noise or Noise()
        self._units = units = len(unit_names)
        self._last_steering: tuple[int, float] | None = None
        widths = dict.fromkeys(_OF_UNITS, units)
        widths |= {"articulation": units - 1, "articulation_rate": units - 1}
        widths |= {"steering_angle": 1, "steering_rate": 1}
        starts = np.cumsum([0, *widths.values()]).tolist()
        self._columns = dict(zip(widths, starts, strict=False))
        blanks = {f"{name}/imu": self._imu(unit, frame_prefix + name) for unit, name in enumerate(unit_names)}
        blanks |= {
            f"{name}/odom": self._odometry(unit, frame_prefix, name) for unit, name in enumerate(unit_names)
        }
        blanks["joint_states"] = self._joint_states(units - 1)
        if publish_scalars:
            blanks |= {
                f"{name}/{scalar}": self._blank(Float64(), {"data": scalar}, unit)
                for unit, name in enumerate(unit_names)
                for scalar in SCALARS
            }
        self.types: dict[str, type] = {topic: type(blank.message) for topic, blank in blanks.items()}
        self._templates = Templates(list(blanks.values()))

    def go_on_from(self, stamp: int, steering_angle: float) -> None:
        """Take up a run after a sample of a stamp in ns: the steering rate is told from one to the next."""
        self._last_steering = stamp, steering_angle

    def serialised(self, sample: Sample, stamps: Sequence[int]) -> list[list[bytes]]:
        """Messages of each of m instants in CDR, those of an instant with its stamp in ns, as in `types`."""
        units, instants = self._units, len(stamps)

        def table(values: npt.NDArray[Any], width: int = units) -> npt.NDArray[Any]:
            return np.reshape(values, (instants, width))

        # Of half the yaw, which is what a quaternion holds.
        half = np.sqrt(table(sample.heading))
        yaw_rate, acceleration = table(sample.yaw_rate), table(sample.lateral_acceleration)
        imu = half, yaw_rate, acceleration
        if self._noise.present:
            yaw_noise, rate_noise, acceleration_noise = np.array(
                [self._noise.of_step(step, units) for step in np.atleast_1d(sample.step).tolist()]
            ).transpose(1, 0, 2)
            imu = half * np.exp(0.5j * yaw_noise), yaw_rate + rate_noise, acceleration + acceleration_noise
        angles = np.atleast_1d(sample.steering_angle)
        columns = {
            "imu_z": imu[0].imag,
            "imu_w": imu[0].real,
            "imu_yaw_rate": imu[1],
            "imu_lateral_acceleration": imu[2],
            "z": half.imag,
            "w": half.real,
            "x": table(sample.x),
            "y": table(sample.y),
            "yaw": table(sample.yaw),
            "yaw_rate": yaw_rate,
            **self._twist(sample, instants),
            "lateral_acceleration": acceleration,
            "articulation": table(sample.articulation, units - 1),
            "articulation_rate": table(sample.articulation_rate, units - 1),
            "steering_angle": angles[:, np.newaxis],
            "steering_rate": self._steering_rates(angles, stamps)[:, np.newaxis],
        }
        values = np.concatenate([columns[name] for name in self._columns], axis=1)
        return self._templates.filled(values, stamps)

    def _twist(self, sample: Sample, instants: int) -> dict[str, FloatArray]:
        """Velocities in the frames of the units."""
        if self._small_angles:
            forward: FloatArray = np.full((instants, self._units), sample.speed)
            return {"forward": forward, "sideways": sample.lateral_velocity.reshape(forward.shape)}
        velocity = sample.velocity.reshape(instants, self._units)
        return {"forward": velocity.real, "sideways": velocity.imag}

    def _steering_rates(self, angles: FloatArray, stamps: Sequence[int]) -> FloatArray:
        rates = []
        for stamp, angle in zip(stamps, angles.tolist(), strict=True):
            rate = 0.0
            if self._last_steering is not None and stamp > self._last_steering[0]:
                rate = (angle - self._last_steering[1]) / ((stamp - self._last_steering[0]) / SECOND)
            rates.append(rate)
            self._last_steering = stamp, angle
        return np.array(rates)

    def _blank(self, message: Any, quantities: Mapping[str, str], index: int = 0) -> Blank:  # noqa: ANN401
        """A message whose fields are to hold these quantities of a unit."""
        return Blank(message, {path: self._columns[name] + index for path, name in quantities.items()})

    def _imu(self, unit: int, frame: str) -> Blank:
        message = Imu()
        message.header.frame_id = frame
        message.linear_acceleration.z = STANDARD_GRAVITY
        # All zeros mean that a covariance is not known (REP-145); without noise there is none to know.
        for covariance, deviation in (
            (message.orientation_covariance, self._noise.yaw),
            (message.angular_velocity_covariance, self._noise.yaw_rate),
            (message.linear_acceleration_covariance, self._noise.lateral_acceleration),
        ):
            covariance[::4] = deviation**2
        quantities = {
            "orientation.z": "imu_z",
            "orientation.w": "imu_w",
            "angular_velocity.z": "imu_yaw_rate",
            "linear_acceleration.y": "imu_lateral_acceleration",
        }
        return self._blank(message, quantities, unit)

    def _odometry(self, unit: int, frame_prefix: str, name: str) -> Blank:
        message = Odometry()
        message.header.frame_id = f"{frame_prefix}odom"
        message.child_frame_id = frame_prefix + name
        quantities = {
            "pose.pose.position.x": "x",
            "pose.pose.position.y": "y",
            "pose.pose.orientation.z": "z",
            "pose.pose.orientation.w": "w",
            "twist.twist.linear.x": "forward",
            "twist.twist.linear.y": "sideways",
            "twist.twist.angular.z": "yaw_rate",
        }
        return self._blank(message, quantities, unit)

    def _joint_states(self, joints: int) -> Blank:
        message = JointState()
        message.name = ["steering", *(f"articulation_{joint}" for joint in range(1, joints + 1))]
        # Filled though it means nothing here: a message that ends in an empty float64[] is padded in a way
        # that some readers reject.
        message.position = message.velocity = message.effort = [0.0] * (joints + 1)
        columns = {
            "position.0": self._columns["steering_angle"],
            "velocity.0": self._columns["steering_rate"],
        }
        for joint in range(joints):
            columns[f"position.{joint + 1}"] = self._columns["articulation"] + joint
            columns[f"velocity.{joint + 1}"] = self._columns["articulation_rate"] + joint
        return Blank(message, columns)


def serialised_input(applied: AppliedInput) -> bytes:
    """Message of an applied input in CDR."""
    kind = INPUT_TYPES[applied.name]
    message = Float64(data=applied.value) if kind is Float64 else kind()
    data: bytes = serialize_message(message)
    return data


def type_name(message_class: Any) -> str:  # noqa: ANN401 - generated classes share no base
    """Name of a message class, as in ``sensor_msgs/msg/Imu``."""
    return f"{message_class.__module__.split('.')[0]}/msg/{message_class.__name__}"


def turn(orientation: Quaternion, yaw: float) -> None:
    """Set an orientation to a yaw in rad."""
    orientation.z = math.sin(0.5 * yaw)
    orientation.w = math.cos(0.5 * yaw)
