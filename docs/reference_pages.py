"""Pages and tables of the manual's reference that are made from the code and from measurements."""

import inspect
import json
import os
import statistics
import subprocess
import sys
from collections.abc import Iterator, Mapping
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

from ruamel.yaml import YAML

import parameter_table
from yawdamp_ros.cli.dispatch import COMMANDS
from yawdamp_ros.share import share_directory
from yawdamp_ros.vehicle import builtin_vehicles, load_vehicle, vehicle_text

ROOMS = (
    *("vehicle", "dynamics", "nonlinear", "stepping", "manoeuvres", "simulation"),
    *("analysis", "drives", "logs", "runs", "pictures", "library"),
)
"""Rooms of the library that the reference describes, from the vehicle file upwards."""


def write(directory: Path) -> None:
    """Write every page; a page that is already the same keeps its time, so that a build is incremental.

    Pages of names that are no longer exported are removed.
    """
    exported = {f"yawdamp_ros.{room}.{name}.rst" for room in ROOMS for name in _public(room)}
    for path in (directory / "library").glob("*.rst"):
        if path.name not in exported:
            path.unlink()
    pages = {
        "commands.md": _commands(),
        "parameters.md": _parameters(),
        "vehicle_file.md": _vehicle_file(),
        "library.md": _library(),
        "vehicles.md": _vehicles(),
        "inputs.inc": parameter_table.input_table(),
        "outputs.inc": parameter_table.output_table(),
        "performance.inc": _performance(directory.parents[1] / "bench"),
    }
    for name, text in pages.items():
        path = directory / name
        if not path.is_file() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")


def _commands() -> str:
    overview = "".join(f"| [`{name}`](#{name}) | {summary} |\n" for name, summary in COMMANDS.items())
    sections = "".join(
        f"\n## {name}\n\n{summary[0].upper()}{summary[1:]}.\n\n```text\n{help_of(name)}```\n"
        for name, summary in COMMANDS.items()
    )
    return (
        "# Commands\n\n"
        "A command is `yawdamp NAME`, `python -m yawdamp_ros NAME`, or, with ROS, "
        "`ros2 run yawdamp_ros NAME`. `make setup` puts `yawdamp` into `.venv/bin`; "
        "`pip install '.[ros,pictures]'` installs it into an environment of your own. Pictures and "
        "clusters need libraries that `rosdep` does not install; the commands say which.\n\n"
        "Every command has `--help`. Wrong use is one line on stderr and exit status 2; a negative answer "
        "(an unstable vehicle, a level that is missed, a run that does not repeat) is exit status 1. "
        "Commands that look at a vehicle take `--vehicle` (a builtin name or a file), `--speed`, `--model` "
        "and `--set units.1.mass=4156`.\n\n"
        f"| command | |\n|---|---|\n{overview}"
        f"{sections}"
    )


