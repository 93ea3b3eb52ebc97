"""The combination for viewers: markers, and the tree of frames that `urdf` describes, too."""

import math
from typing import Any

from geometry_msgs.msg import TransformStamped
from visualization_msgs.msg import Marker, MarkerArray

from yawdamp_ros.nodes.messages import turn
from yawdamp_ros.stepping import Sample
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
        yaw = float(sample.yaw[index])
        turn(marker.pose.orientation, yaw)
        # The box's middle is not the centre of gravity.
        ahead = 0.5 * (front + rear)
        marker.pose.position.x = float(sample.x[index]) + ahead * math.cos(yaw)
        marker.pose.position.y = float(sample.y[index]) + ahead * math.sin(yaw)
        marker.pose.position.z = 0.5 * HEIGHT
        marker.scale.x, marker.scale.y, marker.scale.z = front - rear, WIDTH, HEIGHT
        red, green, blue = COLOURS[index % len(COLOURS)]
        marker.color.r, marker.color.g, marker.color.b, marker.color.a = red, green, blue, 0.8
        array.markers.append(marker)
    return array


def transforms(vehicle: Vehicle, sample: Sample, stamp: int, prefix: str) -> list[TransformStamped]:
    """Frames from the ground to the lead unit, then over each hitch to the next: those of the URDF."""
    names = [prefix + name for name in vehicle.unit_names]
    lead = _transform(f"{prefix}odom", names[0], stamp, float(sample.x[0]), float(sample.yaw[0]))
    lead.transform.translation.y = float(sample.y[0])
    tree = [lead]
    for joint, (rear_hitch, front_hitch) in enumerate(vehicle.hitches):
        towed, hitch = names[joint + 1], hitch_frame(names[joint + 1])
        tree.append(_transform(names[joint], hitch, stamp, rear_hitch, -float(sample.articulation[joint])))
        tree.append(_transform(hitch, towed, stamp, -front_hitch, 0.0))
    return tree


def _transform(parent: str, child: str, stamp: int, x: float, yaw: float) -> TransformStamped:
    message = TransformStamped(child_frame_id=child)
    _stamp(message.header, stamp, parent)
    message.transform.translation.x = x
    turn(message.transform.rotation, yaw)
    return message


def _stamp(header: Any, stamp: int, frame: str) -> None:  # noqa: ANN401 - a generated message
    header.stamp.sec, header.stamp.nanosec = divmod(stamp, SECOND)
    header.frame_id = frame
