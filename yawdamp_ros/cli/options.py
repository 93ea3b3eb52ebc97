"""Options that several commands share."""

import argparse
import sys
from collections.abc import Iterable, Sequence
from typing import Any, NoReturn

from yawdamp_ros.cli.errors import UsageError
from yawdamp_ros.cli.program import program
from yawdamp_ros.dynamics import MODELS as LINEAR_MODELS
from yawdamp_ros.dynamics import LinearModel, linear_model
from yawdamp_ros.errors import one_line
from yawdamp_ros.manoeuvres import MANOEUVRES
from yawdamp_ros.simulation import SimParameters
from yawdamp_ros.vehicle import Vehicle, examined_vehicle, vehicle_text

DEFAULT_VEHICLE = "interlink"
DEFAULT_MODEL = "consistent"
MANOEUVRE_SETTINGS = {
    "amplitude": ("RAD", "road-wheel steer angle, left positive"),
    "frequency": ("HZ", "of the sine, or at the start of the chirp"),
    "start": ("S", "when the steering begins"),
    "cycles": ("N", "of the sine; 0: until the end"),
    "rise-time": ("S", "of the ramp"),
    "width": ("S", "of the pulse"),
    "final-frequency": ("HZ", "of the chirp"),
    "sweep-time": ("S", "of the chirp"),
}


