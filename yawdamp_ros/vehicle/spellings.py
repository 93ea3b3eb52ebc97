"""Other spellings of a vehicle file: units in keys, positions from an axle, stiffness by load.

A file is brought to its canonical keys (`vehicle.schema.json`) before it is checked.

- ``KEY_UNIT`` is KEY in that unit: ``mass_t``, ``position_mm``, ``cornering_stiffness_kN_per_deg``.
- ``positions_from: front_axle`` (or ``front_hitch``) of a unit: positions of its axles, hitches and loads are
  from there, forward positive, and ``cg_position`` is that of its centre of gravity without the loads.
- ``cornering_coefficient`` of an axle is its cornering stiffness over its static load [1/rad], as in OpenPBS.
- ``lifted: true`` takes an axle off the road.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Any

import numpy as np

from yawdamp_ros.vehicle.errors import VehicleError
from yawdamp_ros.vehicle.loads import added_axle_loads, static_load
from yawdamp_ros.vehicle.model import STANDARD_GRAVITY

_PER_DEGREE = math.degrees(1.0)
FACTORS: Mapping[str, Mapping[str, float]] = MappingProxyType(
    {
        "length": {"m": 1.0, "cm": 1e-2, "mm": 1e-3},
        "mass": {"kg": 1.0, "t": 1e3},
        "inertia": {"kg_m2": 1.0, "t_m2": 1e3},
        "speed": {"m_per_s": 1.0, "km_per_h": 1.0 / 3.6},
        "force": {"N": 1.0, "kN": 1e3, "t": 1e3 * STANDARD_GRAVITY, "kg": STANDARD_GRAVITY},
        "power": {"W": 1.0, "kW": 1e3},
        "angle": {"rad": 1.0, "deg": 1.0 / _PER_DEGREE},
        "stiffness": {
            "N_per_rad": 1.0,
            "kN_per_rad": 1e3,
            "N_per_deg": _PER_DEGREE,
            "kN_per_deg": 1e3 * _PER_DEGREE,
        },
        "turning_stiffness": {"N_m_per_rad": 1.0, "kN_m_per_rad": 1e3, "kN_m_per_deg": 1e3 * _PER_DEGREE},
        "turning_damping": {"N_m_s_per_rad": 1.0, "kN_m_s_per_rad": 1e3, "kN_m_s_per_deg": 1e3 * _PER_DEGREE},
    }
)
"""SI units of each unit, by dimension."""
LENGTHS = (
    "position", "front_hitch", "rear_hitch", "cg_height", "roll_axis_height", "hitch_height",
    "front_overhang", "rear_overhang", "width", "height", "track_width", "tyre_width", "relaxation_length",
    "drag_height", "cg_position",
)  # fmt: skip
DIMENSIONS: Mapping[str, str] = MappingProxyType(
    {
        **dict.fromkeys(LENGTHS, "length"),
        "mass": "mass",
        "yaw_inertia": "inertia",
        "roll_inertia": "inertia",
        "speed": "speed",
        "static_load": "force",
        "tyre_load": "force",
        "start_force": "force",
        "drive_force": "force",
        "drive_power": "power",
        "max_articulation": "angle",
        "cornering_stiffness": "stiffness",
        "roll_stiffness": "turning_stiffness",
        "hitch_roll_stiffness": "turning_stiffness",
        "roll_damping": "turning_damping",
        "hitch_roll_damping": "turning_damping",
        "hitch_damping": "turning_damping",
    }
)
"""Dimension of each key that may have a unit."""
SPELLINGS: Mapping[str, tuple[str, float]] = MappingProxyType(
    {
        f"{key}_{unit}": (key, factor)
        for key, dimension in DIMENSIONS.items()
        for unit, factor in FACTORS[dimension].items()
    }
)
"""Canonical key and factor of every key with a unit."""
ORIGINS = ("centre_of_gravity", "front_axle", "front_hitch")
STIFFNESSES = ("cornering_stiffness", "cornering_coefficient")
"""Keys of the stiffness of an axle; one replaces the other."""


def canonical(data: Any, source: str) -> Any:  # noqa: ANN401 - of any file
    """Bring the data of a vehicle file to its canonical keys.

    Parameters
    ----------
    data : object
        Data as read; it is not changed.
    source : str
        Name of the file in error messages.

    Returns
    -------
    object
        Data with canonical keys. Parts without the form of a vehicle file stay as they are, for the schema to
        report.

    Raises
    ------
    VehicleError
        If a key is given twice, or its origin is not known.

    Examples
    --------
    >>> canonical({"speed_km_per_h": 90.0}, "file")
    {'speed': 25.0}
    """
    data = _in_si(data, "", source)
    units = data.get("units") if isinstance(data, dict) else None
    if not isinstance(units, list) or not all(isinstance(unit, dict) for unit in units):
        return data
    made = [
        _grounded(_from_centre(unit, f"units.{index}", source), f"units.{index}", source)
        for index, unit in enumerate(units)
    ]
    for key, axle in _axles(made):
        coefficient = axle.get("cornering_coefficient", 1.0)
        if isinstance(coefficient, str | bool | list | dict | None) or np.any(coefficient <= 0.0):
            problem = f"{coefficient!r}: expected a number above 0, cornering stiffness over load in 1/rad"
            raise VehicleError(source, f"{key}.cornering_coefficient", problem)
    return {**data, "units": _stiffened(made, source)}


def replaced(node: dict[str, Any], key: str) -> None:
    """Remove from a record the other spellings of a key that is set.

    Parameters
    ----------
    node : dict
        Changed in place.
    key : str

    Examples
    --------
    >>> axle = {"position": 1.0, "cornering_stiffness": 4e5}
    >>> replaced(axle, "cornering_coefficient")
    >>> axle
    {'position': 1.0}
    """
    base = SPELLINGS.get(key, (key, 1.0))[0]
    bases = STIFFNESSES if base in STIFFNESSES else (base,)
    for other in list(node):
        if isinstance(other, str) and other != key and SPELLINGS.get(other, (other, 1.0))[0] in bases:
            del node[other]


def _in_si(node: Any, where: str, source: str) -> Any:  # noqa: ANN401
    if isinstance(node, list):
        return [_in_si(child, f"{where}{index}.", source) for index, child in enumerate(node)]
    if not isinstance(node, dict):
        return node
    made: dict[Any, Any] = {}
    for key, child in node.items():
        base, factor = SPELLINGS.get(key, (key, 1.0))
        if base in made:
            raise VehicleError(source, f"{where}{key}", f"{base} is given twice; expected it once")
        is_number = not isinstance(child, bool | str | list | dict) and child is not None
        made[base] = (
            child * factor if factor != 1.0 and is_number else _in_si(child, f"{where}{key}.", source)
        )
    return made


def _from_centre(unit: dict[str, Any], key: str, source: str) -> dict[str, Any]:
    """Unit with its positions from its centre of gravity."""
    origin = unit.get("positions_from", ORIGINS[0])
    rest = {name: value for name, value in unit.items() if name not in {"positions_from", "cg_position"}}
    if origin not in ORIGINS:
        raise VehicleError(
            source, f"{key}.positions_from", f"{origin!r}: expected one of {', '.join(ORIGINS)}"
        )
    if origin == ORIGINS[0]:
        if "cg_position" in unit:
            problem = "expected positions_from: front_axle or front_hitch with it"
            raise VehicleError(source, f"{key}.cg_position", problem)
        return rest
    if "cg_position" not in unit:
        raise VehicleError(source, f"{key}.cg_position", f"missing: positions are from the {origin}")
    try:
        return _shifted(rest, unit["cg_position"])
    except TypeError as error:
        problem = "expected numbers for cg_position, hitches and positions"
        raise VehicleError(source, f"{key}.positions_from", problem) from error


def _shifted(rest: dict[str, Any], centre: Any) -> dict[str, Any]:  # noqa: ANN401 - a number, if all is well
    for name in ("front_hitch", "rear_hitch"):
        if name in rest:
            rest[name] = rest[name] - centre
    for name in ("axles", "load"):
        entries = rest.get(name)
        if isinstance(entries, list):
            rest[name] = [
                {**entry, "position": entry["position"] - centre}
                if isinstance(entry, dict) and "position" in entry
                else entry
                for entry in entries
            ]
    return rest


def _grounded(unit: dict[str, Any], key: str, source: str) -> dict[str, Any]:
    """Unit without its lifted axles."""
    axles = unit.get("axles")
    if not isinstance(axles, list) or not all(isinstance(axle, dict) for axle in axles):
        return unit
    if any(axle.get("lifted") is True for axle in axles):
        for place, axle in enumerate(axles):
            if given := {"static_load", "tyre_load"} & set(axle):
                problem = f"lifted: expected no {given.pop()} on this unit, for it is one with all axles down"
                raise VehicleError(source, f"{key}.axles.{place}", problem)
    kept = [
        {name: value for name, value in axle.items() if name != "lifted"}
        for axle in axles
        if axle.get("lifted") is not True
    ]
    return {**unit, "axles": kept}


def _stiffened(units: Sequence[dict[str, Any]], source: str) -> list[dict[str, Any]]:
    """Units whose axles with a coefficient have the stiffness that it gives their static load."""
    if not any("cornering_coefficient" in axle for _, axle in _axles(units)):
        return list(units)
    try:
        carried = _static_loads(units)
    except ZeroDivisionError as error:
        problem = "cornering_coefficient needs the axles' loads: expected two supports that share them"
        raise VehicleError(source, "units.0.axles", problem) from error
    except (KeyError, TypeError):  # not a vehicle: the schema reports it
        return list(units)
    made = []
    for unit, loads in zip(units, carried, strict=True):
        axles = []
        for axle, load in zip(unit["axles"], loads, strict=True):
            rest = dict(axle)
            if "cornering_coefficient" in rest:
                rest["cornering_stiffness"] = rest.pop("cornering_coefficient") * load
            axles.append(rest)
        made.append({**unit, "axles": axles})
    return made


def _static_loads(units: Sequence[dict[str, Any]]) -> list[list[Any]]:
    """Load of every axle at rest [N]: as given, else by statics of masses and loads."""
    laden = [
        {**unit, "load": [{"mass": unit["mass"], "position": 0.0}, *unit.get("load", ())]} for unit in units
    ]
    by_statics = added_axle_loads(laden)
    added = added_axle_loads(units)
    return [
        [
            given if (given := static_load(axle, extra)) is not None else load
            for axle, load, extra in zip(unit["axles"], loads, extras, strict=True)
        ]
        for unit, loads, extras in zip(units, by_statics, added, strict=True)
    ]


def _axles(units: Sequence[dict[str, Any]]) -> Iterator[tuple[str, dict[str, Any]]]:
    """Axles with their keys."""
    for index, unit in enumerate(units):
        axles = unit.get("axles")
        for place, axle in enumerate(axles if isinstance(axles, list) else ()):
            if isinstance(axle, dict):
                yield f"units.{index}.axles.{place}", axle
