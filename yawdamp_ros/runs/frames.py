"""Frames of the units as messages of type tf2_msgs/TFMessage, a package that need not be installed.

The message is one array, ``geometry_msgs/TransformStamped[] transforms``; its CDR follows from that.
"""

import struct
from collections.abc import Sequence

import numpy as np

from yawdamp_ros.runs.templates import ENCAPSULATION
from yawdamp_ros.stepping import Sample
from yawdamp_ros.stepping.pose import half_turns
from yawdamp_ros.stepping.time_grid import SECOND
from yawdamp_ros.vehicle import Vehicle
from yawdamp_ros.vehicle.shape import hitch_frame

TF_TYPE = "tf2_msgs/msg/TFMessage"
_LITTLE_ENDIAN = b"\x00\x01\x00\x00"
_ROTATION = 40
"""Bytes from a transform's first number to the z of its quaternion; w follows it."""


class Frames:
    """Frames from the ground to the lead unit, then over each hitch to the next: those of the URDF.

    Parameters
    ----------
    vehicle : Vehicle
    prefix : str
        Prefix of every frame's name.
    hitches : bool
        Whether the frames behind the lead unit are among them.
    world : str
        Frame that holds the ground frame of each rig; empty for none.
    """

    def __init__(self, vehicle: Vehicle, prefix: str, *, hitches: bool = True, world: str = "") -> None:
        names = [prefix + name for name in vehicle.unit_names]
        joints = list(zip(names, names[1:], vehicle.hitches, strict=False)) if hitches else []
        moving = [(f"{prefix}odom", names[0], 0.0)]
        moving += [(towing, hitch_frame(towed), rear) for towing, towed, (rear, _) in joints]
        self._moving = _Layout(moving)
        fixed = [(world, f"{prefix}odom", 0.0)] if world else []
        fixed += [(hitch_frame(towed), towed, -front) for _, towed, (_, front) in joints]
        self._fixed = _Layout(fixed)
        self._joints = len(joints)

    def moving(self, sample: Sample, stamps: Sequence[int]) -> list[bytes]:
        """Messages of the moving frames, one for each instant of a sample, with stamps [ns]."""
        count = len(stamps)
        x, y, heading = (
            np.reshape(values, (count, -1))[:, 0]
            for values in (sample.x, sample.y, half_turns(sample.heading))
        )
        folded = np.exp(-0.5j * np.reshape(sample.articulation, (count, -1))[:, : self._joints])
        halves = np.hstack([heading[:, np.newaxis], folded])
        return [
            self._moving.message(stamp, place, turns)
            for stamp, place, turns in zip(
                stamps, zip(x.tolist(), y.tolist(), strict=True), halves.tolist(), strict=True
            )
        ]

    def fixed(self, stamp: int) -> bytes:
        """Message of the fixed frames: world to ground, and hitch to the unit that it tows; stamp [ns]."""
        return self._fixed.message(stamp)


class _Layout:
    """A message with a transform for every parent, child and place ahead of the parent [m]."""

    def __init__(self, transforms: Sequence[tuple[str, str, float]]) -> None:
        data = bytearray(struct.pack("<I", len(transforms)))
        self._stamps: list[int] = []
        self._numbers: list[int] = []
        for parent, child, ahead in transforms:
            _align(data, 4)
            self._stamps.append(ENCAPSULATION + len(data))
            data += bytes(8)
            for text in (parent.encode(), child.encode()):
                _align(data, 4)
                data += struct.pack("<I", len(text) + 1) + text + b"\0"
            _align(data, 8)
            self._numbers.append(ENCAPSULATION + len(data))
            data += struct.pack("<7d", ahead, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
        self._blank = _LITTLE_ENDIAN + bytes(data)

    def message(
        self, stamp: int, place: tuple[float, float] | None = None, halves: Sequence[complex] = ()
    ) -> bytes:
        """Message with a stamp [ns], the place of the first transform, and half turns of the first ones."""
        data = bytearray(self._blank)
        for at in self._stamps:
            struct.pack_into("<iI", data, at, *divmod(stamp, SECOND))
        if place is not None:
            struct.pack_into("<2d", data, self._numbers[0], *place)
        for at, half in zip(self._numbers, halves, strict=False):
            struct.pack_into("<2d", data, at + _ROTATION, half.imag, half.real)
        return bytes(data)


def _align(data: bytearray, size: int) -> None:
    data += bytes(-len(data) % size)
