"""Vehicle files: read, overridden, checked, and turned into a `Vehicle`."""

import json
import math
from collections import Counter
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from jsonschema import Draft202012Validator, ValidationError
from ruamel.yaml import YAML
from ruamel.yaml.error import MarkedYAMLError, YAMLError

from yawdamp_ros.share import share_directory
from yawdamp_ros.vehicle.errors import VehicleError
from yawdamp_ros.vehicle.model import Axle, Unit, Vehicle
from yawdamp_ros.vehicle.tyres import fancher_stiffness

LONGEST_WHEELBASE = 30.0
"""Longest believable unit in m: beyond it a file most likely holds millimetres."""


class VehicleSource(NamedTuple):
    """What a vehicle was read from, enough to read it again anywhere.

    Attributes
    ----------
    text : str
        Of the vehicle file.
    overrides : tuple of str
        Changes to it, each ``KEY=VALUE``.
    """

    text: str
    overrides: tuple[str, ...]


def builtin_vehicles() -> tuple[str, ...]:
    """Names of the vehicles that come with the package."""
    return tuple(sorted(path.stem for path in _builtin_directory().glob("*.yaml")))


def load_vehicle(vehicle: str | Path, overrides: Sequence[str] = ()) -> Vehicle:
    """Read a vehicle by builtin name or from a file.

    Parameters
    ----------
    vehicle : str or Path
        One of `builtin_vehicles`, or the path of a YAML file.
    overrides : sequence of str
        Each ``KEY=VALUE``, as in ``units.1.mass=4156``; units and axles are counted from 0.

    Returns
    -------
    Vehicle

    Raises
    ------
    VehicleError
        If there is no such vehicle, or it is not a valid one; the message names file, key, value and
        what was expected.
    """
    return parse_vehicle(vehicle_text(vehicle), str(vehicle), overrides)


