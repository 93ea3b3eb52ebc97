"""`assess`: a combination against the measures of the field."""

import argparse
import json
from collections.abc import Sequence
from datetime import datetime
from pathlib import Path

from yawdamp_ros.analysis import (
    Assessment,
    Finding,
    Scheme,
    assess,
    builtin_schemes,
    failed,
    load_scheme,
)
from yawdamp_ros.analysis.assessment import differences
from yawdamp_ros.analysis.engineering import SI, SYSTEMS
from yawdamp_ros.analysis.measures import NONLINEAR
from yawdamp_ros.analysis.schemes import DEFAULT_SCHEME
from yawdamp_ros.cli import assess_report
from yawdamp_ros.cli.draws import check_draws
from yawdamp_ros.cli.errors import UsageError
from yawdamp_ros.cli.extras import require
from yawdamp_ros.cli.number import ROUNDING_NOISE, number
from yawdamp_ros.cli.options import (
    DEFAULT_MODEL,
    DEFAULT_VEHICLE,
    Parser,
    add_vehicle_options,
    chosen_vehicle,
)
from yawdamp_ros.cli.table import print_table
from yawdamp_ros.simulation import MODELS

PAGES = (".html", ".htm")


def main(argv: Sequence[str]) -> int:
    """Run the command; 1 if a limit is failed."""
    options = _parser().parse_args(argv)
    _check(options)
    if options.differences:
        return _differences(options)
    scheme = load_scheme(options.scheme, options.measures, options.vehicle_class)
    if options.random is not None:
        return _many(options, scheme)
    assessments = [_assessed(options, scheme, name) for name in options.vehicle or [DEFAULT_VEHICLE]]
    _write_files(options, assessments)
    if options.format == "json":
        assess_report.print_json(assessments)
    elif options.format == "csv":
        assess_report.print_csv(assessments, options.units)
    else:
        if len(assessments) > 1:
            assess_report.print_side_by_side(assessments, options.units)
        else:
            assess_report.print_text(assessments[0], options.units)
        if options.definitions:
            assess_report.print_definitions(assessments[0])
    return 1 if any(failed(one.findings) for one in assessments) else 0


def _write_files(options: argparse.Namespace, assessments: Sequence[Assessment]) -> None:
    """Write the requested page, print and spreadsheet."""
    if options.html or options.pdf:
        # Imported here: the libraries of the page take longer to load than most assessments take.
        from yawdamp_ros.pictures.assessment_page import Heading, assessment_page  # noqa: PLC0415
        from yawdamp_ros.pictures.page import print_page, save_page  # noqa: PLC0415

        heading = Heading(
            options.project, options.author, options.date or datetime.now().astimezone().date().isoformat()
        )
        page = assessment_page(assessments, heading, options.units)
        if options.html:
            save_page(page, options.html)
        if options.pdf:
            print_page(page, options.pdf)
    if options.xlsx:
        from yawdamp_ros.cli.workbook import save_workbook  # noqa: PLC0415

        save_workbook(assess_report.table(assessments, options.units), options.xlsx)


def _assessed(options: argparse.Namespace, scheme: Scheme, name: str) -> Assessment:
    vehicle = chosen_vehicle(options, name)
    model = options.model or DEFAULT_MODEL
    findings = assess(vehicle, model, options.speed, options.srt, scheme, options.level)
    return Assessment(vehicle, model, scheme, options.level, findings)


def _many(options: argparse.Namespace, scheme: Scheme) -> int:
    """Print the share of many vehicles that meets the level."""
    for name in ("html", "pdf", "xlsx"):
        if getattr(options, name) is not None:
            message = f"--{name}: not with --random, which judges many vehicles"
            raise UsageError(message)
    names = options.vehicle or [DEFAULT_VEHICLE]
    if len(names) > 1 or options.format == "csv":
        message = "--random: expected one --vehicle, and text or json"
        raise UsageError(message)
    from yawdamp_ros.cli import assess_sweep  # noqa: PLC0415 - it brings what sweeps need

    return assess_sweep.run(options, scheme, names[0])


def _check(options: argparse.Namespace) -> None:
    check_draws(options)
    if options.jobs is not None and options.random is None:
        message = "--jobs: it goes with --random"
        raise UsageError(message)
    for name, endings in (("html", PAGES), ("pdf", (".pdf",)), ("xlsx", (".xlsx",))):
        path = getattr(options, name)
        if path is not None and Path(path).suffix.lower() not in endings:
            message = f"--{name}: {path}: expected a name ending in {' or '.join(endings)}"
            raise UsageError(message)
        if path is not None and options.model == NONLINEAR and not options.differences and name != "xlsx":
            message = f"--{name}: its pictures are of a linear model; not with --model nonlinear"
            raise UsageError(message)
    if options.xlsx:
        require("openpyxl")


