"""Static roll of the nonlinear model: how hard a turn a combination stands before it rolls over.

In a steady turn of a large radius every unit rolls until the moments about its roll axis balance: springs,
which reach no further than a lifted wheel lets them, weight and inertia of what leans, and the forces of the
hitches. Lateral forces of axles and hitches are then in the ratio of their vertical loads, for the inertia
acts at the centre of gravity as the weight does. Units whose hitch couples roll are one group.

Hitches and springs are those of `motion.rates`; that both agree is tested.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from yawdamp_ros.dynamics.kinematics import FloatArray, IntArray
from yawdamp_ros.nonlinear.errors import NonlinearError
from yawdamp_ros.nonlinear.parameters import parameters
from yawdamp_ros.nonlinear.records import (
    CG_ARM,
    FRONT_ARM,
    HALF_TRACK,
    HITCH_LOAD,
    HITCH_ROLL_STIFFNESS,
    MASS,
    REAR_ARM,
    ROLL_AXIS_HEIGHT,
    ROLL_STIFFNESS,
    STATIC_LOAD,
    Parameters,
)
from yawdamp_ros.nonlinear.settings import Settings
from yawdamp_ros.vehicle import STANDARD_GRAVITY, Vehicle, complete, static_loads

ROLLS = np.geomspace(1e-5, 0.7, 120)
"""Mean roll angles at which the equilibrium is computed [rad]."""
REFINEMENTS = 4
"""Number of refinements of the maximum between its neighbours."""
ITERATIONS = 40
"""Limit on the iterations of Newton's method; every spring that reaches its end takes one."""
TOLERANCE = 1e-9
"""Residual moment in an equilibrium, relative to the weight times one metre."""


class RollGroup(NamedTuple):
    """Units that roll together.

    Attributes
    ----------
    units : tuple of str
    threshold : float
        Highest lateral acceleration with an equilibrium, in g.
    roll : tuple of float
        Roll of each unit there [rad].
    curve : ndarray, shape (k, 2)
        Mean roll [rad] and the lateral acceleration that holds it [g], up to beyond the threshold.
    """

    units: tuple[str, ...]
    threshold: float
    roll: tuple[float, ...]
    curve: FloatArray


def static_rollover(vehicle: Vehicle) -> tuple[RollGroup, ...]:
    """Find the static rollover threshold of every group of units that roll together.

    Parameters
    ----------
    vehicle : Vehicle
        Vehicle; missing values are assumed (`yawdamp_ros.vehicle.assumed` lists them).

    Returns
    -------
    tuple of RollGroup
        Foremost first.

    Raises
    ------
    NonlinearError
        If no equilibrium is found.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> [group.units for group in static_rollover(load_vehicle("a_double"))]
    [('tractor', 'semitrailer_1'), ('dolly', 'semitrailer_2')]
    """
    p = parameters(vehicle, Settings())
    units = [
        replace(unit, axles=tuple(replace(axle, static_load=None) for axle in unit.axles))
        for unit in vehicle.units
    ]
    lateral = static_loads(replace(vehicle, units=tuple(units)))
    forces = _Lateral(
        np.array([load for unit in lateral for load in unit.axles]),
        np.array([*(unit.front_hitch for unit in lateral), 0.0]),
    )
    return tuple(_threshold(_Group(vehicle, np.array(part), p, forces)) for part in roll_groups(vehicle))


def roll_groups(vehicle: Vehicle) -> tuple[tuple[int, ...], ...]:
    """Find the units that hitches make roll together.

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    tuple of tuple of int
        Indices of the units of each group, foremost first.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> roll_groups(load_vehicle("a_double"))
    ((0, 1), (2, 3))
    """
    groups: list[tuple[int, ...]] = []
    coupled = False
    for index, unit in enumerate(complete(vehicle).units):
        groups.append((*groups.pop(), index) if coupled else (index,))
        coupled = bool(unit.hitch_roll_stiffness)
    return tuple(groups)


class _Lateral(NamedTuple):
    """Lateral forces of axles and of front hitches [N/g]."""

    axles: FloatArray
    hitches: FloatArray


def _threshold(group: "_Group") -> RollGroup:
    means = ROLLS
    best = np.zeros(len(group.names) + 1)
    curve = np.zeros((1, 2))
    for level in range(REFINEMENTS):
        states = group.equilibria(means, best if level else None)
        severity = states[:, -1]
        top = int(np.nanargmax(severity))
        if severity[top] >= best[-1]:
            best = states[top]
        if not level:
            known = np.isfinite(severity)
            curve = np.vstack([curve, np.column_stack([means, severity])[known]])
        low, high = means[max(top - 1, 0)], means[min(top + 1, len(means) - 1)]
        means = np.linspace(low, high, len(ROLLS))
    return RollGroup(group.names, float(best[-1]), tuple(best[:-1].tolist()), curve)


