"""Outline of a unit, as far as its file gives it."""

from yawdamp_ros.vehicle.model import Unit

WIDTH = 2.5
"""Width of every unit's outline [m], the usual width of heavy vehicles."""
HEIGHT = 1.5
"""Height of every unit's outline [m], for pictures only."""

GROUND_FRAME = "odom"
"""Name of the frame of the ground."""


def extent(unit: Unit) -> tuple[float, float]:
    """Rearmost and foremost axle or hitch of a unit [m] from its centre of gravity."""
    hitches = [hitch for hitch in (unit.front_hitch, unit.rear_hitch) if hitch is not None]
    positions = [*(axle.position for axle in unit.axles), *hitches]
    return min(positions), max(positions)


def hitch_frame(towed: str) -> str:
    """Name of the frame at the front hitch of a towed unit, turned as the unit is."""
    return f"{towed}_hitch"


def steered_axle_link(lead: str) -> str:
    """Name of the link that turns as the steered wheels of the lead unit do."""
    return f"{lead}_steered_axle"
