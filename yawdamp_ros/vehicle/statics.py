"""Loads of a vehicle at rest on a level road."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from yawdamp_ros.vehicle.model import STANDARD_GRAVITY, Unit, Vehicle


class Supports(NamedTuple):
    """Supports of a unit.

    The lead unit rests on two groups of axles, a towed one on its front hitch and its axles.

    Attributes
    ----------
    front, rear : float
        Positions from the centre of gravity [m]; equal where the unit has one support only.
    front_axles, rear_axles : tuple of int
        Axles of each support; a front hitch has none.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle, supports
    >>> supports(load_vehicle("interlink").units[0])
    Supports(front=0.04, rear=-4.419, front_axles=(0,), rear_axles=(1, 2))
    """

    front: float
    rear: float
    front_axles: tuple[int, ...]
    rear_axles: tuple[int, ...]


class StaticLoads(NamedTuple):
    """Vertical loads of a unit at rest.

    Attributes
    ----------
    axles : tuple of float
        Load of each axle [N].
    front_hitch : float
        Load of the front hitch [N], positive if the unit rests on the one ahead; 0 for the lead unit.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle, static_loads
    >>> truck, trailer = static_loads(load_vehicle("truck_trailer"))
    >>> [round(load) for load in trailer.axles]
    [107591]
    """

    axles: tuple[float, ...]
    front_hitch: float


def supports(unit: Unit) -> Supports:
    """Return the supports of a unit.

    The steered axles of a lead unit are its front support; where all are steered, or none, it is the
    foremost. A towed unit whose axles do not lie behind its front hitch rests on its axles alone.

    Parameters
    ----------
    unit : Unit

    Returns
    -------
    Supports

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle, supports
    >>> found = supports(load_vehicle("interlink").units[0])
    >>> found.front_axles, found.rear_axles
    ((0,), (1, 2))
    """
    positions = [axle.position for axle in unit.axles]

    def centre(group: tuple[int, ...]) -> float:
        return sum(positions[place] for place in group) / len(group)

    front, rear = support_groups(
        positions, [axle.steered for axle in unit.axles], towed=unit.front_hitch is not None
    )
    if unit.front_hitch is not None:
        return Supports(max(unit.front_hitch, centre(rear)), centre(rear), (), rear)
    if not front or centre(front) <= centre(rear):
        every = tuple(range(len(unit.axles)))
        return Supports(centre(every), centre(every), (), every)
    return Supports(centre(front), centre(rear), front, rear)


def support_groups(
    positions: Sequence[Any], steered: Sequence[bool], *, towed: bool
) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Axles of the front and of the rear support of a unit.

    Parameters
    ----------
    positions : sequence of float
        Position of each axle [m], or one for each vehicle of a stack.
    steered : sequence of bool
        Whether each axle is steered.
    towed : bool
        Whether the unit has a front hitch, which then is its front support.

    Returns
    -------
    front, rear : tuple of int
        The front is empty for a towed unit, and for one with a single axle.

    Examples
    --------
    >>> support_groups([3.0, -1.0, -2.0], [True, False, False], towed=False)
    ((0,), (1, 2))
    """
    every = tuple(range(len(positions)))
    if towed:
        return (), every
    front = tuple(place for place in every if steered[place])
    if len(front) in {0, len(every)}:
        front = (max(every, key=lambda place: np.mean(positions[place])),)
    rear = tuple(place for place in every if place not in front)
    return (front, rear) if rear else ((), every)


def static_loads(vehicle: Vehicle, *, given: bool = True) -> tuple[StaticLoads, ...]:
    """Loads of every axle and hitch at rest.

    Axles of one support share it equally. If all axles of a unit have a `static_load`, that is used, and
    the hitch carries the rest.

    Parameters
    ----------
    vehicle : Vehicle
    given : bool
        Whether loads of the file are taken; else all follow from masses and positions.

    Returns
    -------
    tuple of StaticLoads
        Loads of each unit, foremost first. A negative load is set to zero: such a unit would tip.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> round(static_loads(load_vehicle("a_double"))[1].front_hitch)  # on the tractor's fifth wheel, N
    140165
    """
    found: list[StaticLoads] = []
    behind = 0.0
    for unit in reversed(vehicle.units):
        loads = _unit_loads(unit, behind, given=given)
        behind = loads.front_hitch
        found.insert(0, loads)
    return tuple(found)


def _unit_loads(unit: Unit, behind: float, *, given: bool) -> StaticLoads:
    weight = STANDARD_GRAVITY * unit.mass
    loads = tuple(axle.static_load for axle in unit.axles if axle.static_load is not None)
    towed = unit.front_hitch is not None
    if given and len(loads) == len(unit.axles):
        return StaticLoads(loads, weight + behind - sum(loads) if towed else 0.0)
    held = supports(unit)
    on_front = 0.0
    if held.front != held.rear:
        rear_hitch = unit.rear_hitch or 0.0
        on_front = (behind * (rear_hitch - held.rear) - weight * held.rear) / (held.front - held.rear)
    on_rear = weight + behind - on_front
    axles = [0.0] * len(unit.axles)
    for load, group in ((on_front, held.front_axles), (on_rear, held.rear_axles)):
        for place in group:
            axles[place] = max(load / len(group), 0.0)
    return StaticLoads(tuple(axles), on_front if towed else 0.0)
