"""A model at any speed: its matrices are ``constant + by_inverse / u + by_speed u``."""

from dataclasses import dataclass

import numpy as np

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.dynamics.linear_model import MODELS
from yawdamp_ros.vehicle import Vehicle

_NODES = np.array([1.0, 8.0, 64.0])
"""Speeds in m/s from which the parts are found: at each another part is large."""


@dataclass(frozen=True)
class StateMatrices:
    """State matrices of a stack of vehicles, at any speed.

    Attributes
    ----------
    constant, by_inverse, by_speed : ndarray, shape (k, m, m)
        A slip angle is a velocity over the speed, and what turns has an acceleration by the speed.
    """

    constant: FloatArray
    by_inverse: FloatArray
    by_speed: FloatArray

    @classmethod
    def of(cls, vehicle: Vehicle, model: str, count: int) -> "StateMatrices":
        """Find the parts of a stack of a number of vehicles, in one of `MODELS`."""
        at_nodes = [MODELS[model](vehicle, speed)[0] for speed in _NODES.tolist()]
        parts = np.linalg.inv(np.column_stack([np.ones(3), 1.0 / _NODES, _NODES]))
        shape = (count, *at_nodes[0].shape[-2:])
        constant, by_inverse, by_speed = (
            np.broadcast_to(sum(share * matrix for share, matrix in zip(row, at_nodes, strict=True)), shape)
            for row in parts
        )
        return cls(constant, by_inverse, by_speed)

    def at(self, speed: FloatArray | float) -> FloatArray:
        """Matrices at one speed in m/s, or at one of each, shape (k, m, m)."""
        each = np.asarray(speed, dtype=np.float64)[..., np.newaxis, np.newaxis]
        return self.constant + self.by_inverse / each + self.by_speed * each

    def of_vehicles(self, indices: "np.typing.NDArray[np.intp]") -> "StateMatrices":
        """Those of some of the vehicles, any of them more than once."""
        return StateMatrices(self.constant[indices], self.by_inverse[indices], self.by_speed[indices])
