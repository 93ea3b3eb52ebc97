"""`identify`: parameters of a vehicle from a drive."""

import json
import math
import sys
from collections.abc import Sequence
from pathlib import Path

from yawdamp_ros.cli.drive_report import (
    COMPARISON_COLUMNS,
    comparison_record,
    comparison_rows,
    label,
    r_squared_range,
    told,
    vehicle_line,
)
from yawdamp_ros.cli.log_options import add_log_options, chosen_drive
from yawdamp_ros.cli.options import (
    DEFAULT_MODEL,
    Parser,
    add_format_option,
    add_vehicle_options,
    chosen_name,
    chosen_vehicle,
    overrides,
)
from yawdamp_ros.cli.table import print_table
from yawdamp_ros.drives import DEFAULT, Drive, Estimate, Identification, identify
from yawdamp_ros.drives.identification import predictor_of
from yawdamp_ros.simulation import MODELS
from yawdamp_ros.vehicle import Vehicle, parse_vehicle, vehicle_source

ESTIMATE_COLUMNS = ("parameter", "value", "95 % interval", "unit")


def main(arguments: Sequence[str]) -> int:
    """Fit parameters and print them; 1 if the drive does not determine a requested one."""
    options = _parser().parse_args(arguments)
    drive = chosen_drive(options.log, options, options.duration)
    vehicle = chosen_vehicle(options)
    if options.speed is not None:
        drive = drive.without("speed", "acceleration")
    source = vehicle_source(chosen_name(options), overrides(options))
    asked = list(dict.fromkeys(options.fit or DEFAULT))
    found = identify(
        drive,
        source,
        asked,
        predictor=predictor_of(options.model or DEFAULT_MODEL),
        fitted_share=options.share,
    )
    model = options.model or DEFAULT_MODEL
    title = f"{Path(options.log).name}: {vehicle.name}, {model} model"
    if options.html:
        from yawdamp_ros.pictures.page import save_page  # noqa: PLC0415 - as for `_page`

        identified = parse_vehicle(source.text, vehicle.name, [*source.overrides, *found.overrides])
        save_page(_page(drive, identified, model, found, asked), options.html)
    if options.format == "json":
        print(json.dumps(_record(options.log, drive, found), indent=2))
    else:
        _print_text(title, drive, found)
    for warning in found.warnings:
        print(f"warning: {warning}", file=sys.stderr)
    return 0 if all(found[each].seen for each in asked) else 1


def _estimate_rows(found: Identification) -> list[tuple[str, ...]]:
    rows: list[tuple[str, ...]] = []
    for each in found.estimates:
        value, low, high = _figures(each)
        rows.append((label(each.parameter.name), value, f"{low} to {high}", each.parameter.unit or "-"))
    return rows


def _figures(estimate: Estimate) -> tuple[str, ...]:
    """Value and ends of the interval, to two figures of the interval's width."""
    width = estimate.high - estimate.low
    decimals = min(max(1 - math.floor(math.log10(width)), 0), 9) if 0.0 < width < math.inf else 9
    return tuple(f"{number:.{decimals}f}" for number in (estimate.value, estimate.low, estimate.high))


def _print_text(title: str, drive: Drive, found: Identification) -> None:
    print("\n".join(["Taken from the drive:", *(f"  {line}" for line in told(drive))]))
    for note in found.notes:
        print(f"note: {note}")
    print_table(title, ESTIMATE_COLUMNS, _estimate_rows(found))
    names = [each.parameter.name for each in found.estimates]
    asked = [index for index, name in enumerate(names) if not name.startswith("offset of ")]
    print_table(
        "Correlations of the estimates",
        ("", *(names[index] for index in asked)),
        [
            (label(name), *(f"{found.correlations[row, column]:.2f}" for column in asked))
            for row, name in enumerate(names)
        ],
    )
    print_table("Before, on the part kept to check", COMPARISON_COLUMNS, comparison_rows(found.before))
    print_table("Fitted, on the part kept to check", COMPARISON_COLUMNS, comparison_rows(found.checked))
    print(f"Residuals: autoregression of order {found.noise_order}. The identified vehicle:")
    print("\n".join(f"  --set {change}" for change in found.overrides) or "  as the file has it")


