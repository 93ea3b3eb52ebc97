"""Random vehicles by the thousand, for what has to hold of all and would take Hypothesis too long."""

from collections.abc import Sequence
from dataclasses import fields, replace

import numpy as np

from yawdamp_ros.vehicle import Axle, Unit, Vehicle, load_vehicle

BUILT_IN = tuple(
    map(load_vehicle, ("a_double", "interlink", "interlink_rated_tyres", "truck_trailer", "single_vehicle"))
)


def made_up(generator: np.random.Generator, units: tuple[int, int] = (1, 5)) -> Vehicle:
    """Units with any number of axles anywhere; most of these are unstable at speed."""
    count = int(generator.integers(*units, endpoint=True))

    def axle(front: float, *, steered: bool) -> Axle:
        return Axle(generator.uniform(front, 4.0), generator.uniform(5e4, 1e6), steered=steered)

    def unit(index: int) -> Unit:
        axles = [axle(-6.0, steered=False) for _ in range(generator.integers(1, 3, endpoint=True))]
        return Unit(
            f"unit_{index}",
            generator.uniform(5e2, 4e4),
            generator.uniform(1e3, 6e5),
            (*axles, axle(0.5, steered=True)) if index == 0 else tuple(axles),
            generator.uniform(0.5, 8.0) if index else None,
            generator.uniform(-8.0, -0.5) if index < count - 1 else None,
        )

    return Vehicle("random", generator.uniform(2.0, 40.0), tuple(map(unit, range(count))))


def built_in_but_changed(generator: np.random.Generator, name: str | None = None) -> Vehicle:
    """One of those that come with the package, its numbers changed by factors and metres."""
    known = [vehicle for vehicle in BUILT_IN if name in {None, vehicle.name}]
    vehicle = known[generator.integers(len(known))]

    def times(value: float, spread: float) -> float:
        return float(value * np.exp(generator.uniform(-spread, spread)))

    def moved(position: float | None, most: float) -> float | None:
        return None if position is None else position + generator.uniform(-most, most)

    def changed(unit: Unit) -> Unit:
        return replace(
            unit,
            mass=times(unit.mass, 1.0),
            yaw_inertia=times(unit.yaw_inertia, 1.0),
            axles=tuple(
                replace(
                    axle,
                    position=axle.position + generator.uniform(-1.0, 1.0),
                    cornering_stiffness=times(axle.cornering_stiffness, 1.5),
                )
                for axle in unit.axles
            ),
            front_hitch=moved(unit.front_hitch, 1.5),
            rear_hitch=moved(unit.rear_hitch, 1.5),
        )

    return replace(vehicle, units=tuple(map(changed, vehicle.units)))


def stacked(vehicles: Sequence[Vehicle]) -> Vehicle:
    """Vehicles of one shape as a stack of them."""

    def together(values: Sequence[object]) -> object:
        first = values[0]
        if isinstance(first, bool | str | None):
            return first
        if isinstance(first, float):
            return np.array(values)
        if isinstance(first, tuple):
            return tuple(map(together, zip(*values, strict=True)))
        names = [field.name for field in fields(first)]
        return replace(first, **{name: together([getattr(each, name) for each in values]) for name in names})

    return together(vehicles)
