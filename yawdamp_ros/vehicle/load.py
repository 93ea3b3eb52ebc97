"""Vehicle files: read, overridden, checked, and turned into a `Vehicle`."""

import warnings
from collections import Counter
from collections.abc import Mapping, Sequence
from copy import deepcopy
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from yawdamp_ros.files import read_text
from yawdamp_ros.share import share_directory
from yawdamp_ros.vehicle.errors import VehicleError
from yawdamp_ros.vehicle.loads import added_axle_loads, axle_groups, centre, loaded, static_load
from yawdamp_ros.vehicle.model import Axle, Unit, Vehicle
from yawdamp_ros.vehicle.plausibility import check_plausible, warning_lines
from yawdamp_ros.vehicle.shape import GROUND_FRAME, hitch_frame, steered_axle_link
from yawdamp_ros.vehicle.spellings import canonical, replaced
from yawdamp_ros.vehicle.tyres import fancher_stiffness

LONGEST_WHEELBASE = 30.0
"""Longest plausible unit [m]: a longer one is most likely in millimetres."""

LARGEST_TYRE_LOAD = 66700.0
"""Largest tyre load of Fancher's formula and of the schema [N]; beyond it the stiffness falls."""

LARGEST_FILE = 1 << 18
"""Largest vehicle file in characters, most of them comments."""

MOST_VALUES = 10_000
"""Largest number of keys and values of a vehicle file."""

VEHICLE_KEYS = ("friction", "drag_area", "drag_height", "start_force", "drive_force", "drive_power")
AXLE_KEYS = (
    "track_width", "tyre_width", "relaxation_length", "roll_stiffness", "roll_damping", "rolling_resistance",
    "driven", "brake_share",
)  # fmt: skip
UNIT_KEYS = (
    "cg_height", "roll_inertia", "roll_axis_height", "abs", "hitch_height", "hitch_roll_stiffness",
    "hitch_roll_damping", "hitch_friction", "hitch_damping", "max_articulation", "front_overhang",
    "rear_overhang", "width", "height",
)  # fmt: skip
"""Optional keys of the vehicle file that are the model's fields as they are."""


class VehicleSource(NamedTuple):
    """Source of a vehicle, enough to read it again anywhere.

    Attributes
    ----------
    text : str
        Text of the vehicle file.
    overrides : tuple of str
        Changes to it, each ``KEY=VALUE``.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import VehicleSource, vehicle_text
    >>> VehicleSource(vehicle_text("interlink"), ("units.1.mass=4156",)).overrides
    ('units.1.mass=4156',)
    """

    text: str
    overrides: tuple[str, ...]


def builtin_vehicles() -> tuple[str, ...]:
    """Return the names of the vehicles that come with the package.

    Returns
    -------
    tuple of str

    Examples
    --------
    >>> from yawdamp_ros.vehicle import builtin_vehicles
    >>> builtin_vehicles()[:2]
    ('a_double', 'a_double_ghandriz')
    """
    return tuple(sorted(path.stem for path in _builtin_directory().glob("*.yaml")))


def load_vehicle(vehicle: str | Path, overrides: Sequence[str] = ()) -> Vehicle:
    """Read a vehicle by builtin name or from a file.

    Parameters
    ----------
    vehicle : str or Path
        One of `builtin_vehicles`, or the path of a YAML file.
    overrides : sequence of str
        Each ``KEY=VALUE``, as in ``units.1.mass=4156``; units and axles are counted from 0, units go by name,
        too, and ``*`` is all: ``units.*.axles.*.track_width=1.9``.

    Returns
    -------
    Vehicle

    Raises
    ------
    VehicleError
        If there is no such vehicle, or it is not a valid one, or no vehicle can be like it; the message names
        file, key, value and what was expected.

    Warns
    -----
    UserWarning
        If a number of a file is hard to believe.

    Examples
    --------
    >>> from yawdamp_ros import load_vehicle
    >>> interlink = load_vehicle("interlink", ["units.1.mass=4156"])
    >>> interlink.unit_names
    ('truck', 'trailer_1', 'trailer_2')
    >>> interlink.units[1].mass
    4156.0
    """
    loaded, doubts = examined_vehicle(vehicle_text(vehicle), str(vehicle), overrides)
    if str(vehicle) not in builtin_vehicles():
        for doubt in doubts:
            warnings.warn(f"{vehicle}: {doubt}", stacklevel=2)
    return loaded


