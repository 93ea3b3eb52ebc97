"""Messages that hold steering, and the path of the angle in each."""

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

from yawdamp_ros.stepping.time_grid import SECOND


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
        "autoware_control_msgs/msg/Control": lambda message, _: float(message.lateral.steering_tire_angle),
        "autoware_vehicle_msgs/msg/SteeringReport": lambda message, _: float(message.steering_tire_angle),
        "autoware_auto_vehicle_msgs/msg/SteeringReport": lambda message, _: float(
            message.steering_tire_angle
        ),
    }
)
"""Types that can hold steering, each with a function to its angle, left positive [rad]."""


def message_stamp(message: Any) -> int:  # noqa: ANN401 - made from a definition
    """Stamp of a message [ns]; 0 where it has none."""
    stamp = getattr(getattr(message, "header", message), "stamp", None)
    return 0 if stamp is None else int(stamp.sec) * SECOND + int(stamp.nanosec)
