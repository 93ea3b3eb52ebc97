"""Swept width of a turning vehicle, and the swings of its corners.

Everything is measured across the path of the guided tyre (`low_speed_turn`): inwards is positive. A side of a
body is furthest in abreast of its unsteered axles, for there it moves along itself; furthest out are corners.
Where axles steer, that place moves along the side.

The definitions are those of the Australian PBS scheme, read in short at nhvr.gov.au and else in secondary
sources: Standards and Vehicle Assessment Rules, 2008.
"""

import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.analysis.tractrix import RIGHT_ANGLE, Turn, low_speed_turn
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.vehicle import Vehicle

STATIONS = 4000
"""Places along the guided path at which widths are taken."""
SIDES = 61
"""Points of the side of a unit whose axles steer."""


def low_speed_swept_path(vehicle: Vehicle) -> float:
    """Largest width that the vehicle sweeps, across the path of the outer front tyre [m].

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    float

    Raises
    ------
    AnalysisError
        If the vehicle cannot turn so.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> 5.0 < low_speed_swept_path(load_vehicle("tractor_semitrailer")) < 7.0
    True
    """
    inner, outer = envelope(low_speed_turn(vehicle))
    return float((inner - outer).max())


def frontal_swing(vehicle: Vehicle) -> float:
    """Largest swing of the lead unit's front corner out of the path of the outer front tyre [m].

    Parameters
    ----------
    vehicle : Vehicle
        As for `low_speed_swept_path`.

    Returns
    -------
    float

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> 0.0 < frontal_swing(load_vehicle("interlink")) < 1.0
    True
    """
    return float(front_swing(low_speed_turn(vehicle), 0).max())


def frontal_swing_maximum_of_differences(vehicle: Vehicle) -> float | None:
    """Largest excess of a trailer's frontal swing over that of the unit ahead, at one place [m].

    A unit that stays within the path of the outer front tyre counts as 0.

    Parameters
    ----------
    vehicle : Vehicle
        As for `low_speed_swept_path`.

    Returns
    -------
    float or None
        Largest value of all trailers; None if no trailer has a body.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> frontal_swing_maximum_of_differences(load_vehicle("single_vehicle")) is None
    True
    """
    return max((float((behind - ahead).max()) for ahead, behind in _swings(vehicle)), default=None)


def frontal_swing_difference_of_maxima(vehicle: Vehicle) -> float | None:
    """Largest frontal swing of a trailer less that of the unit ahead [m].

    Parameters
    ----------
    vehicle : Vehicle
        As for `low_speed_swept_path`.

    Returns
    -------
    float or None
        Largest value of all trailers; None if no trailer has a body.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> frontal_swing_difference_of_maxima(load_vehicle("interlink")) < 0.0  # the truck swings further
    True
    """
    return max((float(behind.max() - ahead.max()) for ahead, behind in _swings(vehicle)), default=None)


def tail_swing(vehicle: Vehicle) -> float:
    """Largest swing of a rear corner out of the straight way that it came, as the turn begins [m].

    Parameters
    ----------
    vehicle : Vehicle
        As for `low_speed_swept_path`.

    Returns
    -------
    float
        Largest value of the units that have a body.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> longer = load_vehicle("interlink", ["units.trailer_2.rear_overhang=4"])
    >>> tail_swing(longer) > tail_swing(load_vehicle("interlink"))
    True
    """
    turn = low_speed_turn(vehicle)
    return max((float(rear_swing(turn, index).max()) for index in turn.bodies), default=0.0)


def rear_swing(turn: Turn, unit: int) -> FloatArray:
    """Swing of a unit's rear corner out of the straight way that it came.

    Parameters
    ----------
    turn : Turn
    unit : int

    Returns
    -------
    ndarray, shape (m,)
        In m, along the guided tyre's way; negative within.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> float(rear_swing(low_speed_turn(load_vehicle("interlink")), 0)[0])
    0.0
    """
    own = turn.geometry[unit]
    _, y = turn.path(unit, own.rear, -own.half_width)
    return np.asarray(y[0] - y)


