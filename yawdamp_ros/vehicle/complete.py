"""Documented defaults for optional values of a vehicle file that the nonlinear model needs.

They are typical of laden heavy vehicles. `SOURCES` names the works that treat each quantity; the values are
secondary, for they were not compared with the tables there. What a vehicle file gives always counts instead.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Any, NamedTuple

from yawdamp_ros.vehicle.model import Axle, Unit, Vehicle
from yawdamp_ros.vehicle.statics import static_loads

SOURCES: Mapping[str, str] = MappingProxyType(
    {
        "Factbook": "Fancher, Ervin, Winkler, Gillespie, A factbook of the mechanical properties of the "
        "components for single-unit and articulated heavy trucks, UMTRI-86-12, 1986",
        "Sampson": "Active roll control of articulated heavy vehicles, University of Cambridge, 2000, "
        "appendix",
        "Pacejka": "Tire and vehicle dynamics, 3rd edition, 2012",
        "ISO 1726": "the standard on fifth-wheel heights",
        "ISO 28580": "the standard on rolling resistance",
        "ETRTO": "the European tyre standard's sizes; duals stand 0.3 m apart",
        "96/53/EC": "the directive on weights and dimensions",
        "UN R13": "the regulation on brakes",
        "statics": "from masses and positions",
        "linear": "as the linear model assumes it",
    }
)
"""Works behind the short names with which `Assumed.source` begins."""

LIGHT_UNIT = 6000.0
"""Mass up to which a towed unit with a rear hitch can be a dolly [kg]."""
LONGEST_DRAWBAR = 6.0
"""Distance from the front hitch to the middle of the axles up to which it can be one [m]."""


class Assumed(NamedTuple):
    """Value that the vehicle file does not give.

    Attributes
    ----------
    key : str
        Key of the value, as ``--set`` takes it.
    value : float, bool or str
    unit : str
        Unit of the value; empty where there is none.
    source : str
        Origin of the value; the module lists the sources in full.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import assumed, load_vehicle
    >>> assumed(load_vehicle("truck_trailer"))[0]
    Assumed(key='friction', value=0.8, unit='', source='Factbook, dry road')
    """

    key: str
    value: float | bool | str
    unit: str
    source: str


class Default(NamedTuple):
    """Default of a value that is not given: its unit, its source, and the rule."""

    unit: str
    source: str
    rule: Callable[..., Any]


def is_dolly(unit: Unit) -> bool:
    """Return whether a unit between two others counts as a dolly, which carries no body.

    A dolly is light and short, and nothing of it reaches beyond its eye: an empty trailer is as light, but
    longer, or its file gives the overhang of its body.
    """
    if unit.front_hitch is None or unit.rear_hitch is None or unit.mass > LIGHT_UNIT:
        return False
    drawbar = unit.front_hitch - sum(axle.position for axle in unit.axles) / len(unit.axles)
    return drawbar <= LONGEST_DRAWBAR and not unit.front_overhang


def _couples_roll(unit: Unit) -> bool:
    """Return whether the rear hitch lies over the axles, where fifth wheels do, and not behind them."""
    return unit.rear_hitch is not None and unit.rear_hitch >= min(axle.position for axle in unit.axles)


VEHICLE_DEFAULTS: Mapping[str, Default] = MappingProxyType(
    {
        "friction": Default("", "Factbook, dry road", lambda _: 0.8),
        "drag_area": Default("m^2", "drag coefficient 0.6 on 10 m^2", lambda _: 6.0),
        "drag_height": Default("m", "middle of a front 4 m high", lambda _: 2.0),
    }
)
UNIT_DEFAULTS: Mapping[str, Default] = MappingProxyType(
    {
        "cg_height": Default(
            "m",
            "Factbook: tractor 1.1, laden 2.0, dolly 0.9",
            lambda unit: 1.1 if unit.front_hitch is None else 0.9 if is_dolly(unit) else 2.0,
        ),
        "roll_inertia": Default("kg m^2", "Sampson: radius of gyration 0.8 m", lambda unit: 0.64 * unit.mass),
        "roll_axis_height": Default("m", "Factbook: 0.6, less what tyres roll below it", lambda _: 0.5),
        "abs": Default("", "UN R13", lambda _: True),
        "hitch_height": Default(
            "m",
            "ISO 1726: fifth wheel 1.25; drawbar eye 0.8",
            lambda unit: 1.25 if _couples_roll(unit) else 0.8,
        ),
        "hitch_roll_stiffness": Default(
            "N m/rad",
            "Sampson: fifth wheel; a drawbar eye has none",
            lambda unit: 3.0e6 if _couples_roll(unit) else 0.0,
        ),
        "hitch_roll_damping": Default(
            "N m s/rad", "1/50 s of the stiffness", lambda unit: 0.02 * unit.hitch_roll_stiffness
        ),
        "hitch_friction": Default("N m", "linear", lambda _: 0.0),
        "hitch_damping": Default("N m s/rad", "linear", lambda _: 0.0),
        "max_articulation": Default("rad", "a right angle", lambda _: 0.5 * math.pi),
        "front_overhang": Default(
            "m",
            "96/53/EC: cab 1.4, trailer 1.2; a dolly's eye is its foremost point",
            lambda unit: 1.4 if unit.front_hitch is None else 0.0 if is_dolly(unit) else 1.2,
        ),
        "rear_overhang": Default("m", "half a metre behind the last wheel", lambda _: 1.0),
        "width": Default("m", "96/53/EC: 2.55", lambda _: 2.55),
        "height": Default(
            "m",
            "96/53/EC: 4.0; a dolly ends at its fifth wheel",
            lambda unit: 1.25 if is_dolly(unit) else 4.0,
        ),
    }
)
AXLE_DEFAULTS: Mapping[str, Default] = MappingProxyType(
    {
        "static_load": Default("N", "statics", lambda axle: axle.static_load),
        "track_width": Default(
            "m", "Factbook: steered 2.05, others 1.85", lambda axle: 2.05 if axle.steered else 1.85
        ),
        "tyre_width": Default(
            "m",
            "ETRTO 295/80 R 22.5: single 0.3, duals 0.6",
            lambda axle: 0.3 if axle.steered else 0.6,
        ),
        "tyre": Default("", "Pacejka, chapter 3", lambda _: "brush"),
        "relaxation_length": Default(
            "m",
            "the tyre's file, else Pacejka: about the wheel's radius",
            lambda axle: getattr(axle.tyre, "relaxation_length", None) or 0.5,
        ),
        "roll_stiffness": Default(
            "N m/rad",
            "Factbook: steered 4, others 8 N m/rad for each N of load",
            lambda axle: (4.0 if axle.steered else 8.0) * axle.static_load,
        ),
        "roll_damping": Default(
            "N m s/rad", "1/10 s of the stiffness", lambda axle: 0.1 * axle.roll_stiffness
        ),
        "rolling_resistance": Default("", "ISO 28580, class C3", lambda _: 0.006),
        "brake_share": Default("N", "the static load", lambda axle: axle.static_load),
    }
)


def complete(vehicle: Vehicle) -> Vehicle:
    """Fill missing values of a vehicle file with the defaults.

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    Vehicle
        No field of which is None, but for hitches that are not there, `Axle.tyres` and the powertrain.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> complete(load_vehicle("a_double")).units[1].cg_height
    2.0
    """
    loads = static_loads(vehicle)
    units = []
    for index, unit in enumerate(vehicle.units):
        axles = tuple(
            _filled(
                replace(
                    axle,
                    static_load=load,
                    driven=index == 0 and not axle.steered if axle.driven is None else axle.driven,
                ),
                AXLE_DEFAULTS,
            )
            for axle, load in zip(unit.axles, loads[index].axles, strict=True)
        )
        units.append(_filled(replace(unit, axles=axles), UNIT_DEFAULTS))
    full: Vehicle = _filled(replace(vehicle, units=tuple(units)), VEHICLE_DEFAULTS)
    return full


def assumed(vehicle: Vehicle) -> tuple[Assumed, ...]:
    """List the values that the nonlinear model assumes, as the file does not give them.

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    tuple of Assumed

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> [each.value for each in assumed(load_vehicle("interlink")) if each.key == "units.1.cg_height"]
    [2.0]
    """
    full = complete(vehicle)
    found = list(_differences("", vehicle, full, VEHICLE_DEFAULTS))
    for index, (unit, whole) in enumerate(zip(vehicle.units, full.units, strict=True)):
        key = f"units.{index}."
        found += _differences(key, unit, whole, UNIT_DEFAULTS)
        for place, (axle, entire) in enumerate(zip(unit.axles, whole.axles, strict=True)):
            found += _differences(f"{key}axles.{place}.", axle, entire, AXLE_DEFAULTS)
            if axle.driven is None:
                assert entire.driven is not None  # noqa: S101 - `complete` fills it
                found.append(
                    Assumed(f"{key}axles.{place}.driven", entire.driven, "", "rear axles of the lead unit")
                )
    return tuple(found)


def given(vehicle: Vehicle) -> tuple[str, ...]:
    """List the keys that the nonlinear model needs and the vehicle file gives, so that nothing is assumed.

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    tuple of str
        Keys, as for ``--set``.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> given(load_vehicle("truck_trailer"))
    ()
    >>> given(load_vehicle("interlink"))[0]
    'units.0.axles.0.static_load'
    """
    found = [name for name in VEHICLE_DEFAULTS if getattr(vehicle, name) is not None]
    for index, unit in enumerate(vehicle.units):
        key = f"units.{index}."
        found += [key + name for name in UNIT_DEFAULTS if getattr(unit, name) is not None]
        for place, axle in enumerate(unit.axles):
            names = (*AXLE_DEFAULTS, "driven")
            found += [f"{key}axles.{place}.{name}" for name in names if getattr(axle, name) is not None]
    return tuple(found)


def _filled(record: Any, defaults: Mapping[str, Default]) -> Any:  # noqa: ANN401
    for name, default in defaults.items():
        if getattr(record, name) is None:
            record = replace(record, **{name: default.rule(record)})
    return record


def _differences(
    key: str, given: Axle | Unit | Vehicle, full: Axle | Unit | Vehicle, defaults: Mapping[str, Default]
) -> list[Assumed]:
    """Values of the full record that the given one lacks; those of a hitch only where there is one."""
    hitchless = isinstance(given, Unit) and given.rear_hitch is None
    return [
        Assumed(key + name, getattr(full, name), default.unit, default.source)
        for name, default in defaults.items()
        if getattr(given, name) is None
        and not (hitchless and (name.startswith("hitch_") or name == "max_articulation"))
    ]
