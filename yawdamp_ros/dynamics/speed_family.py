"""A model at any speed: its matrices are ``constant + by_inverse / u + by_speed u``."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.dynamics.linear_model import MODELS
from yawdamp_ros.vehicle import Vehicle

SPEEDS = (8.0, 16.0, 32.0)
"""Speeds that the parts follow from [m/s], each twice the one before it."""


class SpeedParts(NamedTuple):
    """Numbers that depend on the speed u: slip angles bring terms in 1/u, rotating frames terms in u.

    Attributes
    ----------
    constant, by_inverse, by_speed : ndarray
        Coefficients of 1, 1/u and u, all of the same shape.
    """

    constant: FloatArray
    by_inverse: FloatArray
    by_speed: FloatArray

    @classmethod
    def of(cls, values: Sequence[FloatArray] | FloatArray) -> "SpeedParts":
        """Find the parts of numbers that are known at each of `SPEEDS`.

        The result is exact for numbers with a single part, because the speeds are powers of two.
        """
        low, middle, high = values
        first, second = middle - low, high - middle
        speed = (2.0 * second - first) / 3.0
        inverse = 2.0 * (speed - first)
        return cls(low - inverse - speed, inverse * SPEEDS[0], speed / SPEEDS[0])

    def at(self, speed: float) -> FloatArray:
        """Return the numbers at a speed [m/s]."""
        return self.constant + self.by_inverse * (1.0 / speed) + self.by_speed * speed


class StateMatrices(NamedTuple):
    """State matrices of a stack of vehicles, at any speed.

    Attributes
    ----------
    parts : SpeedParts
        Parts of shape (k, m, m).
    """

    parts: SpeedParts

    @classmethod
    def of(cls, vehicle: Vehicle, model: str, count: int) -> "StateMatrices":
        """Find the matrices of a stack of so many vehicles, in one of `MODELS`."""
        parts = SpeedParts.of([MODELS[model](vehicle, speed)[0] for speed in SPEEDS])
        shape = (count, *parts.constant.shape[-2:])
        return cls(SpeedParts._make(np.broadcast_to(part, shape) for part in parts))

    def at(self, speed: FloatArray | float) -> FloatArray:
        """Matrices at one speed [m/s], or at one of each, shape (k, m, m)."""
        each = np.asarray(speed, dtype=np.float64)[..., np.newaxis, np.newaxis]
        constant, by_inverse, by_speed = self.parts
        return constant + by_inverse / each + by_speed * each

    def of_vehicles(self, indices: npt.NDArray[np.intp]) -> "StateMatrices":
        """Return the matrices of some of the vehicles; a vehicle may occur more than once."""
        return StateMatrices(SpeedParts._make(part[indices] for part in self.parts))
