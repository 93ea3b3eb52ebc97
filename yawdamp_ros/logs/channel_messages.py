"""Messages that hold measurements of a vehicle, and the path of each quantity in them."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, NamedTuple


class Field(NamedTuple):
    """A quantity in a message.

    Attributes
    ----------
    quantity : str
        Quantity, one of `QUANTITIES`.
    path : str
        Path of its field, as in ``angular_velocity.z``.
    """

    quantity: str
    path: str


_TWIST = (Field("speed", "twist.linear.x"), Field("yaw_rate", "twist.angular.z"))
_COVARIANT_TWIST = (Field("speed", "twist.twist.linear.x"), Field("yaw_rate", "twist.twist.angular.z"))
_VELOCITY = (Field("speed", "longitudinal_velocity"), Field("yaw_rate", "heading_rate"))

MEASURING_TYPES: Mapping[str, tuple[Field, ...]] = MappingProxyType(
    {
        "autoware_vehicle_msgs/msg/VelocityReport": _VELOCITY,
        "autoware_auto_vehicle_msgs/msg/VelocityReport": _VELOCITY,
        "sensor_msgs/msg/Imu": (
            Field("yaw_rate", "angular_velocity.z"),
            Field("lateral_acceleration", "linear_acceleration.y"),
        ),
        "geometry_msgs/msg/TwistStamped": _TWIST,
        "geometry_msgs/msg/TwistWithCovarianceStamped": _COVARIANT_TWIST,
        "nav_msgs/msg/Odometry": (
            Field("x", "pose.pose.position.x"),
            Field("y", "pose.pose.position.y"),
            *_COVARIANT_TWIST,
        ),
    }
)
"""Types that hold measurements, the best source of a quantity first."""

SCALAR_TYPES = ("std_msgs/msg/Float64", "std_msgs/msg/Float32")
"""Types of one number; the topic's name tells its quantity."""

JOINT_TYPE = "sensor_msgs/msg/JointState"
"""Type whose joints ``articulation_1`` onwards are articulation angles."""


def field_of(message: Any, path: str) -> float:  # noqa: ANN401 - made from a definition
    """Number at a path of fields; a part of it may be an index.

    Raises
    ------
    AttributeError, IndexError, TypeError, ValueError
        If there is none.
    """
    for part in path.split("."):
        message = message[int(part)] if part.isdigit() else getattr(message, part)
    return float(message)


def field_names(message: Any) -> list[str]:  # noqa: ANN401 - made from a definition
    """Names of the joints of a joint state; empty for another message."""
    return [str(name) for name in getattr(message, "name", ())]
