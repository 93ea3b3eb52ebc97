"""Boundaries of stability over a parameter, by root finding between the points of a scan."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np

from yawdamp_ros.analysis.answers import Answers
from yawdamp_ros.analysis.eigenmodes import rightmost
from yawdamp_ros.analysis.speed_brackets import SPEEDS, speed_brackets
from yawdamp_ros.dynamics import LinearModel
from yawdamp_ros.dynamics.speed_family import StateMatrices
from yawdamp_ros.vehicle import Vehicle

Kind = Literal["monotonic", "oscillatory", "jump"]

_JUMP = 1e-3
"""Real part that no root has [1/s]: there the eigenvalue passes infinity, not 0."""


@dataclass(frozen=True)
class Boundary:
    """Value at which the rightmost eigenvalue changes sides.

    Attributes
    ----------
    value : float
        Value of the parameter that varies.
    unstable_above : bool
        True if the larger values are unstable.
    kind : str
        ``monotonic`` where a real eigenvalue crosses, ``oscillatory`` where a pair does, ``jump`` where it
        passes infinity because the mass matrix is singular, as only the published one can be.
    frequency : float
        Frequency of the crossing pair [rad/s]; 0 for a real eigenvalue.

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> from yawdamp_ros.analysis import speed_boundaries
    >>> stiff = [f"units.0.axles.{axle}.cornering_stiffness=2e5" for axle in (1, 2)]
    >>> boundary = speed_boundaries(load_vehicle("interlink", stiff))[0]
    >>> boundary.kind, boundary.unstable_above
    ('monotonic', True)
    """

    value: float
    unstable_above: bool
    kind: Kind
    frequency: float


def find_boundaries(
    eigenvalue: Callable[[float], complex], scan: Sequence[tuple[float, complex]]
) -> tuple[Boundary, ...]:
    """Refine every change of stability in a scan.

    Parameters
    ----------
    eigenvalue : callable
        Rightmost eigenvalue in 1/s at a value.
    scan : sequence of (float, complex)
        Values, rising or falling, each with its rightmost eigenvalue. Two changes between neighbours go
        unseen.

    Returns
    -------
    tuple of Boundary
        Boundaries in the order of the scan.

    Examples
    --------
    >>> from yawdamp_ros.analysis import find_boundaries
    >>> scan = [(value, complex(value - 2.0, 1.0)) for value in (0.0, 1.0, 3.0)]
    >>> found = find_boundaries(lambda value: complex(value - 2.0, 1.0), scan)
    >>> [round(boundary.value, 6) for boundary in found]
    [2.0]
    """
    from scipy.optimize import brentq  # noqa: PLC0415 - it loads longer than most commands run

    found = []
    for (start, at_start), (end, at_end) in pairwise(scan):
        if (at_start.real > 0.0) != (at_end.real > 0.0):
            value = float(brentq(lambda x: eigenvalue(x).real, start, end, xtol=1e-12, rtol=1e-12))
            found.append(_boundary(value, (at_end.real > 0.0) == (end > start), eigenvalue(value)))
    return tuple(found)


def speed_boundaries(
    vehicle: Vehicle, model: str = "consistent", speeds: tuple[float, float] = SPEEDS
) -> tuple[Boundary, ...]:
    """Return the speeds at which a vehicle becomes unstable, or stable again.

    Parameters
    ----------
    vehicle : Vehicle
    model : str
        One of `yawdamp_ros.dynamics.MODELS`.
    speeds : (float, float)
        Range that is searched [m/s], see `speed_brackets`.

    Returns
    -------
    tuple of Boundary
        Boundaries by rising speed [m/s].

    Raises
    ------
    DynamicsError
        If there is no such model for this vehicle.

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> from yawdamp_ros.analysis import critical_speed, speed_boundaries
    >>> soft = [f"units.0.axles.{axle}.cornering_stiffness=2e5" for axle in (1, 2)]
    >>> boundaries = speed_boundaries(load_vehicle("interlink", soft))
    >>> len(boundaries)
    1
    """
    matrices = StateMatrices.of(vehicle, model, 1)
    found = speed_brackets(matrices, speeds)
    return tuple(
        _boundary(value, bool(unstable_above), rightmost(matrices.at(value)[0]))
        for value, unstable_above in zip(found.refined(matrices).tolist(), found.unstable_above, strict=True)
    )


def critical_speeds(model: LinearModel) -> Answers:
    """Lowest speed in `SPEEDS` at which an eigenvalue crosses into Re > 0 as the speed rises, if any.

    Parameters
    ----------
    model : LinearModel
        Model of a stack of k vehicles; its speed does not matter.

    Returns
    -------
    Answers
        In m/s.
    """
    count = len(model.state_matrix)
    matrices = StateMatrices.of(model.vehicle, model.model, count)
    found = speed_brackets(matrices).of_first_loss()
    values = np.full(count, np.nan)
    values[found.vehicles] = found.refined(matrices)
    return Answers(values)


def critical_speed(boundaries: Iterable[Boundary]) -> float | None:
    """Return the lowest speed at which an eigenvalue crosses into Re > 0 as the speed rises.

    Parameters
    ----------
    boundaries : iterable of Boundary
        Boundaries from `speed_boundaries`.

    Returns
    -------
    float or None
        Speed [m/s]; None if there is no such speed.

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> from yawdamp_ros.analysis import critical_speed, speed_boundaries
    >>> soft = [f"units.0.axles.{axle}.cornering_stiffness=2e5" for axle in (1, 2)]
    >>> boundaries = speed_boundaries(load_vehicle("interlink", soft))
    >>> round(critical_speed(boundaries), 1)
    17.6
    """
    return next((boundary.value for boundary in boundaries if boundary.unstable_above), None)


def zero_damping_speed(boundaries: Iterable[Boundary]) -> float | None:
    """Return the lowest speed at which the damping ratio of a swinging mode falls to 0.

    It is the zero-damping speed of ISO 14791, of which only the catalogue page was readable.

    Parameters
    ----------
    boundaries : iterable of Boundary
        Boundaries from `speed_boundaries`.

    Returns
    -------
    float or None
        Speed [m/s]; None if there is no such speed.

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> from yawdamp_ros.analysis import speed_boundaries
    >>> soft = [f"units.0.axles.{axle}.cornering_stiffness=2e5" for axle in (1, 2)]
    >>> boundaries = speed_boundaries(load_vehicle("interlink", soft))
    >>> from yawdamp_ros.analysis import zero_damping_speed
    >>> zero_damping_speed(boundaries)
    """
    return next((b.value for b in boundaries if b.unstable_above and b.kind == "oscillatory"), None)


def _boundary(value: float, unstable_above: bool, eigenvalue: complex) -> Boundary:  # noqa: FBT001
    kind: Kind
    if abs(eigenvalue.real) > _JUMP:
        kind, frequency = "jump", 0.0
    elif eigenvalue.imag:
        kind, frequency = "oscillatory", eigenvalue.imag
    else:
        kind, frequency = "monotonic", 0.0
    return Boundary(value, unstable_above, kind, frequency)
