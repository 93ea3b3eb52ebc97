"""Brackets around speeds at which stability changes, for a stack of vehicles at once."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.dynamics.speed_family import StateMatrices

SPEEDS = (0.5, 70.0)
"""Speeds in m/s that are searched for critical ones; a vehicle file may ask for up to 70 m/s."""

_SPACING = 0.3
_PARTS = 16
_HALVINGS = 48
"""Bisections of a bracket, down to a share of 4e-15 of it."""

IntArray = npt.NDArray[np.intp]


class Brackets(NamedTuple):
    """Pairs of speeds between which a vehicle's rightmost eigenvalue changes sides.

    Attributes
    ----------
    vehicles : ndarray of int, shape (b,)
        Index of the vehicle; rising, and the speeds of each vehicle rise.
    low, high : ndarray, shape (b,)
        Lower and upper speed [m/s].
    unstable_above : ndarray of bool, shape (b,)
        Whether it is the higher speed that is unstable.
    """

    vehicles: IntArray
    low: FloatArray
    high: FloatArray
    unstable_above: npt.NDArray[np.bool_]

    def of_first_loss(self) -> "Brackets":
        """For each vehicle the first bracket, if any, above which it is unstable."""
        losses = np.flatnonzero(self.unstable_above)
        _, first = np.unique(self.vehicles[losses], return_index=True)
        return self.chosen(losses[first])

    def chosen(self, places: IntArray) -> "Brackets":
        """Those at some places, in that order."""
        return Brackets._make(part[places] for part in self)

    def refined(self, matrices: StateMatrices) -> FloatArray:
        """Speed of each change [m/s], by bisection of all brackets at once."""
        of_brackets = matrices.of_vehicles(self.vehicles)
        low, high = self.low, self.high
        if len(low):
            for _ in range(_HALVINGS):
                middle = 0.5 * (low + high)
                as_high = (_growth(of_brackets, middle) > 0.0) == self.unstable_above
                low, high = np.where(as_high, low, middle), np.where(as_high, middle, high)
        return 0.5 * (low + high)


def speed_brackets(matrices: StateMatrices, speeds: tuple[float, float] = SPEEDS) -> Brackets:
    """Bracket every change of stability over a range of speeds.

    The range is scanned in steps of 0.3 m/s or less. Where the largest real part comes nearest to 0 between
    its neighbours and may reach it, sixteen times as many are looked at, so that two changes between
    neighbours are seen, too.

    Parameters
    ----------
    matrices : StateMatrices
        Matrices of a stack of vehicles.
    speeds : (float, float)
        Range of speeds [m/s].

    Returns
    -------
    Brackets
    """
    lowest, highest = speeds
    scan = np.linspace(lowest, highest, int(np.ceil((highest - lowest) / _SPACING)) + 1)
    growth = np.stack([_growth(matrices, speed) for speed in scan.tolist()])
    unstable = growth > 0.0
    places, vehicles = np.nonzero(unstable[:-1] != unstable[1:])
    found = [Brackets(vehicles, scan[places], scan[places + 1], unstable[places + 1, vehicles])]
    middle, around = np.abs(growth[1:-1]), np.abs(np.stack([growth[:-2], growth[2:]]))
    alike = (unstable[1:-1] == unstable[:-2]) & (unstable[1:-1] == unstable[2:])
    nearest = alike & (middle <= around).all(axis=0)
    places, vehicles = np.nonzero(nearest & (middle < (around - middle).max(axis=0)))
    if len(places):
        shares = np.linspace(0.0, 1.0, 2 * _PARTS + 1)[:, np.newaxis]
        closer = scan[places] * (1.0 - shares) + scan[places + 2] * shares
        of_places = matrices.of_vehicles(vehicles)
        finer = np.stack([_growth(of_places, each) for each in closer]) > 0.0
        rows, columns = np.nonzero(finer[:-1] != finer[1:])
        ends = closer[rows, columns], closer[rows + 1, columns]
        found.append(Brackets(vehicles[columns], *ends, finer[rows + 1, columns]))
    together = Brackets._make(np.concatenate(parts) for parts in zip(*found, strict=True))
    return together.chosen(np.lexsort((together.low, together.vehicles)))


def _growth(matrices: StateMatrices, speed: FloatArray | float) -> FloatArray:
    """Largest real part of the eigenvalues of each vehicle [1/s]."""
    return np.asarray(np.linalg.eigvals(matrices.at(speed)).real.max(axis=-1), dtype=np.float64)