class _Group:
    """Equilibria of units that roll together, at many mean rolls at once."""

    def __init__(self, vehicle: Vehicle, part: IntArray, p: Parameters, forces: "_Lateral") -> None:
        self.names = tuple(vehicle.units[unit].name for unit in part)
        self._vehicle = vehicle
        self._rows = p.units[part]
        self._behind = np.append(p.units[:, HITCH_LOAD], 0.0)[part + 1]
        self._sideways = forces.hitches[part], forces.hitches[part + 1]
        self._axles = [np.arange(p.first_axle[unit], p.first_axle[unit + 1]) for unit in part]
        self._table, self._forces = p.axles, forces.axles
        self._weight = STANDARD_GRAVITY * float(self._rows[:, MASS].sum())

    def equilibria(self, means: FloatArray, start: FloatArray | None) -> FloatArray:
        """Rolls of n units [rad] and the severity that holds them [g], shape (k, n + 1); NaN if not found."""
        count = len(self.names)
        states = np.zeros((len(means), count + 1))
        states[:, :-1] = means[:, np.newaxis]
        if start is not None:
            states[:] = start
        for _ in range(ITERATIONS):
            moments, slopes = self._balance(states)
            moments[:, -1] = states[:, :-1].mean(axis=1) - means
            if np.abs(moments).max() < TOLERANCE:
                break
            states -= np.linalg.solve(slopes, moments[..., np.newaxis])[..., 0]
        moments, _ = self._balance(states)
        moments[:, -1] = 0.0
        states[np.abs(moments).max(axis=1) > TOLERANCE] = np.nan
        if not np.isfinite(states).any():
            message = f"{self._vehicle.name}: no static roll of {' and '.join(self.names)}"
            raise NonlinearError(message)
        return states

    def _balance(self, states: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Moments about the roll axes that lean further out, over the weight, and their slopes."""
        count = len(self.names)
        roll, severity = states[:, :-1], states[:, -1:]
        lean, upright = np.sin(roll), np.cos(roll)
        moments, slopes = np.zeros((len(states), count + 1)), np.zeros((len(states), count + 1, count + 1))
        terms = [(self._rows[:, CG_ARM], *(STANDARD_GRAVITY * self._rows[:, MASS],) * 2)]
        ahead, behind = self._sideways
        terms += [(-self._rows[:, FRONT_ARM], ahead, self._rows[:, HITCH_LOAD])]
        terms += [(self._rows[:, REAR_ARM], behind, self._behind)]
        for arm, sideways, downwards in terms:
            moments[:, :-1] += arm * (severity * sideways * upright + downwards * lean)
            slopes[:, range(count), range(count)] += arm * (downwards * upright - severity * sideways * lean)
            slopes[:, :-1, -1] += arm * sideways * upright
        for unit, axles in enumerate(self._axles):
            pushed = self._rows[unit, ROLL_AXIS_HEIGHT] * self._forces[axles]
            stiffness = self._table[axles, ROLL_STIFFNESS]
            most = self._table[axles, STATIC_LOAD] * self._table[axles, HALF_TRACK]
            sprung = stiffness * roll[:, unit, np.newaxis] + pushed * severity
            on_both = np.abs(sprung) < most
            moments[:, unit] += (pushed * severity - np.clip(sprung, -most, most)).sum(axis=1)
            slopes[:, unit, unit] -= (stiffness * on_both).sum(axis=1)
            slopes[:, unit, -1] += (pushed * ~on_both).sum(axis=1)
        for unit, stiffness in enumerate(self._rows[:-1, HITCH_ROLL_STIFFNESS]):
            twist = stiffness * (roll[:, unit] - roll[:, unit + 1])
            moments[:, unit] -= twist
            moments[:, unit + 1] += twist
            slopes[:, unit, unit] -= stiffness
            slopes[:, unit, unit + 1] += stiffness
            slopes[:, unit + 1, unit] += stiffness
            slopes[:, unit + 1, unit + 1] -= stiffness
        moments /= self._weight
        slopes /= self._weight
        slopes[:, -1, :-1] = 1.0 / count
        return moments, slopes
