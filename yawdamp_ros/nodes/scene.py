"""The combination for viewers."""

from typing import Any

from geometry_msgs.msg import Quaternion
from visualization_msgs.msg import Marker, MarkerArray

from yawdamp_ros.stepping import Sample
from yawdamp_ros.stepping.pose import pose
from yawdamp_ros.stepping.time_grid import SECOND
from yawdamp_ros.vehicle import Vehicle
from yawdamp_ros.vehicle.shape import HEIGHT, WIDTH, extent

COLOURS = ((0.0, 0.45, 0.70), (0.84, 0.37, 0.0), (0.0, 0.62, 0.45), (0.80, 0.47, 0.65))
"""Colours of the units from front to rear, repeated; colour-blind readers can tell them apart."""


def markers(vehicle: Vehicle, sample: Sample, stamp: int, prefix: str) -> MarkerArray:
    """Box of every unit, from its foremost to its rearmost axle or hitch, in the ground frame."""
    array = MarkerArray()
    for index, unit in enumerate(vehicle.units):
        rear, front = extent(unit)
        marker = Marker(ns="units", id=index, type=Marker.CUBE, action=Marker.ADD)
        _stamp(marker.header, stamp, f"{prefix}odom")
        # The box's middle is not the centre of gravity.
        middle, half = pose(sample, index, ahead=0.5 * (front + rear))
        _turn(marker.pose.orientation, half)
        marker.pose.position.x, marker.pose.position.y = middle.real, middle.imag
        marker.pose.position.z = 0.5 * HEIGHT
        marker.scale.x, marker.scale.y, marker.scale.z = front - rear, WIDTH, HEIGHT
        red, green, blue = COLOURS[index % len(COLOURS)]
        marker.color.r, marker.color.g, marker.color.b, marker.color.a = red, green, blue, 0.8
        array.markers.append(marker)
    return array


def _turn(orientation: Quaternion, half: complex) -> None:
    orientation.w, orientation.z = half.real, half.imag


def _stamp(header: Any, stamp: int, frame: str) -> None:  # noqa: ANN401 - a generated message
    header.stamp.sec, header.stamp.nanosec = divmod(stamp, SECOND)
    header.frame_id = frame