class _Once(argparse.Action):
    """Store a value; refuse a repeated option, because one of its values would be lost."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: str | Sequence[Any] | None,
        option_string: str | None = None,
    ) -> None:
        if isinstance(parser, Parser) and option_string is not None:
            if self.dest in parser.given:
                parser.error(f"{option_string}: given twice; expected it once")
            parser.given.add(self.dest)
        setattr(namespace, self.dest, values)


RUN_SETTINGS = (
    "longitudinal_source",
    "friction_file",
    "max_steering_angle",
    "steering_timeout",
    "on_steering_timeout",
    "steering_time_constant",
    "steering_rate_limit",
    "max_lateral_acceleration",
    "max_articulation",
)
"""Settings of `SimParameters` for the longitudinal motion, the steering and the limits of a run."""

START_SETTINGS: tuple[tuple[str, str | tuple[str, ...], str | int | None], ...] = (
    ("initial_speed", "M/S", None),
    ("initial_pose", ("X", "Y", "YAW"), 3),
    ("initial_articulation", "RAD", "+"),
)
"""Settings of the start, with the names and the number of their values."""


class Parser(argparse.ArgumentParser):
    """An argument parser: errors are a line, options count once, examples begin with ``yawdamp``."""

    def __init__(self, name: str, description: str, example: str) -> None:
        super().__init__(
            prog=f"{program()} {name}",
            description=description,
            epilog=f"example:\n  {example}".replace("  yawdamp ", f"  {program()} "),
            formatter_class=argparse.RawDescriptionHelpFormatter,
            allow_abbrev=False,
        )
        self.given: set[str] = set()
        for stored in (None, "store"):
            self.register("action", stored, _Once)

    def error(self, message: str) -> NoReturn:
        """Raise the error as a `UsageError`."""
        raise UsageError(message)


def add_vehicle_options(
    parser: argparse.ArgumentParser, models: Iterable[str] = LINEAR_MODELS, *, several: bool = False
) -> None:
    """Add --vehicle, once or several times, --speed, --model and --set; an omitted one is None."""
    group = parser.add_argument_group("vehicle")
    explanation = f"builtin name or file (default: {DEFAULT_VEHICLE})"
    if several:
        group.add_argument("--vehicle", action="append", help=f"{explanation}; may be repeated, to compare")
    else:
        group.add_argument("--vehicle", help=explanation)
    group.add_argument("--speed", type=float, metavar="M/S", help="default: the vehicle's own")
    if models:
        group.add_argument("--model", choices=tuple(models), help=f"default: {DEFAULT_MODEL}")
    group.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="KEY=VALUE",
        help="change the vehicle, as in units.1.mass=4156 (from 0, or by name; * is all); may be repeated",
    )


def overrides(options: argparse.Namespace) -> list[str]:
    """Changes to the vehicle by --set and --speed, one for each key.

    Raises
    ------
    UsageError
        If a key is set twice: one of its values would be lost.
    """
    changes = [*options.set, *([] if options.speed is None else [f"speed={options.speed!r}"])]
    keys = [change.partition("=")[0] for change in changes]
    for key in keys:
        if keys.count(key) > 1:
            message = f"--set: {key}: given twice; expected it once"
            raise UsageError(message)
    return changes


def chosen_name(options: argparse.Namespace) -> str:
    """Builtin name or path of the vehicle that the options name."""
    return DEFAULT_VEHICLE if options.vehicle is None else str(options.vehicle)


def chosen_vehicle(options: argparse.Namespace, name: str | None = None) -> Vehicle:
    """Vehicle of the options, or of a name, with overrides and speed; warn of implausible values."""
    name = chosen_name(options) if name is None else name
    vehicle, doubts = examined_vehicle(vehicle_text(name), name, overrides(options))
    for doubt in doubts:
        print(one_line(f"warning: {name}: {doubt}"), file=sys.stderr)
    return vehicle


def chosen_model(options: argparse.Namespace) -> LinearModel:
    """Linear model of the vehicle that the options name."""
    return linear_model(chosen_vehicle(options), model=options.model or DEFAULT_MODEL)


def add_format_option(parser: argparse.ArgumentParser) -> None:
    """Add --format."""
    parser.add_argument("--format", choices=("text", "json"), default="text", help="default: text")


def add_manoeuvre_options(parser: argparse.ArgumentParser) -> None:
    """Add --manoeuvre and its settings."""
    group = parser.add_argument_group("manoeuvre")
    group.add_argument("--manoeuvre", choices=tuple(MANOEUVRES), help="the steering")
    for setting, (metavar, explanation) in MANOEUVRE_SETTINGS.items():
        group.add_argument(f"--{setting}", type=float, metavar=metavar, help=explanation)


def add_run_settings(parser: argparse.ArgumentParser) -> None:
    """Add the options common to `sim` and `simulate`, from the settings record."""
    group = parser.add_argument_group("steering and limits")
    for name in RUN_SETTINGS:
        declared = SimParameters.__dataclass_fields__[name]
        default = "none" if declared.default == "" else declared.default
        group.add_argument(
            f"--{name.replace('_', '-')}",
            type=type(declared.default),
            choices=declared.metadata["choices"] or None,
            metavar=None if declared.metadata["choices"] else "X",
            help=f"{declared.metadata['description']}; default: {default}",
        )


def run_settings(options: argparse.Namespace) -> dict[str, Any]:
    """Return the given ones, by field name.

    Raises
    ------
    UsageError
        If one is out of its range.
    """
    return _given(options, RUN_SETTINGS)


def add_start_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of the start, as the parameters of the node."""
    group = parser.add_argument_group("start")
    for name, metavar, count in START_SETTINGS:
        declared = SimParameters.__dataclass_fields__[name].metadata
        otherwise = f"; default: {declared['otherwise']}" if declared["otherwise"] else ""
        group.add_argument(
            f"--{name.replace('_', '-')}",
            type=float,
            nargs=count,
            metavar=metavar,
            help=declared["description"] + otherwise,
        )


def start_settings(options: argparse.Namespace) -> dict[str, Any]:
    """Return the given options of the start, by field name.

    Raises
    ------
    UsageError
        If the speed is out of its range.
    """
    return _given(options, [name for name, _, _ in START_SETTINGS])


def _given(options: argparse.Namespace, names: Iterable[str]) -> dict[str, Any]:
    """Return the given ones of some settings, each within its range."""
    given = {name: value for name in names if (value := getattr(options, name)) is not None}
    for name, value in given.items():
        limits = SimParameters.__dataclass_fields__[name].metadata["limits"]
        if limits and not limits[0] <= value <= limits[1]:
            low, high = limits
            message = f"--{name.replace('_', '-')}: {value}: expected a number from {low:g} to {high:g}"
            raise UsageError(message)
    return given


def manoeuvre_settings(options: argparse.Namespace) -> dict[str, float]:
    """Settings that were given, by field name."""
    names = [setting.replace("-", "_") for setting in MANOEUVRE_SETTINGS]
    return {name: value for name in names if (value := getattr(options, name)) is not None}