def examined_vehicle(
    text: str, source: str, overrides: Sequence[str] = ()
) -> tuple[Vehicle, tuple[str, ...]]:
    """Turn the text of a vehicle file into a `Vehicle`, and list its implausible values.

    Parameters
    ----------
    text, source, overrides
        As for `parse_vehicle`.

    Returns
    -------
    Vehicle
    tuple of str
        A line for each suspicion; of a builtin vehicle those alone that overrides bring in.

    Raises
    ------
    VehicleError
        As `parse_vehicle`, and if no vehicle can be like it.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import examined_vehicle, vehicle_text
    >>> _, lines = examined_vehicle(vehicle_text("truck_trailer"), "truck_trailer.yaml", ["speed=60"])
    >>> len(lines)
    1
    """
    vehicle = parse_vehicle(text, source, overrides)
    found = check_plausible(vehicle, source)
    if found and _is_builtin(text, source):
        known = {suspicion.key for suspicion in check_plausible(parse_vehicle(text, source), source)}
        found = tuple(suspicion for suspicion in found if suspicion.key not in known)
    return vehicle, tuple(warning_lines(found))


def vehicle_text(vehicle: str | Path) -> str:
    """Return the text of the file behind a builtin name or a path.

    Parameters
    ----------
    vehicle : str or Path
        One of `builtin_vehicles`, or the path of a YAML file.

    Returns
    -------
    str

    Raises
    ------
    VehicleError
        If there is no such file, or it cannot be read.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import vehicle_text
    >>> vehicle_text("interlink").splitlines()[1]
    'name: interlink'
    """
    source = str(vehicle) or "''"  # an empty path would be the working directory
    builtins = builtin_vehicles()
    path = _builtin_directory() / f"{source}.yaml" if source in builtins else Path(source)
    try:
        return read_text(path, LARGEST_FILE)
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
        Name of the file in error messages.
    overrides : sequence of str
        As for `load_vehicle`.

    Returns
    -------
    Vehicle

    Raises
    ------
    VehicleError
        If the text or an override is not valid.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import parse_vehicle, vehicle_text
    >>> parse_vehicle(vehicle_text("interlink"), "interlink").speed
    22.22222222222222
    """
    data = _file_data(text, source)
    before = deepcopy(data) if overrides else None
    data = canonical(_overridden(data, overrides, source), source)
    if overrides or not _is_builtin(text, source):
        _check_schema(data, source)
    _check_combination(data, source)
    return _build(data, source, before)


def value_at(vehicle: VehicleSource, key: str, source: str = "vehicle") -> float:
    """Number at a key of a vehicle file with its overrides.

    Raises
    ------
    VehicleError
        If the key holds no number.
    """
    data = canonical(overridden_data(vehicle.text, source, vehicle.overrides), source)
    try:
        (node,) = _nodes([data], key.split("."), key, source)
        number = float(node)
    except (KeyError, IndexError, TypeError, ValueError) as error:
        raise VehicleError(source, key, "no number there; expected a key of the file") from error
    return number


def load_stack(
    text: str, source: str, overrides: Sequence[str], values: Mapping[str, npt.NDArray[np.float64]]
) -> Vehicle:
    """Turn the text of a vehicle file into a stack of vehicles that differ in the values of some keys.

    Parameters
    ----------
    text, source, overrides
        As for `parse_vehicle`; the overrides are applied before the values.
    values : mapping of str to ndarray, shape (k,)
        Values by key, as in overrides, one for each vehicle.

    Returns
    -------
    Vehicle
        Whose numbers are arrays, shape (k,), wherever they depend on the values.

    Raises
    ------
    VehicleError
        If the text, an override or any of the values is not valid.

    Examples
    --------
    >>> import numpy as np
    >>> from yawdamp_ros.vehicle import load_stack, vehicle_text
    >>> text = vehicle_text("truck_trailer")
    >>> stack = load_stack(text, "truck_trailer", [], {"units.1.mass": np.array([1e4, 2e4])})
    >>> stack.units[1].mass.tolist()
    [10000.0, 20000.0]
    """
    data = _file_data(text, source)
    before = deepcopy(data)
    _overridden(data, overrides, source)
    # The schema limits each key to a range: a stack lies within it if its extremes do.
    for extreme in (np.min, np.max):
        for key, column in values.items():
            _set(data, key, float(extreme(column)), source)
        _check_schema(canonical(data, source), source)
    for key, column in values.items():
        _set(data, key, column, source)
    data = canonical(data, source)
    _check_combination(data, source)
    return _build(data, source, before)


def overridden_data(text: str, source: str, overrides: Sequence[str]) -> Any:  # noqa: ANN401
    """Parse the text of a vehicle file and change the keys that overrides name; nothing else is checked."""
    return _overridden(_file_data(text, source), overrides, source)


def _overridden(data: Any, overrides: Sequence[str], source: str) -> Any:  # noqa: ANN401
    for override in overrides:
        key, separator, value = override.partition("=")
        if not separator:
            raise VehicleError(source, override, "expected KEY=VALUE, as in units.1.mass=4156")
        _set(data, key, _parse_yaml(value, f"--set {override}"), source)
    return data


def _builtin_directory() -> Path:
    return share_directory() / "config" / "vehicles"


def _is_builtin(text: str, source: str) -> bool:
    # Known to be valid; the checker takes longer to import than a node takes to start.
    return source in builtin_vehicles() and vehicle_text(source) == text


def _check_schema(data: Any, source: str) -> None:  # noqa: ANN401
    from yawdamp_ros.vehicle.schema import check_schema  # noqa: PLC0415

    check_schema(data, source)


def _file_data(text: str, source: str) -> Any:  # noqa: ANN401
    return deepcopy(_parsed_file(text, source))


@lru_cache(maxsize=4)
def _parsed_file(text: str, source: str) -> Any:  # noqa: ANN401
    # A locus or a fit takes one file hundreds of times, and to parse it takes far longer than the rest.
    return _parse_yaml(text, source)


def _parse_yaml(text: str, source: str) -> Any:  # noqa: ANN401 - any YAML until it is checked
    # Imported here: a node is on the graph before it reads its vehicle.
    from yawdamp_ros.plain_yaml import parse_yaml  # noqa: PLC0415

    try:
        return parse_yaml(text, MOST_VALUES)
    except ValueError as error:
        raise VehicleError(source, "", str(error)) from error


def _set(data: Any, key: str, value: Any, source: str) -> None:  # noqa: ANN401
    """Set a value at a key; units go by place or name, and ``*`` is all of them."""
    *parents, last = key.split(".")
    try:
        for node in _nodes([data], parents, key, source):
            if isinstance(node, list):
                for index in _indices(node, last, key, source):
                    node[index] = value
            else:
                replaced(node, last)
                node[last] = value
    except VehicleError:
        raise
    except (KeyError, IndexError, TypeError, ValueError, AttributeError) as error:
        raise VehicleError(source, key, "no such key to set") from error


def _nodes(nodes: list[Any], parts: Sequence[str], key: str, source: str) -> list[Any]:
    """Records and lists that a key leads to."""
    for part in parts:
        nodes = [
            child
            for node in nodes
            for child in (
                [node[index] for index in _indices(node, part, key, source)]
                if isinstance(node, list)
                else [node[part]]
            )
        ]
    return nodes


def _indices(entries: list[Any], part: str, key: str, source: str) -> list[int]:
    """Indices of a list that a part of a key selects: a number, a name, or all."""
    if part == "*":
        return list(range(len(entries)))
    names = [entry.get("name") if isinstance(entry, dict) else None for entry in entries]
    if part in names:
        return [names.index(part)]
    try:
        index = int(part)
    except ValueError as error:
        known = ", ".join(str(name) for name in names if name)
        expected = f"a number, *, or one of {known}" if known else "a number or *"
        raise VehicleError(source, key, f"{part!r}: expected {expected}") from error
    if index < 0:  # Python would count it from the end
        raise VehicleError(source, key, f"{index}: expected an index, 0 or more")
    return [index]


def _build(data: dict[str, Any], source: str, before: Any) -> Vehicle:  # noqa: ANN401
    units = data["units"]
    return Vehicle(
        name=data["name"],
        speed=_number(data["speed"]),
        units=tuple(
            _build_unit(unit, index, added, changed, source)
            for index, (unit, added, changed) in enumerate(
                zip(units, _added_loads(units, source), _changed_loads(units, before, source), strict=True)
            )
        ),
        **_given(data, VEHICLE_KEYS),
    )


def _build_unit(
    unit: dict[str, Any], index: int, added: Sequence[Any], changed: Sequence[Any], source: str
) -> Unit:
    mass, yaw_inertia, shift = loaded(unit)

    def from_cg(position: Any) -> Any:  # noqa: ANN401 - a number, or one for each vehicle of a stack
        return None if position is None else _number(position - shift)

    def build_axle(place: int, axle: dict[str, Any]) -> Axle:
        load = static_load(axle, added[place] + changed[place])
        return Axle(
            from_cg(axle["position"]),
            _number(_stiffness(axle, added[place], f"units.{index}.axles.{place}", source)),
            steered=axle.get("steered") is True,
            commanded=axle.get("steered") == "commanded",
            self_steering=axle.get("self_steering", False),
            low_speed_steering=_number(axle.get("low_speed_steering", 0.0)),
            tyres=axle.get("tyres"),
            static_load=None if load is None else _number(load),
            tyre=_tyre(axle.get("tyre"), source),
            **_given(axle, AXLE_KEYS),
        )

    return Unit(
        name=unit["name"],
        mass=_number(mass),
        yaw_inertia=_number(yaw_inertia),
        axles=tuple(build_axle(place, axle) for place, axle in enumerate(unit["axles"])),
        front_hitch=from_cg(unit.get("front_hitch")),
        rear_hitch=from_cg(unit.get("rear_hitch")),
        **_given(unit, UNIT_KEYS),
    )


def _given(data: dict[str, Any], keys: Sequence[str]) -> dict[str, Any]:
    """Values of the optional keys of a record, None where there is none."""
    return {
        key: value if value is None or isinstance(value, bool) else _number(value)
        for key, value in ((key, data.get(key)) for key in keys)
    }


def _tyre(tyre: Any, source: str) -> Any:  # noqa: ANN401
    if tyre in {None, "brush", "linear"}:
        return tyre
    from yawdamp_ros.vehicle.tir import parse_tir, read_tir  # noqa: PLC0415 - few vehicles have one

    return parse_tir(tyre, f"{source}: tyre") if "\n" in tyre else read_tir(Path(source).parent / tyre)


def _added_loads(units: Sequence[dict[str, Any]], source: str) -> list[list[Any]]:
    """Load that the loads of the file add to every axle of every unit."""
    by_load = any("tyre_load" in axle or "static_load" in axle for unit in units for axle in unit["axles"])
    if by_load and any(unit.get("load") for unit in units):
        _check_supports(units, source)
        return added_axle_loads(units)
    return [[0.0] * len(unit["axles"]) for unit in units]


def _changed_loads(units: Sequence[dict[str, Any]], before: Any, source: str) -> list[list[Any]]:  # noqa: ANN401
    """Load that changed masses add to every axle, whose static load belongs to the original mass.

    A change acts at the centre of gravity of its unit. Static loads that were changed, too, hold as they are.
    """
    none = [[0.0] * len(unit["axles"]) for unit in units]
    if before is None or not all("static_load" in axle for unit in units for axle in unit["axles"]):
        return none
    try:
        old = canonical(before, source)["units"]
        loads = [[axle["static_load"] for axle in unit["axles"]] for unit in old]
        masses = [unit["mass"] for unit in old]
    except (VehicleError, KeyError, TypeError, AttributeError):
        return none
    if loads != [[axle["static_load"] for axle in unit["axles"]] for unit in units]:
        return none
    changes = [unit["mass"] - mass for unit, mass in zip(units, masses, strict=True)]
    if not any(np.any(change) for change in changes):
        return none
    _check_supports(units, source)
    return added_axle_loads(
        [
            unit | {"load": [{"mass": change, "position": 0.0}]}
            for unit, change in zip(units, changes, strict=True)
        ]
    )


def _stiffness(axle: dict[str, Any], added: Any, key: str, source: str) -> Any:  # noqa: ANN401
    if "tyre_load" in axle:
        return _tyres_stiffness(axle, added, key, source)
    return axle["cornering_stiffness"]


def _tyres_stiffness(axle: dict[str, Any], added: Any, key: str, source: str) -> Any:  # noqa: ANN401
    load = axle["tyre_load"] + added / axle["tyres"]
    found = _first((load <= 0.0) | (load > LARGEST_TYRE_LOAD), load)
    if found:
        raise VehicleError(
            source,
            f"{key}.tyre_load",
            f"{found[0]:.0f} N with the loads on the vehicle: "
            f"expected above 0 and up to {LARGEST_TYRE_LOAD:.0f} (Fancher's formula peaks there)",
        )
    return axle["tyres"] * fancher_stiffness(load)


def _check_supports(units: Sequence[dict[str, Any]], source: str) -> None:
    """Refuse units without two supports for statics."""
    front, rear = axle_groups(units[0], towed=False)
    if not front or np.any(centre(units[0], front) <= centre(units[0], rear)):
        raise VehicleError(
            source, "units.0.axles", "expected two supports that share the loads, the steered axles in front"
        )
    for index, unit in enumerate(units[1:], 1):
        if np.any(unit["front_hitch"] <= centre(unit, range(len(unit["axles"])))):
            raise VehicleError(
                source,
                f"units.{index}.axles",
                "expected them behind the front hitch, to share the loads with it",
            )


def _check_combination(data: dict[str, Any], source: str) -> None:
    """Refuse contradictions between keys."""
    units = data["units"]
    for index, unit in enumerate(units):
        key, name = f"units.{index}", unit["name"]
        if index == 0 and "front_hitch" in unit:
            raise VehicleError(
                source, f"{key}.front_hitch", "the lead unit is not towed; expected no front hitch"
            )
        if index > 0 and "front_hitch" not in unit:
            raise VehicleError(source, f"{key}.front_hitch", f"missing: {name} is towed and needs one")
        if index < len(units) - 1 and "rear_hitch" not in unit:
            raise VehicleError(
                source, f"{key}.rear_hitch", f"missing: {name} tows the next unit and needs one"
            )
        for place, axle in enumerate(unit["axles"]):
            if "low_speed_steering" in axle and (index == 0 or axle.get("self_steering")):
                problem = "expected it on an axle of a towed unit that does not caster"
                raise VehicleError(source, f"{key}.axles.{place}.low_speed_steering", problem)
        _check_lengths(unit, key, source)
        _check_static_loads(unit, key, source)
    names = [unit["name"] for unit in units]
    name, count = Counter(names).most_common(1)[0]
    if count > 1:
        last = len(names) - 1 - names[::-1].index(name)
        raise VehicleError(source, f"units.{last}.name", f"{name!r}: expected a name not yet taken")
    _check_frames(names, source)
    if not any(axle.get("steered") is True for axle in units[0]["axles"]):
        raise VehicleError(
            source, "units.0.axles", "no axle of the lead unit is steered; expected steered: true"
        )


def _check_static_loads(unit: dict[str, Any], key: str, source: str) -> None:
    given = ["static_load" in axle or "tyre_load" in axle for axle in unit["axles"]]
    if any("static_load" in axle for axle in unit["axles"]) and not all(given):
        raise VehicleError(
            source,
            f"{key}.axles.{given.index(False)}.static_load",
            "missing: expected on all axles of a unit or none",
        )


def _check_frames(names: Sequence[str], source: str) -> None:
    """Refuse names of other frames and links."""
    others = {GROUND_FRAME: "the ground", steered_axle_link(names[0]): f"the steered axle of {names[0]}"}
    others |= {hitch_frame(name): f"the hitch of {name}" for name in names[1:]}
    for index, name in enumerate(names):
        if name in others:
            raise VehicleError(
                source,
                f"units.{index}.name",
                f"{name!r}: that is the frame of {others[name]}; expected another",
            )


def _check_lengths(unit: dict[str, Any], key: str, source: str) -> None:
    hitches = [unit[name] for name in ("front_hitch", "rear_hitch") if name in unit]
    if len(hitches) > 1:
        found = _first(hitches[0] <= hitches[1], *hitches)
        if found:
            raise VehicleError(
                source,
                f"{key}.rear_hitch",
                f"{found[1]}: expected a position behind the front hitch at {found[0]}",
            )
    positions = np.broadcast_arrays(*(axle["position"] for axle in unit["axles"]), *hitches)
    length = np.max(positions, axis=0) - np.min(positions, axis=0)
    found = _first(length > LONGEST_WHEELBASE, length)
    if found:
        raise VehicleError(
            source,
            key,
            f"{found[0]:g} m from its foremost to its rearmost axle or hitch: "
            f"expected at most {LONGEST_WHEELBASE:g} m, positions are in metres",
        )


def _first(bad: Any, *values: Any) -> list[float] | None:  # noqa: ANN401
    """Values of the first invalid vehicle of a stack, or of the only one; None if all are valid."""
    if not np.any(bad):
        return None
    where, *arrays = np.broadcast_arrays(bad, *values)
    return [float(array.flat[np.argmax(where)]) for array in arrays]


def _number(value: Any) -> Any:  # noqa: ANN401
    return value if isinstance(value, np.ndarray) else float(value)