def vehicle_text(vehicle: str | Path) -> str:
    """Text of the file behind a builtin name or a path.

    Raises
    ------
    VehicleError
        If there is no such file, or it cannot be read.
    """
    source = str(vehicle)
    builtins = builtin_vehicles()
    if not source:
        raise VehicleError("''", "", f"no such vehicle; expected a file or one of {', '.join(builtins)}")
    path = _builtin_directory() / f"{source}.yaml" if source in builtins else Path(vehicle)
    try:
        return path.read_text(encoding="utf-8")
    except FileNotFoundError as error:
        raise VehicleError(
            source, "", f"no such vehicle; expected a file or one of {', '.join(builtins)}"
        ) from error
    except OSError as error:
        raise VehicleError(source, "", f"cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise VehicleError(source, "", "not UTF-8 text; expected a YAML file") from error


def parse_vehicle(text: str, source: str, overrides: Sequence[str] = ()) -> Vehicle:
    """Turn the text of a vehicle file into a `Vehicle`.

    Parameters
    ----------
    text : str
        YAML 1.2.
    source : str
        What errors call the file.
    overrides : sequence of str
        As for `load_vehicle`.

    Returns
    -------
    Vehicle

    Raises
    ------
    VehicleError
        If the text or an override is not valid.
    """
    data = _parse_yaml(text, source)
    for override in overrides:
        _apply_override(data, override, source)
    _check_schema(data, source)
    vehicle = _build(data)
    _check_combination(vehicle, source)
    return vehicle


def _builtin_directory() -> Path:
    return share_directory() / "config" / "vehicles"


@cache
def _validator() -> Draft202012Validator:
    schema = share_directory() / "config" / "vehicle.schema.json"
    return Draft202012Validator(json.loads(schema.read_text(encoding="utf-8")))


def _parse_yaml(text: str, source: str) -> Any:  # noqa: ANN401 - any YAML until it is checked
    # YAML 1.2 by ruamel.yaml: 1e5 is a number, and a key given twice is an error.
    try:
        return YAML(typ="safe", pure=True).load(text)
    except MarkedYAMLError as error:
        line = f"line {error.problem_mark.line + 1}: " if error.problem_mark else ""
        problem = str(error.problem).splitlines()[0]
        raise VehicleError(source, "", f"{line}not valid YAML: {problem}") from error
    except (YAMLError, ValueError, RecursionError) as error:
        reason = (str(error).splitlines() or [type(error).__name__])[0]
        raise VehicleError(source, "", f"not valid YAML: {reason}") from error


def _apply_override(data: Any, override: str, source: str) -> None:  # noqa: ANN401
    key, separator, text = override.partition("=")
    if not separator:
        raise VehicleError(source, override, "expected KEY=VALUE, as in units.1.mass=4156")
    value = _parse_yaml(text, f"--set {override}")
    *parents, last = key.split(".")
    node = data
    try:
        for part in parents:
            node = node[int(part)] if isinstance(node, list) else node[part]
        if isinstance(node, list):
            node[int(last)] = value
        else:
            node[last] = value
    except (KeyError, IndexError, TypeError, ValueError) as error:
        raise VehicleError(source, key, "no such key to set") from error


def _check_schema(data: Any, source: str) -> None:  # noqa: ANN401
    errors = sorted(_validator().iter_errors(data), key=lambda error: list(map(str, error.path)))
    if errors:
        raise _schema_error(errors[0], source)
    for key, value in _numbers(data, ""):
        # Infinities pass a schema's bounds, and an integer can be too long for a float.
        if abs(value) > 1e300 or math.isnan(value):  # noqa: PLR2004
            shown = value if isinstance(value, float) else "a very long number"
            raise VehicleError(source, key, f"{shown}: expected a finite number")


def _schema_error(error: ValidationError, source: str) -> VehicleError:
    key = ".".join(map(str, error.path))
    if error.validator == "additionalProperties":
        known = error.schema["properties"]
        unknown = next(name for name in error.instance if name not in known)
        return VehicleError(
            source, _join(key, str(unknown)), f"unknown key; expected one of {', '.join(known)}"
        )
    if error.validator == "required":
        missing = next(name for name in error.validator_value if name not in error.instance)
        return VehicleError(source, _join(key, missing), "missing")
    shown = _shorten(repr(error.instance))
    return VehicleError(source, key, f"{shown}: expected {error.schema['description']}")


def _numbers(node: Any, key: str) -> Iterator[tuple[str, float]]:  # noqa: ANN401
    if isinstance(node, dict):
        for name, child in node.items():
            yield from _numbers(child, _join(key, str(name)))
    elif isinstance(node, list):
        for index, child in enumerate(node):
            yield from _numbers(child, _join(key, str(index)))
    elif isinstance(node, int | float):
        yield key, node


def _build(data: dict[str, Any]) -> Vehicle:
    units = tuple(
        Unit(
            name=unit["name"],
            mass=float(unit["mass"]),
            yaw_inertia=float(unit["yaw_inertia"]),
            axles=tuple(
                Axle(
                    position=float(axle["position"]),
                    cornering_stiffness=_cornering_stiffness(axle),
                    steered=axle.get("steered", False),
                )
                for axle in unit["axles"]
            ),
            front_hitch=_optional_float(unit.get("front_hitch")),
            rear_hitch=_optional_float(unit.get("rear_hitch")),
        )
        for unit in data["units"]
    )
    return Vehicle(name=data["name"], speed=float(data["speed"]), units=units)


def _cornering_stiffness(axle: dict[str, Any]) -> float:
    if "tyre_load" in axle:
        return float(axle["tyres"] * fancher_stiffness(axle["tyre_load"]))
    return float(axle["cornering_stiffness"])


def _check_combination(vehicle: Vehicle, source: str) -> None:
    """Refuse what each key alone cannot show."""
    for index, unit in enumerate(vehicle.units):
        key = f"units.{index}"
        if index == 0 and unit.front_hitch is not None:
            raise VehicleError(
                source, f"{key}.front_hitch", "the lead unit is not towed; expected no front hitch"
            )
        if index > 0 and unit.front_hitch is None:
            raise VehicleError(source, f"{key}.front_hitch", f"missing: {unit.name} is towed and needs one")
        if index < len(vehicle.units) - 1 and unit.rear_hitch is None:
            raise VehicleError(
                source, f"{key}.rear_hitch", f"missing: {unit.name} tows the next unit and needs one"
            )
        _check_lengths(unit, key, source)
    name, count = Counter(vehicle.unit_names).most_common(1)[0]
    if count > 1:
        last = len(vehicle.units) - 1 - vehicle.unit_names[::-1].index(name)
        raise VehicleError(source, f"units.{last}.name", f"{name!r}: expected a name not yet taken")
    if not any(axle.steered for axle in vehicle.units[0].axles):
        raise VehicleError(
            source, "units.0.axles", "no axle of the lead unit is steered; expected steered: true"
        )


def _check_lengths(unit: Unit, key: str, source: str) -> None:
    hitches = [hitch for hitch in (unit.front_hitch, unit.rear_hitch) if hitch is not None]
    if len(hitches) > 1 and hitches[0] <= hitches[1]:
        raise VehicleError(
            source,
            f"{key}.rear_hitch",
            f"{hitches[1]}: expected a position behind the front hitch at {hitches[0]}",
        )
    positions = [axle.position for axle in unit.axles] + hitches
    length = max(positions) - min(positions)
    if length > LONGEST_WHEELBASE:
        raise VehicleError(
            source,
            key,
            f"{length:g} m from its foremost to its rearmost axle or hitch: "
            f"expected at most {LONGEST_WHEELBASE:g} m, positions are in metres",
        )


def _join(key: str, name: str) -> str:
    return f"{key}.{name}" if key else name


def _optional_float(value: float | None) -> float | None:
    return None if value is None else float(value)


def _shorten(text: str, limit: int = 60) -> str:
    return text if len(text) <= limit else text[: limit - 3] + "..."
