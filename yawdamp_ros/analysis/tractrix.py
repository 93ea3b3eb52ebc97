"""The low-speed turn: every unit on its tractrix behind an outer front tyre that follows a road's corner.

At walking speed tyres roll where they point. The middle of the unsteered axles of a unit then moves along the
unit, and its heading follows the point that leads it,

``psi' = sin(theta - psi) / l``

per distance of the guided tyre for the lead unit (theta the direction of its path, l the distance from the
middle axle), and ``psi' = (velocity of the hitch across the unit) / l`` for a towed one. Axles that steer
against the articulation move aside, and that is taken off the hitch's velocity. Positions follow from the
headings by the exact chain.
"""

import math
from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.vehicle import Axle, Vehicle, complete, supports
from yawdamp_ros.vehicle.complete import is_dolly
from yawdamp_ros.vehicle.shape import extent

RADIUS = 12.5
"""Radius of the path of the outer front tyre's outer wall in PBS's turn [m]."""
RIGHT_ANGLE = 0.5 * math.pi
STEP = 0.05
"""Longest step of the guided tyre [m]; Runge-Kutta's error is below a micrometre."""
SAME = 1e-6
"""Lengths that differ by less are the same [m]: loads move the centre of gravity, not the axles."""


class UnitGeometry(NamedTuple):
    """Geometry of a unit in the turn; lengths from the middle of its unsteered axles, forward positive [m].

    Attributes
    ----------
    leader : float
        Position of the front hitch, or of the lead unit's foremost steered axle.
    hitch : float
        Position of the rear hitch; 0 without one.
    front, rear : float
        Ends of the body.
    half_width : float
        Half the width of the body or the tyres, whichever is wider.
    guide : float
        Distance from the middle to the outer wall of the steered tyre; 0 for a towed unit.
    body : bool
        Whether the unit has a body: a dolly has none that swings.
    gains : tuple of float
        Steer angle of each unsteered axle over the articulation of the front hitch, against it; empty where
        none steers.
    """

    leader: float
    hitch: float
    front: float
    rear: float
    half_width: float
    guide: float
    body: bool
    gains: tuple[float, ...] = ()

    def aside(self, articulation: float) -> float:
        """Velocity of the middle across the unit, over that along it."""
        return -math.fsum(math.tan(gain * articulation) for gain in self.gains) / max(len(self.gains), 1)


class Turn(NamedTuple):
    """A turn to the left.

    Attributes
    ----------
    geometry : tuple of UnitGeometry
        Geometry of n units.
    radius : float
        Radius of the guided tyre's path [m], whose arc begins at the origin along x.
    angle : float
        Angle of the arc [rad].
    way : ndarray, shape (m,)
        Distance of the guided tyre from the beginning of the arc [m].
    yaw : ndarray, shape (m, n)
        Yaw angles [rad].
    position : ndarray of complex, shape (m, n)
        Position of the middles of the unsteered axles, x + i y [m].
    steering : ndarray, shape (m,)
        Road-wheel angle of the steered axle in its middle [rad].

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> turn = low_speed_turn(load_vehicle("interlink"))
    >>> x, y = turn.path(2, 0.0, 0.0)  # of the middle of the last unit's axles
    >>> bool(x[-1] > 10.0)
    True
    """

    geometry: tuple[UnitGeometry, ...]
    radius: float
    angle: float
    way: FloatArray
    yaw: FloatArray
    position: "np.ndarray[tuple[int, ...], np.dtype[np.complex128]]"
    steering: FloatArray

    @property
    def bodies(self) -> list[int]:
        """Units that have a body."""
        return [index for index, unit in enumerate(self.geometry) if unit.body]

    def path(self, unit: int, forward: float, left: float) -> tuple[FloatArray, FloatArray]:
        """Path of a point of a unit.

        Parameters
        ----------
        unit : int
        forward, left : float
            Position from the middle of its unsteered axles [m].

        Returns
        -------
        x, y : ndarray, shape (m,)
            Coordinates [m].
        """
        point = self.position[:, unit] + complex(forward, left) * np.exp(1j * self.yaw[:, unit])
        return point.real, point.imag


def low_speed_turn(vehicle: Vehicle, radius: float = RADIUS, angle: float = RIGHT_ANGLE) -> Turn:
    """Lead a vehicle through a turn at walking speed.

    The outer wall of the outer front tyre follows a straight road, an arc and a straight road.

    Parameters
    ----------
    vehicle : Vehicle
        Vehicle; missing overhangs, widths and tracks are assumed (`yawdamp_ros.vehicle.assumed`).
    radius : float
        Radius of the arc [m].
    angle : float
        Angle of the arc [rad].

    Returns
    -------
    Turn

    Raises
    ------
    AnalysisError
        If the vehicle has no two groups of axles to turn about, or cannot turn so tightly.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> turn = low_speed_turn(load_vehicle("interlink"))
    >>> bool(turn.yaw[-1, 0] > 1.57)  # the truck has turned by a right angle
    True
    """
    return _turn(tuple(_geometry(vehicle)), radius, angle)