@cache
def help_of(name: str) -> str:
    """Help of a command as a terminal of 80 columns shows it."""
    done = subprocess.run(  # noqa: S603 - the project's own commands
        [sys.executable, "-m", "yawdamp_ros", name, "--help"],
        env={**os.environ, "COLUMNS": "80", "NO_COLOR": "1"},
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stdout


def _parameters() -> str:
    return (
        "# Parameters of the node\n\n"
        "Set a parameter with `--ros-args -p NAME:=VALUE`, with `--params-file`, or, where the table says "
        "*while running*, with `ros2 param set`. Write a number as it is declared: `100.0`, not `100`.\n\n"
        f"{parameter_table.table()}\n"
    )


def _vehicle_file() -> str:
    schema = json.loads((share_directory() / "config" / "vehicle.schema.json").read_text(encoding="utf-8"))
    tables = [("the file", schema), *schema["$defs"].items()]
    sections = "".join(
        f"\n## {name[0].upper()}{name[1:].replace('_', ' ')}\n\n{_table(part, schema)}\n"
        for name, part in tables
        if "properties" in part
    )
    return (
        "# Vehicle file\n\n"
        "A vehicle file is YAML in SI units and radians. Positions are measured from the centre of gravity "
        "of the unit, forward positive. An editor that reads JSON Schema checks a file against "
        "`config/vehicle_file.schema.json` while you type; it has the other spellings, too.\n"
        f"{sections}"
    )


def _table(part: Mapping[str, Any], schema: Mapping[str, Any]) -> str:
    required = set(part.get("required", ()))
    rows = [
        f"| `{key}` | {'yes' if key in required else 'no'} | {_described(value, schema)} |"
        for key, value in part["properties"].items()
    ]
    return "\n".join(["| key | required | |", "|---|---|---|", *rows])


def _described(part: Mapping[str, Any], schema: Mapping[str, Any]) -> str:
    while "description" not in part and "$ref" in part:
        found: Any = schema
        for name in part["$ref"].removeprefix("#/").split("/"):
            found = found[name]
        part = found
    return str(part.get("description", "")).replace("|", "\\|")


def _vehicles() -> str:
    rows = []
    for name in builtin_vehicles():
        vehicle, text = load_vehicle(name), YAML(typ="safe", pure=True).load(vehicle_text(name))
        mass = sum(unit.mass for unit in vehicle.units) / 1000.0
        rows.append(
            f"| `{name}` | {len(vehicle.units)} | {mass:.1f} | {' '.join(text['description'].split())} |\n"
        )
    return (
        "# Builtin vehicles\n\n"
        "`--vehicle NAME` takes one of these, or the path of a [vehicle file](vehicle_file.md). "
        "`yawdamp show NAME` lists its numbers.\n\n"
        f"| name | units | mass [t] | source |\n|---|---|---|---|\n{''.join(rows)}"
    )


def _performance(directory: Path) -> str:
    measured = json.loads((directory / "results.json").read_text(encoding="utf-8"))
    rows = []
    for row in measured["rows"]:
        value, reference = statistics.median(row["value"]), statistics.median(row["reference"])
        unit = row["unit"]
        figures = (
            f"{_figure(value, unit)} | {row['against']} | {_figure(reference, unit)} | {row['ratio']:.3g}"
        )
        rows.append(f"| {row['what']} | {figures} | {row['wanted']} |\n")
    head = "| what | median | against | median | ratio | aim |\n|---|---|---|---|---|---|\n"
    return f"Measured on {measured['machine']}.\n\n{head}{''.join(rows)}"


def _figure(value: float, unit: str) -> str:
    """Three digits of a value and its unit, times below a second in ms or µs."""
    for factor, name in ((1.0, "s"), (1e3, "ms"), (1e6, "µs")):
        if unit == "s" and (value * factor >= 1.0 or name == "µs"):
            return f"{value * factor:.3g} {name}"
    return f"{value:.0f} {unit}" if value >= 100.0 else f"{value:.3g} {unit}".rstrip()  # noqa: PLR2004


def _library() -> str:
    sections = "".join(_room(name) for name in ROOMS)
    return (
        "# Library\n\n"
        "Import what you need from `yawdamp_ros` or from one of its rooms. None of them imports ROS.\n"
        f"{sections}"
    )


def _room(name: str) -> str:
    module = import_module(f"yawdamp_ros.{name}")
    summary = (module.__doc__ or "").splitlines()[0]
    public = "\n".join(f"   {item}" for item in _public(name))
    return (
        f"\n## yawdamp_ros.{name}\n\n{summary}\n\n"
        f"```{{eval-rst}}\n.. currentmodule:: yawdamp_ros.{name}\n\n"
        f".. autosummary::\n   :toctree: library\n\n{public}\n```\n"
    )


def _public(room: str) -> Iterator[str]:
    module = import_module(f"yawdamp_ros.{room}")
    for name in sorted(module.__all__, key=str.lower):
        if inspect.isclass(found := getattr(module, name)) or inspect.isfunction(found):
            yield name
