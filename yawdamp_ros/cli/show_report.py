"""Report of `show`, as text of 80 columns and as JSON."""

import json
import math
import textwrap
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from yawdamp_ros.cli.table import print_table
from yawdamp_ros.vehicle import (
    STANDARD_GRAVITY,
    Assumed,
    Axle,
    MagicFormula,
    Suspicion,
    Unit,
    Vehicle,
    assumed,
    complete,
    given,
    static_loads,
    supports,
)
from yawdamp_ros.vehicle.complete import SOURCES

COLUMNS = 80
LARGE = 1000.0
"""Magnitude from which numbers are shown without decimals."""


def print_json(vehicle: Vehicle, doubts: Sequence[Suspicion]) -> None:
    """Print a vehicle as one JSON object, in SI units."""
    full = complete(vehicle)
    report = {
        "vehicle": vehicle.name,
        "speed": vehicle.speed,
        "mass": _mass(vehicle),
        "friction": full.friction,
        "drag_area": full.drag_area,
        "drag_height": full.drag_height,
        "units": [
            _numbers(unit)
            | {"wheelbase": _wheelbase(unit), "hitch_load": loads.front_hitch if index else None}
            | {"axles": [_numbers(axle) for axle in unit.axles]}
            for index, (unit, loads) in enumerate(zip(full.units, static_loads(vehicle), strict=True))
        ],
        "given": given(vehicle),
        "assumed": [each._asdict() for each in assumed(vehicle)],
        "implausible": [{"key": doubt.key, "problem": doubt.problem} for doubt in doubts],
    }
    print(json.dumps(report, indent=2))


def print_text(vehicle: Vehicle, doubts: Sequence[Suspicion]) -> None:
    """Print a vehicle as tables; assumed values are marked with an asterisk."""
    full, supposed = complete(vehicle), assumed(vehicle)
    marks = {each.key for each in supposed}
    axle_count = sum(len(unit.axles) for unit in full.units)
    print(
        f"{vehicle.name}: {_count(len(full.units), 'unit')}, {_count(axle_count, 'axle')}, "
        f"{_mass(vehicle) / 1000.0:.2f} t, {vehicle.speed:.4g} m/s ({3.6 * vehicle.speed:.4g} km/h)"
    )
    print("positions from the unit's centre of gravity, forward positive; * assumed\n")
    _print_units(full, marks)
    _print_axles(full, marks)
    if len(full.units) > 1:
        _print_hitches(vehicle, full, marks)
    _print_keys("Given, of what the nonlinear model alone needs", _by_name(given(vehicle)))
    _print_keys("Assumed by the nonlinear model", _by_source(supposed))
    _print_keys("Sources, secondary: typical values, not compared with tables there", _sources(supposed))
    _print_keys("Implausible, axle loads by statics", (f"{doubt.key}: {doubt.problem}" for doubt in doubts))


def _print_units(full: Vehicle, marks: set[str]) -> None:
    rows = [
        [
            unit.name,
            f"{unit.mass / 1000.0:.2f}",
            f"{unit.yaw_inertia / 1000.0:.1f}",
            _marked(unit.cg_height, f"units.{index}.cg_height", marks),
            f"{_wheelbase(unit):.3f}",
            _metres(unit.front_hitch),
            _metres(unit.rear_hitch),
        ]
        for index, unit in enumerate(full.units)
    ]
    columns = ["unit", "mass\nt", "inertia\nt m²", "CG\nhigh m", "wheel-\nbase m", "front\nhitch m"]
    print_table("Units", [*columns, "rear\nhitch m"], rows, width=COLUMNS)


def _print_axles(full: Vehicle, marks: set[str]) -> None:
    rows = []
    for index, unit in enumerate(full.units):
        for place, axle in enumerate(unit.axles):
            key = f"units.{index}.axles.{place}."
            load = axle.static_load or 0.0
            kinds = "\n".join(["steered"] * axle.steered + ["driven"] * bool(axle.driven))
            rows.append(
                [
                    f"{unit.name} {place + 1}",
                    _metres(axle.position),
                    _tonnes(load),
                    f"{axle.cornering_stiffness / 1000.0:.1f}",
                    f"{axle.cornering_stiffness / load:.1f}" if load > 0.0 else "-",
                    _marked(axle.track_width, key + "track_width", marks),
                    _tyre(axle) + "*" * (key + "tyre" in marks),
                    kinds,
                ]
            )
    columns = ["axle", "at m", "load\nt", "stiff\nkN/rad", "over\nload", "track\nm", "tyre", ""]
    print_table("Axles", columns, rows, width=COLUMNS)