def _geometry(vehicle: Vehicle) -> Iterator[UnitGeometry]:
    full = complete(vehicle)
    for index, unit in enumerate(full.units):
        held = supports(unit)
        if held.front - held.rear < SAME:
            message = f"{vehicle.name}: {unit.name}: no two supports to turn about"
            raise AnalysisError(message)
        steered = [axle for axle in unit.axles if axle.steered]
        rolling = [axle for axle in unit.axles if not (axle.steered or axle.self_steering)]
        middle = sum(axle.position for axle in rolling) / len(rolling) if rolling else held.rear
        gains = tuple(axle.low_speed_steering for axle in rolling)
        tail, nose = extent(unit)
        foremost = max(steered, key=lambda axle: axle.position) if index == 0 else None
        lengths = (
            (foremost.position if foremost else held.front) - middle,
            0.0 if unit.rear_hitch is None else unit.rear_hitch - middle,
            nose + (unit.front_overhang or 0.0) - middle,
            tail - (unit.rear_overhang or 0.0) - middle,
            max([0.5 * (unit.width or 0.0), *map(_outside, unit.axles)]),
            _outside(foremost) if foremost else 0.0,
        )
        leader, hitch, front, rear, half_width, guide = (round(length / SAME) * SAME for length in lengths)
        yield UnitGeometry(
            leader, hitch, front, rear, half_width, guide, not is_dolly(unit), gains if any(gains) else ()
        )


def _outside(axle: Axle) -> float:
    """Outer wall of the tyres from the middle of the axle [m]."""
    return 0.5 * ((axle.track_width or 0.0) + (axle.tyre_width or 0.0))


@lru_cache(maxsize=64)
def _turn(geometry: tuple[UnitGeometry, ...], radius: float, angle: float) -> Turn:
    if radius <= geometry[0].leader:
        message = (
            f"the lead unit is {geometry[0].leader:.2f} m from axle to axle: it cannot turn on {radius:g} m"
        )
        raise AnalysisError(message)
    arc = radius * angle
    length = sum(unit.leader - min(unit.hitch, 0.0) for unit in geometry)
    exit_way = 2.0 * length + 10.0
    parts = [(arc, max(math.ceil(arc / STEP), 1)), (exit_way, math.ceil(exit_way / STEP))]
    way, yaw = [0.0], [[0.0] * len(geometry)]
    for number, (distance, steps) in enumerate(parts):
        step, start = distance / steps, arc * number
        for place in range(steps):
            begin = start + place * step
            # The direction of the path has a kink where a part ends, never within a step.
            directions = [
                (begin + share * step) / radius if number == 0 else angle for share in (0.0, 0.5, 1.0)
            ]
            yaw.append(_stepped(yaw[-1], directions, step, geometry))
            way.append(begin + step)
    return _placed(geometry, radius, angle, np.array(way), np.array(yaw))


def _stepped(
    yaw: Sequence[float], directions: Sequence[float], step: float, geometry: Sequence[UnitGeometry]
) -> list[float]:
    """One step of the classical Runge-Kutta method."""
    begin, middle, end = directions
    k1 = _rates(yaw, begin, geometry)
    k2 = _rates([a + 0.5 * step * b for a, b in zip(yaw, k1, strict=True)], middle, geometry)
    k3 = _rates([a + 0.5 * step * b for a, b in zip(yaw, k2, strict=True)], middle, geometry)
    k4 = _rates([a + step * b for a, b in zip(yaw, k3, strict=True)], end, geometry)
    return [
        a + step / 6.0 * (p + 2.0 * q + 2.0 * r + s)
        for a, p, q, r, s in zip(yaw, k1, k2, k3, k4, strict=True)
    ]


def _rates(yaw: Sequence[float], direction: float, geometry: Sequence[UnitGeometry]) -> list[float]:
    """Yaw of every unit per distance of the guided tyre."""
    lead = geometry[0]
    rates = [math.sin(direction - yaw[0]) / lead.leader]
    # The guided tyre is on the right, the outside of a turn to the left.
    forward, aside = math.cos(direction - yaw[0]) - lead.guide * rates[0], 0.0
    for ahead, unit, mine, own in zip(geometry, geometry[1:], yaw, yaw[1:], strict=False):
        angle, across = mine - own, aside + ahead.hitch * rates[-1]
        sideways = forward * math.sin(angle) + across * math.cos(angle)
        forward = forward * math.cos(angle) - across * math.sin(angle)
        aside = forward * unit.aside(angle)
        rates.append((sideways - aside) / unit.leader)
    return rates


def _placed(
    geometry: tuple[UnitGeometry, ...], radius: float, angle: float, way: FloatArray, yaw: FloatArray
) -> Turn:
    """Positions by the chain, from the guided tyre backwards."""
    turned = np.clip(way / radius, 0.0, angle)
    arc = radius * (np.sin(turned) + 1j * (1.0 - np.cos(turned)))
    beyond = np.maximum(way - radius * angle, 0.0)
    guide = arc + beyond * np.exp(1j * angle)
    heading = np.exp(1j * yaw)
    lead = geometry[0]
    places = [guide - complex(lead.leader, -lead.guide) * heading[:, 0]]
    for unit in range(1, len(geometry)):
        hitch = places[-1] + geometry[unit - 1].hitch * heading[:, unit - 1]
        places.append(hitch - geometry[unit].leader * heading[:, unit])
    rate = np.sin(turned - yaw[:, 0]) / lead.leader
    forward = np.cos(turned - yaw[:, 0]) - lead.guide * rate
    steering = np.arctan2(lead.leader * rate, forward)
    return Turn(geometry, radius, angle, way, yaw, np.column_stack(places), steering)
