"""Units of a straight combination in their places, as drawings show them."""

from typing import NamedTuple

from yawdamp_ros.vehicle import Unit, Vehicle, assumed, complete
from yawdamp_ros.vehicle.shape import extent


class Placed(NamedTuple):
    """Unit in its place.

    Attributes
    ----------
    unit : Unit
        Complete.
    x : float
        Position of its centre of gravity from the lead unit's, forward positive [m].
    rear, front : float
        Ends of its body [m].
    assumed_height : bool
        Whether the height of the centre of gravity is assumed.
    """

    unit: Unit
    x: float
    rear: float
    front: float
    assumed_height: bool


def placed(vehicle: Vehicle) -> list[Placed]:
    """Place the units of a straight combination, each with its defaults filled in."""
    full = complete(vehicle)
    unsure = {each.key for each in assumed(vehicle)}
    places = [0.0]
    for rear_hitch, front_hitch in vehicle.hitches:
        places.append(places[-1] + rear_hitch - front_hitch)
    found = []
    for index, (unit, x) in enumerate(zip(full.units, places, strict=True)):
        rear, front = extent(unit)
        ends = x + rear - (unit.rear_overhang or 0.0), x + front + (unit.front_overhang or 0.0)
        found.append(Placed(unit, x, *ends, f"units.{index}.cg_height" in unsure))
    return found
