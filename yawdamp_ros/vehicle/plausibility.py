"""Checks that the numbers of a vehicle can be those of a heavy vehicle in SI units.

A file in which one number is in tonnes or in kN/rad is a valid file of another vehicle. What such a mistake
does to axle loads, and to the ratio of stiffness to load, which is 3 to 12 per rad for truck tyres as they
are usually loaded, gives it away. What may be meant is doubted; what no vehicle can be is refused.
"""

import math
from collections.abc import Iterator
from itertools import chain
from typing import NamedTuple

from yawdamp_ros.vehicle.errors import VehicleError
from yawdamp_ros.vehicle.model import STANDARD_GRAVITY, Unit, Vehicle
from yawdamp_ros.vehicle.statics import static_loads

AXLE_LOADS = (1.0, 20.0)
"""Plausible static load of an axle [t]."""
STIFFNESS_RATIOS = (2.0, 12.0)
"""Plausible cornering stiffness over static load [1/rad]. OpenPBS's tyre has 5.5, Fancher's up to 5.7, and
2.2 under the report's front axle, whose load by statics is twice what its tyres are rated for."""
FASTEST = 40.0
"""Highest plausible speed of a heavy vehicle [m/s]."""

LEAST_RATIO = 0.25
"""Stiffness over mean axle load below which a tyre carries almost no side force [1/rad]."""
LARGEST_UNIT_RATIO = 1000.0
"""A unit's stiffness over its weight beyond which its mass is in other units [1/rad]; a dolly has 30."""
LARGEST_MEAN_LOAD = 100.0
"""Mean axle load that no road vehicle has [t]."""
GYRATION = (0.1, 1.0)
"""Plausible radius of gyration over the length from the foremost to the rearmost axle or hitch."""
POSSIBLE_GYRATION = (0.02, 10.0)

_GUESSES = (
    (2.0, "is it of one tyre? It is of the whole axle"),
    (4.0, "is it of one tyre? It is of the whole axle"),
    (9.81, "is it in kgf/rad, or the tyre load in kg?"),
    (math.degrees(1.0), "is it in N/deg?"),
    (1e3, "is it in kN/rad, or the tyre load in kN?"),
    (math.degrees(1e3), "is it in kN/deg?"),
)
"""Factors that a stiffness may lack, and the mistake behind each."""


class Suspicion(NamedTuple):
    """Implausible number of a vehicle.

    Attributes
    ----------
    rule : str
        Rule that it breaks.
    key : str
        Path of the number, as `--set` takes it.
    problem : str
        Value, what was expected, and the likely mistake.
    impossible : bool
        Whether the value is impossible for any vehicle.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle, suspicions
    >>> suspicions(load_vehicle("truck_trailer", ["speed=60"]))[0].key
    'speed'
    """

    rule: str
    key: str
    problem: str
    impossible: bool = False


def suspicions(vehicle: Vehicle) -> tuple[Suspicion, ...]:
    """Find the implausible numbers of a vehicle.

    Parameters
    ----------
    vehicle : Vehicle
        One vehicle, no stack.

    Returns
    -------
    tuple of Suspicion
        Suspicions in the order of inspection: the cause of one may also cause those after it.

    Examples
    --------
    >>> from yawdamp_ros import load_vehicle
    >>> suspicions(load_vehicle("a_double"))
    ()
    """
    found = (rule(vehicle) for rule in (_positions, _masses, _axles, _inertias, _speed))
    return tuple(chain.from_iterable(found))


def check_plausible(vehicle: Vehicle, source: str) -> tuple[Suspicion, ...]:
    """Refuse an impossible vehicle; return its implausible values.

    Parameters
    ----------
    vehicle : Vehicle
    source : str
        Name of the file in error messages.

    Returns
    -------
    tuple of Suspicion

    Raises
    ------
    VehicleError
        If a number is impossible.
    """
    found = suspicions(vehicle)
    for suspicion in found:
        if suspicion.impossible:
            raise VehicleError(source, suspicion.key, suspicion.problem)
    return found