def _print_hitches(vehicle: Vehicle, full: Vehicle, marks: set[str]) -> None:
    rows = []
    for index, (unit, behind) in enumerate(zip(full.units, static_loads(vehicle)[1:], strict=False)):
        key = f"units.{index}."
        stiffness = unit.hitch_roll_stiffness or 0.0
        star = "*" * (key + "hitch_roll_stiffness" in marks)
        rows.append(
            [
                unit.name,
                _metres(unit.rear_hitch),
                _tonnes(behind.front_hitch),
                _marked(unit.hitch_height, key + "hitch_height", marks),
                (f"{stiffness / 1000.0:.0f}" if stiffness else "free") + star,
                _marked(math.degrees(unit.max_articulation or 0.0), key + "max_articulation", marks, 0),
            ]
        )
    columns = ["behind", "at m", "load\nt", "height\nm", "in roll\nkN m/rad", "turns to\ndeg"]
    print_table("Hitches", columns, rows, width=COLUMNS)


def _print_keys(title: str, lines: Iterable[str]) -> None:
    print(f"\n{title}:")
    for line in list(lines) or ["nothing"]:
        print(textwrap.fill(line, COLUMNS, initial_indent="  ", subsequent_indent="    "))


def _by_name(keys: Sequence[str]) -> list[str]:
    """Keys by their last part, as a file has them: of all units or axles together."""
    names = [key.rpartition(".")[2] for key in keys]
    counted = ", ".join(f"{name} ({names.count(name)})" for name in dict.fromkeys(names))
    return [counted] if counted else []


def _by_source(supposed: Sequence[Assumed]) -> list[str]:
    """One line for each name that is assumed: its values, each once, and their source."""
    lines: dict[str, list[Assumed]] = {}
    for each in supposed:
        lines.setdefault(each.key.rpartition(".")[2], []).append(each)
    texts = []
    for name, values in lines.items():
        # The tables already show all results of statics.
        if name == "static_load":
            texts.append("static_load: by statics, in the table")
            continue
        shown = ", ".join(dict.fromkeys(_value(each.value) for each in values))
        unit = f" {values[0].unit}" if values[0].unit else ""
        texts.append(f"{name} ({len(values)}): {shown}{unit} ({values[0].source})")
    return texts


def _sources(supposed: Sequence[Assumed]) -> list[str]:
    """Full names of the short names that occur."""
    named = " ".join(each.source for each in supposed)
    return [f"{name}: {text}" for name, text in SOURCES.items() if name in named]


def _value(value: float | bool | str) -> str:  # noqa: FBT001 - a value of the file
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, str):
        return value
    return f"{value:.4g}" if abs(value) < LARGE else f"{value:.0f}"


def _numbers(record: Unit | Axle) -> dict[str, Any]:
    """Fields of a record for JSON, its axles apart."""
    found = {name: value for name, value in vars(record).items() if name != "axles"}
    if isinstance(record, Axle):
        found["tyre"] = _tyre(record)
    return found


def _tyre(axle: Axle) -> str:
    return Path(axle.tyre.name).name if isinstance(axle.tyre, MagicFormula) else str(axle.tyre)


def _wheelbase(unit: Unit) -> float:
    """From the foremost to the rear support: axle groups, or the front hitch of a towed unit."""
    held = supports(unit)
    return held.front - held.rear


def _count(number: int, name: str) -> str:
    return f"{number} {name}" + "s" * (number != 1)


def _mass(vehicle: Vehicle) -> float:
    return math.fsum(unit.mass for unit in vehicle.units)


def _tonnes(force: float) -> str:
    return f"{force / STANDARD_GRAVITY / 1000.0:.2f}"


def _metres(position: float | None) -> str:
    return "" if position is None else f"{position:.3f}"


def _marked(value: float | None, key: str, marks: set[str], digits: int = 2) -> str:
    return f"{value or 0.0:.{digits}f}" + "*" * (key in marks)
