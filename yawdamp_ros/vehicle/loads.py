"""Effect of loads on a unit: mass, centre of gravity, inertia, and the loads of its axles.

A unit is described without its loads, positions from its unladen centre of gravity. Loads add mass, move
the centre of gravity, and add inertia by the parallel-axis theorem. Hitches and axles stay where they are
on the unit: only the point that they are measured from moves.

Statics gives the axle loads, from the rear of the combination to its front. A towed unit rests on its front
hitch and on its axles; a lead unit rests on its steered axles and on the others. Every hitch is assumed to
carry vertical force and no moment. The axles of a group share their load equally, as in a compensated
suspension. The file gives the unladen axle loads. Only the added loads are computed, because published axle
loads need not be consistent with the published geometry.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

from yawdamp_ros.vehicle.model import STANDARD_GRAVITY
from yawdamp_ros.vehicle.statics import support_groups

Number = Any
"""A float, or an array that holds one for each vehicle of a stack: the formulas are the same."""


class LoadedUnit(NamedTuple):
    """A unit with its loads.

    Attributes
    ----------
    mass : float
        Mass [kg].
    yaw_inertia : float
        Yaw inertia about the loaded unit's centre of gravity [kg m^2].
    shift : float
        Displacement of the centre of gravity by the loads, forward positive [m].
    """

    mass: Number
    yaw_inertia: Number
    shift: Number


def loaded(unit: dict[str, Any]) -> LoadedUnit:
    """Mass, inertia and centre of gravity of a unit of a vehicle file with its loads."""
    parts = [
        (unit["mass"], 0.0, unit["yaw_inertia"]),
        *((load["mass"], load["position"], load.get("yaw_inertia", 0.0)) for load in unit.get("load", ())),
    ]
    mass = sum(mass for mass, _, _ in parts)
    shift = sum(mass * position for mass, position, _ in parts) / mass
    inertia = sum(own + mass * (position - shift) ** 2 for mass, position, own in parts)
    return LoadedUnit(mass, inertia, shift)


def added_axle_loads(units: Sequence[dict[str, Any]]) -> list[list[Number]]:
    """Return the load that the loads of a vehicle file add to every axle.

    Parameters
    ----------
    units : sequence of dict
        Units of the file, foremost first, with the hitches that they need.

    Returns
    -------
    list of list of float
        Added load of each axle of each unit [N]; negative if a load relieves an axle.
    """
    added: list[list[Number]] = []
    # Vertical load of the unit behind on this unit's rear hitch.
    weight: Number = 0.0
    for index in reversed(range(len(units))):
        unit = units[index]
        forces = [(STANDARD_GRAVITY * load["mass"], load["position"]) for load in unit.get("load", ())]
        if "rear_hitch" in unit:
            forces.append((weight, unit["rear_hitch"]))
        front, rear = axle_groups(unit, towed=index > 0)
        ahead = unit["front_hitch"] if index else centre(unit, front)
        behind = centre(unit, rear)
        total = sum(force for force, _ in forces)
        on_rear = sum(force * (ahead - position) for force, position in forces) / (ahead - behind)
        weight = total - on_rear
        added.insert(
            0,
            [
                weight / len(front) if axle in front else on_rear / len(rear)
                for axle in range(len(unit["axles"]))
            ],
        )
    return added


def static_load(axle: dict[str, Any], added: Number) -> Number | None:
    """Load at rest that a vehicle file gives for an axle.

    Parameters
    ----------
    axle : dict
        Axle of the vehicle file.
    added : float
        Load added to the axle by the loads of the file [N].

    Returns
    -------
    float or None
        Load [N]: the ``static_load``, else that of the tyres, else None.
    """
    if "static_load" in axle:
        return axle["static_load"] + added
    if "tyre_load" in axle:
        return axle["tyre_load"] * axle["tyres"] + added
    return None


def axle_groups(unit: dict[str, Any], *, towed: bool) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Axles of the front and of the rear support of a unit of a vehicle file, as `support_groups`."""
    positions = [axle["position"] for axle in unit["axles"]]
    steered = [axle.get("steered") is True for axle in unit["axles"]]
    return support_groups(positions, steered, towed=towed)


def centre(unit: dict[str, Any], group: Sequence[int]) -> Number:
    """Middle of some axles of a unit of a vehicle file [m]."""
    return sum(unit["axles"][index]["position"] for index in group) / len(group)