def warning_lines(found: tuple[Suspicion, ...]) -> list[str]:
    """One line for each broken rule: the first number that breaks it, and the count of others."""
    by_rule: dict[str, list[Suspicion]] = {}
    for suspicion in found:
        by_rule.setdefault(suspicion.rule, []).append(suspicion)
    return [
        f"{first.key}: {first.problem}" + (f" ({len(others)} more like it)" if others else "")
        for first, *others in by_rule.values()
    ]


def _positions(vehicle: Vehicle) -> Iterator[Suspicion]:
    """Hitches and axles on the wrong side, and a centre of gravity that the unit cannot stand on."""
    for index, unit in enumerate(vehicle.units):
        key = f"units.{index}"
        positions = [axle.position for axle in unit.axles]
        if unit.front_hitch is not None:
            yield from _towed(unit, unit.front_hitch, key)
        elif len(positions) > 1 and 0.0 in {min(positions), max(positions)}:
            yield Suspicion(
                "centre",
                f"{key}.axles",
                f"the centre of gravity is at an axle, {unit.name} cannot stand on the others: are positions "
                "measured from the front axle? They are from the centre of gravity, forward positive",
                impossible=True,
            )
        elif len(positions) > 1 and not min(positions) < 0.0 < max(positions):
            yield Suspicion(
                "centre",
                f"{key}.axles",
                f"the centre of gravity is not between the axles, {max(positions):g} to {min(positions):g} m"
                ": positions are from the centre of gravity, forward positive",
            )
        if unit.rear_hitch is not None and unit.rear_hitch > 0.0:
            yield Suspicion(
                "rear hitch",
                f"{key}.rear_hitch",
                f"{unit.rear_hitch:g} m, ahead of the centre of gravity: is the sign right? Forward is "
                "positive",
                impossible=unit.rear_hitch > max(positions),
            )


def _towed(unit: Unit, hitch: float, key: str) -> Iterator[Suspicion]:
    if hitch <= 0.0:
        at = "at" if hitch == 0.0 else "behind"
        yield Suspicion(
            "front hitch",
            f"{key}.front_hitch",
            f"{hitch:g} m, {at} the centre of gravity: expected it ahead; positions are from the centre of "
            "gravity, forward positive",
            impossible=True,
        )
        return
    for place, axle in enumerate(unit.axles):
        if axle.position > hitch:
            yield Suspicion(
                "axle",
                f"{key}.axles.{place}.position",
                f"{axle.position:g} m, ahead of the front hitch at {hitch:g} m: is the sign right? Forward "
                "is positive",
                impossible=True,
            )
    positions = [axle.position for axle in unit.axles]
    if len(positions) > 1 and 0.0 in positions:
        yield Suspicion(
            "centre",
            f"{key}.axles.{positions.index(0.0)}.position",
            "0 m, exactly at the centre of gravity: are positions measured from an axle?",
        )
    elif min(positions) > 0.0:
        yield Suspicion(
            "centre",
            f"{key}.axles",
            f"all ahead of the centre of gravity, {unit.name} would lift its hitch: is the sign right?",
        )


def _masses(vehicle: Vehicle) -> Iterator[Suspicion]:
    for index, unit in enumerate(vehicle.units):
        stiffness = sum(axle.cornering_stiffness for axle in unit.axles)
        if stiffness > LARGEST_UNIT_RATIO * STANDARD_GRAVITY * unit.mass:
            yield Suspicion(
                "mass",
                f"units.{index}.mass",
                f"{unit.mass:g} kg on axles of {stiffness:g} N/rad: is it in tonnes? Masses are in kg",
                impossible=True,
            )
    mean = _mean_load(vehicle) / STANDARD_GRAVITY / 1000.0
    if mean > LARGEST_MEAN_LOAD:
        heaviest = max(range(len(vehicle.units)), key=lambda index: vehicle.units[index].mass)
        yield Suspicion(
            "mass",
            f"units.{heaviest}.mass",
            f"{vehicle.units[heaviest].mass:g} kg, {mean:.4g} t on an axle in the mean: masses are in kg",
            impossible=True,
        )


