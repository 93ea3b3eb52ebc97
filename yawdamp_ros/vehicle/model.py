"""A combination as plain records: SI units, positions from the unit's own centre of gravity."""

from dataclasses import dataclass
from itertools import pairwise

STANDARD_GRAVITY = 9.80665
"""In m/s^2."""


@dataclass(frozen=True)
class Axle:
    """One axle, or a group of wheels at one position, of the one-track model.

    Attributes
    ----------
    position : float
        Distance from the unit's centre of gravity in m, forward positive.
    cornering_stiffness : float
        Of the whole axle, in N/rad, positive.
    steered : bool
        Whether the road-wheel steer angle acts on it.
    """

    position: float
    cornering_stiffness: float
    steered: bool = False


@dataclass(frozen=True)
class Unit:
    """One rigid unit of a combination: a truck, a trailer or a dolly.

    Attributes
    ----------
    name : str
        Name in topics, columns and tables.
    mass : float
        In kg.
    yaw_inertia : float
        About the vertical axis through the centre of gravity, in kg m^2.
    axles : tuple of Axle
    front_hitch, rear_hitch : float or None
        Distance from the centre of gravity in m, forward positive; None where there is none.
    """

    name: str
    mass: float
    yaw_inertia: float
    axles: tuple[Axle, ...]
    front_hitch: float | None = None
    rear_hitch: float | None = None


@dataclass(frozen=True)
class Vehicle:
    """A combination of units, foremost first.

    Attributes
    ----------
    name : str
    speed : float
        The longitudinal speed at which it is looked at unless another is asked for, in m/s.
    units : tuple of Unit
        Each towed by the one before it.
    """

    name: str
    speed: float
    units: tuple[Unit, ...]

    @property
    def unit_names(self) -> tuple[str, ...]:
        """Names of the units, foremost first."""
        return tuple(unit.name for unit in self.units)

    @property
    def hitches(self) -> tuple[tuple[float, float], ...]:
        """Each coupling as (rear hitch of the towing unit, front hitch of the towed unit), in m.

        Raises
        ------
        ValueError
            If a unit lacks a hitch it needs, which `load_vehicle` does not let through.
        """
        pairs = []
        for towing, towed in pairwise(self.units):
            if towing.rear_hitch is None or towed.front_hitch is None:
                message = f"no hitch between {towing.name} and {towed.name}"
                raise ValueError(message)
            pairs.append((towing.rear_hitch, towed.front_hitch))
        return tuple(pairs)
