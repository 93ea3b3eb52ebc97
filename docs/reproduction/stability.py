"""The numbers behind the report's tables and its section 5.7."""

from collections.abc import Callable, Sequence
from functools import cache

import numpy as np

from yawdamp_ros import linear_model, load_vehicle
from yawdamp_ros.analysis import Boundary, Locus, eigenvalue_locus, parse_variation, rightmost
from yawdamp_ros.dynamics import LinearModel

SPEED = 80.0 / 3.6

AXLES = [(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (2, 0), (2, 1)]
"""Unit and axle of the report's axles 1 to 7, counted from 0."""


def stiffness(*axles: int) -> str:
    """Keys of the report's axles, tied."""
    places = (AXLES[axle - 1] for axle in axles)
    return ",".join(f"units.{unit}.axles.{axle}.cornering_stiffness" for unit, axle in places)


@cache
def locus(variation: str, model: str) -> Locus:
    """Locus of the interlink at 80 km/h over ``KEY=A:B:N``."""
    parsed = parse_variation(variation)
    models = parsed.models("interlink", [f"speed={SPEED!r}"], model)
    return eigenvalue_locus(models, parsed.values)


def shifted(unit: int, model: str) -> Callable[[float], LinearModel]:
    """Interlink at 80 km/h with a unit's centre of gravity so many m forward, everything else in place."""
    original = load_vehicle("interlink").units[unit]

    def at(forward: float) -> LinearModel:
        moved = {
            "front_hitch": original.front_hitch,
            "rear_hitch": original.rear_hitch,
            **{f"axles.{index}.position": axle.position for index, axle in enumerate(original.axles)},
        }
        overrides = [
            f"units.{unit}.{key}={value - forward!r}" for key, value in moved.items() if value is not None
        ]
        return linear_model(load_vehicle("interlink", overrides), SPEED, model)

    return at


@cache
def truck_mass_boundaries(model: str) -> tuple[Boundary, ...]:
    """Truck masses in kg, its yaw inertia in proportion, at which stability changes at 80 km/h."""
    truck = load_vehicle("interlink").units[0]

    def at(mass: float) -> LinearModel:
        inertia = truck.yaw_inertia * mass / truck.mass
        overrides = [f"units.0.mass={mass!r}", f"units.0.yaw_inertia={inertia!r}"]
        return linear_model(load_vehicle("interlink", overrides), SPEED, model)

    return eigenvalue_locus(at, np.linspace(1000.0, 9200.0, 41).tolist()).boundaries


@cache
def shift_boundaries(unit: int, model: str) -> tuple[Boundary, ...]:
    """Shifts of a unit's centre of gravity, 1 m rearward to 1 m forward, at which stability changes."""
    return eigenvalue_locus(shifted(unit, model), np.linspace(-1.0, 1.0, 41).tolist()).boundaries


def largest_real_part(vehicle: str, overrides: Sequence[str], model: str, speed: float = SPEED) -> float:
    """Largest real part of a vehicle's eigenvalues in 1/s."""
    return rightmost(linear_model(load_vehicle(vehicle, overrides), speed, model).state_matrix).real


def static_front_axle_load() -> float:
    """Static load of the interlink's front axle in N, each axle pair shared equally."""
    gravity = 9.81
    load = 0.0
    for unit in reversed(load_vehicle("interlink").units):
        first = unit.axles[0].position if unit.front_hitch is None else unit.front_hitch
        pair = np.mean([axle.position for axle in unit.axles[-2:]])
        # Moments about the pair: what the coupling or front axle ahead of it has to carry.
        moment = unit.mass * gravity * (0.0 - pair)
        if unit.rear_hitch is not None:
            moment += load * (unit.rear_hitch - pair)
        load = float(moment / (first - pair))
    return load