def _axles(vehicle: Vehicle) -> Iterator[Suspicion]:
    mean = _mean_load(vehicle)
    for index, (unit, loads) in enumerate(
        zip(vehicle.units, static_loads(vehicle, given=False), strict=True)
    ):
        for place, (axle, load) in enumerate(zip(unit.axles, loads.axles, strict=True)):
            key = f"units.{index}.axles.{place}"
            tonnes = load / STANDARD_GRAVITY / 1000.0
            if not AXLE_LOADS[0] <= tonnes <= AXLE_LOADS[1]:
                yield Suspicion("axle load", key, _axle_load_problem(tonnes))
            yield from _stiffness(key, axle.cornering_stiffness, load, mean)


def _axle_load_problem(tonnes: float) -> str:
    low, high = AXLE_LOADS
    guess = ""
    if tonnes <= 0.0:
        guess = "; it would lift off: is a hitch or an axle on the wrong side?"
    elif low <= 1000.0 * tonnes <= high:
        guess = "; is the mass in tonnes?"
    return f"static axle load {tonnes:.3g} t: expected {low:g} to {high:g} t{guess}"


def _stiffness(key: str, stiffness: float, load: float, mean: float) -> Iterator[Suspicion]:
    impossible = stiffness < LEAST_RATIO * mean
    if load <= 0.0 and not impossible:
        return
    low, high = STIFFNESS_RATIOS
    ratio = stiffness / (load if load > 0.0 else mean)
    if not low <= ratio <= high or impossible:
        yield Suspicion(
            "stiffness",
            key,
            f"cornering stiffness {stiffness:g} N/rad, {ratio:.3g} times the axle's load per rad: expected "
            f"{low:g} to {high:g}{_guess(ratio)}",
            impossible,
        )


def _guess(ratio: float) -> str:
    """Mistake that would explain a ratio of stiffness to load."""
    low, high = STIFFNESS_RATIOS
    return next((f"; {text}" for factor, text in _GUESSES if low <= factor * ratio <= high), "")


def _inertias(vehicle: Vehicle) -> Iterator[Suspicion]:
    for index, unit in enumerate(vehicle.units):
        positions = [axle.position for axle in unit.axles]
        positions += [hitch for hitch in (unit.front_hitch, unit.rear_hitch) if hitch is not None]
        length = max(positions) - min(positions)
        if not length:
            continue
        gyration = math.sqrt(unit.yaw_inertia / unit.mass)
        if not GYRATION[0] <= gyration / length <= GYRATION[1]:
            guess = "; is it in t m^2?" if gyration < length * GYRATION[0] else ""
            yield Suspicion(
                "inertia",
                f"units.{index}.yaw_inertia",
                f"{unit.yaw_inertia:g} kg m^2, a radius of gyration of {gyration:.3g} m on a unit of "
                f"{length:.3g} m: expected {GYRATION[0]:g} to {GYRATION[1]:g} times its length{guess}",
                impossible=not POSSIBLE_GYRATION[0] <= gyration / length <= POSSIBLE_GYRATION[1],
            )


def _speed(vehicle: Vehicle) -> Iterator[Suspicion]:
    if vehicle.speed > FASTEST:
        yield Suspicion(
            "speed", "speed", f"{vehicle.speed:g} m/s is {3.6 * vehicle.speed:.0f} km/h: is it in km/h?"
        )


def _mean_load(vehicle: Vehicle) -> float:
    weight = STANDARD_GRAVITY * sum(unit.mass for unit in vehicle.units)
    return weight / sum(len(unit.axles) for unit in vehicle.units)
