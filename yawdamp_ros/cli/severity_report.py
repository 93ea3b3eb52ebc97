"""Report of `stability --model nonlinear`: stability over the severity of a turn."""

import argparse
import json
import math
from typing import TYPE_CHECKING

from yawdamp_ros.cli.console import progress_of
from yawdamp_ros.cli.errors import UsageError
from yawdamp_ros.cli.extras import require
from yawdamp_ros.cli.options import chosen_vehicle
from yawdamp_ros.cli.table import print_table
from yawdamp_ros.vehicle import STANDARD_GRAVITY

if TYPE_CHECKING:
    from yawdamp_ros.analysis.severity import Severity

CONDITIONS = ("turn", "friction", "braking")
DEFAULT_TURN = 0.3 * STANDARD_GRAVITY
LONGEST_TABLE = 11


def add_conditions(parser: argparse.ArgumentParser) -> None:
    """Add --turn, --friction and --braking."""
    group = parser.add_argument_group("at a severity, with --model nonlinear")
    group.add_argument(
        "--turn",
        type=acceleration,
        metavar="A",
        help="hardest steady turn, in m/s^2 or as in 0.2g; default: 0.3g, or straight with --braking",
    )
    group.add_argument("--friction", type=float, metavar="MU", help="friction of the road")
    group.add_argument("--braking", type=float, metavar="A", help="deceleration by all brakes in m/s^2")


def acceleration(text: str) -> float:
    """Read an acceleration in m/s^2, or in g as in ``0.2g``."""
    try:
        value = float(text.removesuffix("g")) * (STANDARD_GRAVITY if text.endswith("g") else 1.0)
    except ValueError:
        value = math.nan
    if not 0.0 <= value <= 2.0 * STANDARD_GRAVITY:
        message = f"{text!r}: expected m/s^2 from 0 to 19.6, or g as in 0.2g"
        raise argparse.ArgumentTypeError(message)
    return value


def run(options: argparse.Namespace) -> int:
    """Find, draw and print; 1 if a turn is unstable or there is none."""
    # Numba takes long to import, which no linear question waits for.
    from yawdamp_ros.analysis.severity import severity  # noqa: PLC0415

    for name, most in (("friction", 2.0), ("braking", STANDARD_GRAVITY)):
        value = getattr(options, name)
        if value is not None and not 0.0 < value < most:
            message = f"--{name}: {value:g}: expected a number above 0 and below {most:g}"
            raise UsageError(message)
    hardest = options.turn
    if hardest is None:
        hardest = 0.0 if options.braking else DEFAULT_TURN
    found = severity(
        chosen_vehicle(options),
        hardest,
        friction=options.friction,
        braking=options.braking or 0.0,
        progress=progress_of("turning"),
    )
    if options.plot:
        require("matplotlib")
        from yawdamp_ros.pictures import save  # noqa: PLC0415 - matplotlib takes long to load
        from yawdamp_ros.pictures.severity import severity_figure  # noqa: PLC0415

        save(severity_figure(found), options.plot)
    if options.format == "json":
        print(json.dumps(_record(found), indent=2))
    else:
        _print(found)
    return 0 if found.stable else 1


def _record(found: "Severity") -> dict[str, object]:
    units = found.vehicle.unit_names
    return {
        "vehicle": found.vehicle.name,
        "model": "nonlinear",
        "speed": found.speed,
        "stable": found.stable,
        "limit": found.limit or None,
        "turns": [
            {
                "lateral_acceleration": found.lateral_acceleration[turn],
                "braking": found.braking[turn],
                "steering_angle": found.steering[turn],
                "least_damping_ratio": found.least_damping_ratio[turn],
                "eigenvalues": [[value.real, value.imag] for value in found.eigenvalues[turn].tolist()],
                "handling": dict(zip(units, found.handling[turn].tolist(), strict=True)),
                "roll": dict(zip(units, found.roll[turn].tolist(), strict=True)),
                "load_transfer_ratio": dict(
                    zip(units, found.load_transfer_ratio[turn].tolist(), strict=True)
                ),
            }
            for turn in range(len(found.lateral_acceleration))
        ],
    }


def _print(found: "Severity") -> None:
    count = len(found.lateral_acceleration)
    stride = max(1, -(-(count - 1) // (LONGEST_TABLE - 1)))
    chosen = sorted({*range(0, count, stride), count - 1})
    ratios, worst = found.least_damping_ratio, found.eigenvalues.real.max(axis=1)
    print_table(
        f"{found.vehicle.name} at {found.speed:.4g} m/s, nonlinear model",
        (
            "braking [g]" if found.straight else "turn [g]",
            "steer [deg]",
            "damping ratio",
            "largest real part",
            "load transfer",
            "",
        ),
        [
            (
                f"{found.values[turn] / STANDARD_GRAVITY:.3f}",
                f"{math.degrees(found.steering[turn]):.2f}",
                f"{ratios[turn]:.3f}",
                f"{worst[turn]:.3f}",
                f"{abs(found.load_transfer_ratio[turn]).max():.2f}",
                "stable" if worst[turn] < 0.0 else "unstable",
            )
            for turn in chosen
        ],
    )
    if found.limit:
        print(f"limit: {found.limit}")