def envelope(turn: Turn) -> tuple[FloatArray, FloatArray]:
    """Innermost and outermost of all that is swept, across the guided path.

    Parameters
    ----------
    turn : Turn

    Returns
    -------
    inner, outer : ndarray, shape (STATIONS,)
        Inwards positive, at even stations along the guided path [m].

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> inner, outer = envelope(low_speed_turn(load_vehicle("interlink")))
    >>> bool(inner.max() > 6.0 > 0.0 >= outer.max())
    True
    """
    places = stations(turn)
    inner = np.full(STATIONS, -np.inf)
    outer = np.zeros(STATIONS)
    for index, unit in enumerate(turn.geometry):
        for forward in np.linspace(unit.rear, unit.front, SIDES) if unit.gains else (0.0,):
            inner = np.maximum(inner, _across(turn, index, float(forward), unit.half_width, places))
        for end in (unit.front, unit.rear):
            if unit.body:
                outer = np.minimum(outer, _across(turn, index, end, -unit.half_width, places))
    return inner, outer


def stations(turn: Turn) -> FloatArray:
    """Places along the guided path at which widths are taken.

    Parameters
    ----------
    turn : Turn

    Returns
    -------
    ndarray, shape (STATIONS,)
        From the beginning of the arc [m].

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> stations(low_speed_turn(load_vehicle("interlink"))).shape
    (4000,)
    """
    back = sum(unit.leader for unit in turn.geometry)
    return np.linspace(-back, float(turn.way[-1]), STATIONS)


def _swings(vehicle: Vehicle) -> Iterator[tuple[FloatArray, FloatArray]]:
    """Front swings of each unit with a body and of the next one behind it that has one."""
    turn = low_speed_turn(vehicle)
    return pairwise([front_swing(turn, index) for index in turn.bodies])


def front_swing(turn: Turn, unit: int) -> FloatArray:
    """Swing of a unit's front corner at every station, 0 within the guided path.

    Parameters
    ----------
    turn : Turn
    unit : int

    Returns
    -------
    ndarray, shape (STATIONS,)
        In m, at the `stations`.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> turn = low_speed_turn(load_vehicle("interlink"))
    >>> bool(front_swing(turn, 0).max() == frontal_swing(load_vehicle("interlink")))
    True
    """
    own = turn.geometry[unit]
    return np.maximum(-_across(turn, unit, own.front, -own.half_width, stations(turn)), 0.0)


def _across(turn: Turn, unit: int, forward: float, left: float, places: FloatArray) -> FloatArray:
    """Distance of a point's path from the guided path at stations along it, inwards positive [m]."""
    way, inwards = along_guide(turn, *turn.path(unit, forward, left))
    return np.interp(places, np.maximum.accumulate(way), inwards)


def along_guide(turn: Turn, x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Places along the guided path of a right-angled turn, and distances across it.

    A point beyond the centre of the arc lies on the line that runs on through it.

    Parameters
    ----------
    turn : Turn
    x, y : ndarray, shape (m,)
        Coordinates [m].

    Returns
    -------
    way, inwards : ndarray, shape (m,)
        Distances along the path and inwards [m].

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> turn = low_speed_turn(load_vehicle("interlink"))
    >>> [float(value[0]) for value in along_guide(turn, np.array([-2.0]), np.array([0.5]))]
    [-2.0, 0.5]
    """
    if not math.isclose(turn.angle, RIGHT_ANGLE):
        message = f"turn of {math.degrees(turn.angle):g} degrees: swept paths are measured in one of 90"
        raise AnalysisError(message)
    radius = turn.radius
    up = y - radius
    distance = np.hypot(x, up)
    places = [(x >= 0.0) & (up <= 0.0), (x < 0.0) & (up > 0.0), x < 0.0]
    way = np.select(
        places,
        [radius * np.arctan2(x, -up), radius * np.arctan2(-x, up), x],
        radius * RIGHT_ANGLE + up,
    )
    inwards = np.select(places, [radius - distance, radius + distance, y], radius - x)
    return way, inwards


def on_guide(turn: Turn, way: FloatArray, inwards: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Points by their place along the guided path and their distance across it: `along_guide` backwards.

    Parameters
    ----------
    turn : Turn
    way, inwards : ndarray, shape (m,)
        Distances along the path and inwards [m].

    Returns
    -------
    x, y : ndarray, shape (m,)
        Coordinates [m].

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> turn = low_speed_turn(load_vehicle("interlink"))
    >>> [float(value[0]) for value in on_guide(turn, np.array([-2.0]), np.array([0.5]))]
    [-2.0, 0.5]
    """
    turned = np.clip(way / turn.radius, 0.0, turn.angle)
    heading = np.exp(1j * turned)
    before, beyond = np.minimum(way, 0.0), np.maximum(way - turn.radius * turn.angle, 0.0)
    guide = turn.radius * (np.sin(turned) + 1j * (1.0 - np.cos(turned))) + before + beyond * heading
    point = guide + 1j * inwards * heading
    return point.real, point.imag