def _record(log: str, drive: Drive, found: Identification) -> dict[str, object]:
    return {
        "drive": log,
        "taken": told(drive),
        "notes": list(found.notes),
        "parameters": [
            {
                "name": each.parameter.name,
                "unit": each.parameter.unit,
                "start": each.parameter.start,
                "value": each.value,
                "low": each.low,
                "high": each.high,
                "seen": each.seen,
            }
            for each in found.estimates
        ],
        "correlations": found.correlations.tolist(),
        "noise_order": found.noise_order,
        "before": [comparison_record(each) for each in found.before],
        "fitted": [comparison_record(each) for each in found.fitted],
        "checked": [comparison_record(each) for each in found.checked],
        "overrides": found.overrides,
        "warnings": found.warnings,
    }


def _page(drive: Drive, vehicle: Vehicle, model: str, found: Identification, asked: Sequence[str]) -> str:
    # Imported here: the table appears before the library for pages has loaded.
    from yawdamp_ros.pictures.drive_page import DriveReport, PageTable, drive_page  # noqa: PLC0415

    unseen = [name for name in asked if not found[name].seen]
    named = ", ".join(name.replace("_", " ") for name in unseen or asked)
    kept = "the part kept to check"
    report = DriveReport(
        title=f"{Path(drive.source).name}: parameters of {vehicle.name}",
        subtitle=vehicle_line(vehicle, model),
        verdict=f"The drive {'does not determine' if unseen else 'determines'} {named}. R2 on {kept}: "
        f"{r_squared_range(found.checked)}, before the fit {r_squared_range(found.before)}",
        passed=not unseen,
        vehicle=vehicle,
        tables=[
            PageTable(
                "Parameters",
                ESTIMATE_COLUMNS[:-1],
                [
                    (f"{name}, {unit}".removesuffix(", -"), *rest)
                    for name, *rest, unit in _estimate_rows(found)
                ],
            ),
            PageTable(f"Before, on {kept}", COMPARISON_COLUMNS, comparison_rows(found.before)),
            PageTable(f"Fitted, on {kept}", COMPARISON_COLUMNS, comparison_rows(found.checked)),
        ],
        notes=[*(f"Warning: {each}." for each in found.warnings), *found.notes],
        taken=told(drive),
        comparisons=[
            (f"{kept[0].upper()}{kept[1:]}", found.checked),
            ("The part that was fitted", found.fitted),
        ],
    )
    return drive_page(report)


def _parser() -> Parser:
    parser = Parser(
        "identify",
        "Parameters of a vehicle from a recorded drive, by maximum likelihood, each with its 95 % interval.\n"
        "Fitted on the first part of the drive, checked on the rest. A --fit is one of\n"
        "  stiffness, inertia           factors of all cornering stiffnesses, of all yaw inertias\n"
        "  stiffness.UNIT, inertia.UNIT the same of one unit\n"
        "  steering_offset              what the log shows when the wheels are straight, road wheel, rad\n"
        "  steering_ratio               factor of --steering-ratio\n"
        "  steering_time_constant       first-order lag of the steering, s\n"
        "  friction                     of the road, by --model nonlinear\n"
        "  units.1.load.0.position ..   any number of the vehicle file, by its key\n"
        "Exit status: 0, 1 if one of them cannot be seen in the drive, 2 for wrong use.",
        "yawdamp identify drive.csv --vehicle truck_trailer --fit stiffness --fit inertia",
    )
    parser.add_argument("log", metavar="LOG", help="CSV, MCAP file, rosbag2 directory or .mat file")
    parser.add_argument(
        "--fit",
        action="append",
        default=[],
        metavar="NAME",
        help=f"a parameter; may be repeated (default: {', '.join(DEFAULT)})",
    )
    parser.add_argument(
        "--share", type=float, default=2.0 / 3.0, metavar="PART", help="that is fitted (default: 0.667)"
    )
    parser.add_argument("--duration", type=float, metavar="S", help="of the log; default: to its end")
    parser.add_argument("--html", metavar="FILE", help="also write a page with the curves over each other")
    add_format_option(parser)
    add_vehicle_options(parser, MODELS)
    add_log_options(parser)
    return parser
