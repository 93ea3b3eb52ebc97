"""Messages that hold steering, and the paths of the angle, the speed and the acceleration in each."""

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

from yawdamp_ros.stepping.time_grid import SECOND

AUTOWARE_CONTROL = "autoware_control_msgs/msg/Control"
"""Type of Autoware's control commands."""


def _joint_angle(message: Any, joint: str) -> float | None:  # noqa: ANN401 - made from a definition
    names = list(message.name)
    if joint not in names or len(message.position) != len(names):
        return None
    return float(message.position[names.index(joint)])


STEERING_TYPES: Mapping[str, Callable[[Any, str], float | None]] = MappingProxyType(
    {
        "std_msgs/msg/Float64": lambda message, _: float(message.data),
        "sensor_msgs/msg/JointState": _joint_angle,
        "ackermann_msgs/msg/AckermannDriveStamped": lambda message, _: float(message.drive.steering_angle),
        "autoware_control_msgs/msg/Lateral": lambda message, _: float(message.steering_tire_angle),
        AUTOWARE_CONTROL: lambda message, _: float(message.lateral.steering_tire_angle),
        "autoware_vehicle_msgs/msg/SteeringReport": lambda message, _: float(message.steering_tire_angle),
        "autoware_auto_vehicle_msgs/msg/SteeringReport": lambda message, _: float(
            message.steering_tire_angle
        ),
    }
)
"""Types that can hold steering, each with a function to its angle, left positive [rad]."""


class LongitudinalDemand(NamedTuple):
    """Longitudinal motion that a steering message demands.

    Attributes
    ----------
    speed : float
        Target speed [m/s].
    acceleration : float or None
        Acceleration [m/s^2], which counts before the speed where the model takes it; None: not demanded.
    rate : float
        Rate at which the target speed is approached [m/s^2]; 0: as fast as the model can.

    Examples
    --------
    >>> LongitudinalDemand(speed=5.0).rate
    0.0
    """

    speed: float
    acceleration: float | None = None
    rate: float = 0.0


def _ackermann(message: Any) -> LongitudinalDemand:  # noqa: ANN401
    drive = message.drive
    return LongitudinalDemand(float(drive.speed), rate=abs(float(drive.acceleration)))


def _autoware(message: Any) -> LongitudinalDemand:  # noqa: ANN401
    wanted = message.longitudinal
    acceleration = float(wanted.acceleration) if wanted.is_defined_acceleration else None
    return LongitudinalDemand(float(wanted.velocity), acceleration)


LONGITUDINAL_TYPES: Mapping[str, Callable[[Any], LongitudinalDemand]] = MappingProxyType(
    {
        "ackermann_msgs/msg/AckermannDriveStamped": _ackermann,
        AUTOWARE_CONTROL: _autoware,
    }
)
"""Types that hold a speed besides the angle, each with a function to what it demands."""


def message_stamp(message: Any) -> int:  # noqa: ANN401 - made from a definition
    """Stamp of a message [ns]; 0 where it has none."""
    stamp = getattr(getattr(message, "header", message), "stamp", None)
    return 0 if stamp is None else int(stamp.sec) * SECOND + int(stamp.nanosec)
