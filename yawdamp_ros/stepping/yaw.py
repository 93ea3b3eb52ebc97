"""The yaw of a vehicle that may turn for days."""

import math
from typing import NamedTuple

LARGEST_YAW = 1e100
"""Largest yaw [rad]; the yaw of an unstable motion would overflow."""


class YawParts(NamedTuple):
    """A yaw as the sum of two numbers.

    Attributes
    ----------
    value, remainder : float
        Number, and the remainder of its rounding [rad].
    wrapped : float
        Value without whole turns [rad].
    """

    value: float
    remainder: float
    wrapped: float


class Yaw:
    """Sum of any number of angles without rounding error.

    Attributes
    ----------
    parts : YawParts
    direction : float
        Yaw without whole turns [rad].
    """

    def __init__(self) -> None:
        self.set(0.0, 0.0)

    def set(self, value: float, remainder: float) -> None:
        """Set the sum to two numbers, the second the rounding error of the first."""
        known = abs(value) <= LARGEST_YAW
        wrapped = math.atan2(math.sin(value), math.cos(value)) if known else math.nan
        self.parts = YawParts(value, remainder, wrapped)
        self.direction = wrapped + remainder

    def turn(self, angle: float) -> None:
        """Add an angle [rad]."""
        value, remainder, _ = self.parts
        change = remainder + angle
        total = value + change
        back = total - value
        self.set(total, (value - (total - back)) + (change - back))