def _differences(options: argparse.Namespace) -> int:
    """Print the difference of each measure between the models, at its own manoeuvre."""
    for name in ("html", "pdf", "xlsx", "srt", "model", "level", "vehicle_class", "random"):
        if getattr(options, name) is not None:
            message = f"--{name.rpartition('_')[2]}: not with --differences, which compares the models"
            raise UsageError(message)
    vehicles = options.vehicle or [DEFAULT_VEHICLE]
    if len(vehicles) > 1:
        message = "--vehicle: expected one with --differences, which compares the models"
        raise UsageError(message)
    vehicle = chosen_vehicle(options, vehicles[0])
    pairs = differences(vehicle, options.speed)
    if options.format == "json":
        records = [
            {
                "measure": linear.measure.name,
                "unit": linear.measure.unit,
                "consistent": linear.value,
                "nonlinear": nonlinear.value,
                "difference": _difference(linear, nonlinear),
                "reason": nonlinear.reason or None,
            }
            for linear, nonlinear in pairs
        ]
        print(json.dumps(records, indent=2))
        return 0
    print_table(
        f"{vehicle.name}: the linear and the nonlinear model",
        ("measure", "consistent", "nonlinear", "difference", "unit"),
        [
            (
                linear.measure.name,
                _number(linear.value),
                _number(nonlinear.value),
                "" if (by := _difference(linear, nonlinear)) is None else f"{100.0 * by:+.0f} %",
                linear.measure.unit,
            )
            for linear, nonlinear in pairs
        ],
    )
    for reason in dict.fromkeys(nonlinear.reason for _, nonlinear in pairs if nonlinear.reason):
        print(f"no value: {reason}")
    return 0


def _difference(linear: Finding, nonlinear: Finding) -> float | None:
    """Relative difference of the nonlinear value; None without one, or from 0."""
    if linear.value is None or nonlinear.value is None or abs(linear.value) < ROUNDING_NOISE:
        return None
    return nonlinear.value / linear.value - 1.0


def _number(value: float | None) -> str:
    return "none" if value is None else number(value)


def _parser() -> argparse.ArgumentParser:
    parser = Parser(
        "assess",
        "Rearward amplification, yaw damping, offtracking, understeer and critical speed of a combination,\n"
        "with the levels of the Australian PBS scheme and of RTAC; by --scheme all measures of one scheme,\n"
        "turns at low speed, rollover and powertrain among them, with one verdict. Each measure is taken at\n"
        "the speed that its standard names, else at the vehicle's own; --speed is for all.\n"
        "Exit status: 0 if no level is failed, 1 if one is or may be, 2 for wrong use.",
        "yawdamp assess --vehicle a_double --scheme pbs --level 2\n"
        "  yawdamp assess --scheme pbs --level 2 --random 1000 --range units.2.mass=20000:32000",
    )
    add_vehicle_options(parser, MODELS, several=True)
    group = parser.add_argument_group("scheme")
    group.add_argument(
        "--scheme",
        default=DEFAULT_SCHEME,
        metavar="NAME|FILE",
        help=f"{', '.join(builtin_schemes())}, or a file of your own (default: {DEFAULT_SCHEME})",
    )
    group.add_argument(
        "--measures",
        metavar="M,M",
        help="only these of the scheme, separated by commas, as rollover needs no runs",
    )
    group.add_argument(
        "--class",
        dest="vehicle_class",
        metavar="C",
        help="of vehicles, whose own limits count: of pbs tanker (of dangerous goods) and bus",
    )
    group.add_argument("--level", metavar="L", help="of the scheme; unless given its easiest one decides")
    group.add_argument(
        "--srt",
        type=float,
        metavar="G",
        help="static rollover threshold of the rear roll-coupled unit in g, as measured, in place of the "
        f"computed one; {DEFAULT_SCHEME} computes none, so that without it the level that takes it is open",
    )
    _add_many(parser)
    group = parser.add_argument_group("answer")
    group.add_argument("--format", choices=("text", "json", "csv"), default="text", help="default: text")
    group.add_argument(
        "--units", choices=SYSTEMS, default=SI, help="of text and CSV: km/h, t, kN, deg (default: si)"
    )
    group.add_argument(
        "--differences",
        action="store_true",
        help="by how much each measure differs by the nonlinear model, at its own manoeuvre",
    )
    group.add_argument(
        "--html",
        metavar="FILE",
        help="also write one page for a browser: table, curves, animated plan view, mode shapes, definitions",
    )
    group.add_argument(
        "--pdf", metavar="FILE", help="the same page on A4, by an installed Chromium or Chrome"
    )
    group.add_argument("--xlsx", metavar="FILE", help="also write the table of --format csv as a spreadsheet")
    for name in ("project", "author", "date"):
        group.add_argument(f"--{name}", default="", metavar="TEXT", help=f"{name} that the page names")
    group.add_argument(
        "--definitions", action="store_true", help="also say what each measure is, and its levels in full"
    )
    return parser


def _add_many(parser: argparse.ArgumentParser) -> None:
    """Add --random, --range, --seed and --jobs."""
    group = parser.add_argument_group("many vehicles")
    group.add_argument("--random", type=int, metavar="N", help="draw N vehicles, evenly from every --range")
    group.add_argument(
        "--range", action="append", default=[], metavar="KEY=A:B", help="range of a key; may be repeated"
    )
    group.add_argument("--seed", type=int, help="the same seed draws the same (default: 0)")
    group.add_argument("--jobs", type=int, metavar="N", help="processes (default: one a core)")
