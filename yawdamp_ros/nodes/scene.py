"""The combination for viewers: markers, and the tree of frames that `urdf` describes, too."""

from typing import Any

from geometry_msgs.msg import Quaternion, TransformStamped
from visualization_msgs.msg import Marker, MarkerArray

from yawdamp_ros.stepping import Sample
from yawdamp_ros.stepping.pose import half_turn, pose
from yawdamp_ros.stepping.time_grid import SECOND
from yawdamp_ros.vehicle import Vehicle
from yawdamp_ros.vehicle.shape import HEIGHT, WIDTH, extent, hitch_frame

COLOURS = ((0.0, 0.45, 0.70), (0.84, 0.37, 0.0), (0.0, 0.62, 0.45), (0.80, 0.47, 0.65))
"""Of units, front to rear and over again; told apart by the colour-blind, too."""


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


def transforms(vehicle: Vehicle, sample: Sample, stamp: int, prefix: str) -> list[TransformStamped]:
    """Frames from the ground to the lead unit, then over each hitch to the next: those of the URDF."""
    names = [prefix + name for name in vehicle.unit_names]
    lead = _transform(f"{prefix}odom", names[0], stamp, *pose(sample, 0))
    tree = [lead]
    for joint, (rear_hitch, front_hitch) in enumerate(vehicle.hitches):
        towed, hitch = names[joint + 1], hitch_frame(names[joint + 1])
        folded = half_turn(-sample.articulation[joint])
        tree.append(_transform(names[joint], hitch, stamp, complex(rear_hitch), folded))
        tree.append(_transform(hitch, towed, stamp, complex(-front_hitch), 1.0 + 0.0j))
    return tree


def _transform(parent: str, child: str, stamp: int, place: complex, half: complex) -> TransformStamped:
    message = TransformStamped(child_frame_id=child)
    _stamp(message.header, stamp, parent)
    message.transform.translation.x, message.transform.translation.y = place.real, place.imag
    _turn(message.transform.rotation, half)
    return message


def _turn(orientation: Quaternion, half: complex) -> None:
    orientation.w, orientation.z = half.real, half.imag


def _stamp(header: Any, stamp: int, frame: str) -> None:  # noqa: ANN401 - a generated message
    header.stamp.sec, header.stamp.nanosec = divmod(stamp, SECOND)
    header.frame_id = frame
