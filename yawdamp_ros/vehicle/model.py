"""A combination as plain records: SI units, positions from the unit's own centre of gravity.

A `Vehicle` some of whose numbers are arrays of one length is a stack of vehicles, alike but for these:
`load_stack` makes one, and the equations of motion of all are assembled at once.
"""

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

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


def unstacked(stack: Vehicle, index: int) -> Vehicle:
    """One vehicle of a stack, its numbers floats."""

    def pick(value: float) -> float:
        return float(value[index]) if isinstance(value, np.ndarray) else value

    def optional(value: float | None) -> float | None:
        return None if value is None else pick(value)

    units = tuple(
        replace(
            unit,
            mass=pick(unit.mass),
            yaw_inertia=pick(unit.yaw_inertia),
            axles=tuple(
                replace(
                    axle,
                    position=pick(axle.position),
                    cornering_stiffness=pick(axle.cornering_stiffness),
                )
                for axle in unit.axles
            ),
            front_hitch=optional(unit.front_hitch),
            rear_hitch=optional(unit.rear_hitch),
        )
        for unit in stack.units
    )
    return replace(stack, speed=pick(stack.speed), units=units)
