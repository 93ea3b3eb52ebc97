"""`assess`: a combination against the measures that the field judges it by."""

import argparse
import json
import math
from collections.abc import Sequence
from pathlib import Path

from yawdamp_ros.analysis import Finding, assess, failed
from yawdamp_ros.analysis.assessment import differences
from yawdamp_ros.analysis.measures import NONLINEAR
from yawdamp_ros.cli.errors import UsageError
from yawdamp_ros.cli.number import ROUNDING_NOISE, number
from yawdamp_ros.cli.options import (
    DEFAULT_MODEL,
    Parser,
    add_format_option,
    add_vehicle_options,
    chosen_vehicle,
)
from yawdamp_ros.cli.table import print_table
from yawdamp_ros.simulation import MODELS
from yawdamp_ros.vehicle import STANDARD_GRAVITY

PAGES = (".html", ".htm")
VERDICTS = {True: "pass", False: "FAIL", None: "n/a"}


def main(argv: Sequence[str]) -> int:
    """Run the command; 1 if a level is failed."""
    options = _parser().parse_args(argv)
    if options.html is not None and Path(options.html).suffix.lower() not in PAGES:
        message = f"--html: {options.html}: expected a name ending in {' or '.join(PAGES)}"
        raise UsageError(message)
    if options.differences:
        return _differences(options)
    if options.html and options.model == NONLINEAR:
        message = "--html: its pictures are of a linear model; not with --model nonlinear"
        raise UsageError(message)
    vehicle = chosen_vehicle(options)
    model = options.model or DEFAULT_MODEL
    findings = assess(vehicle, model, options.speed, options.srt)
    if options.html:
        # Here and not above: what the page needs takes longer to load than most assessments to run.
        from yawdamp_ros.pictures.assessment_page import assessment_page  # noqa: PLC0415
        from yawdamp_ros.pictures.page import save_page  # noqa: PLC0415

        save_page(assessment_page(vehicle, model, findings), options.html)
    if options.format == "json":
        print(json.dumps([_record(finding) for finding in findings], indent=2))
    else:
        _print_text(f"{vehicle.name}, {model} model", findings)
        if options.definitions:
            _print_definitions(findings)
    return 1 if failed(findings) else 0


def _differences(options: argparse.Namespace) -> int:
    """Say by how much each measure differs between the models, at its own manoeuvre."""
    for name in ("html", "srt", "model"):
        if getattr(options, name) is not None:
            message = f"--{name}: not with --differences, which compares the models"
            raise UsageError(message)
    vehicle = chosen_vehicle(options)
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
    """Share by which the nonlinear value differs; None where there is none, or it is of nothing."""
    if linear.value is None or nonlinear.value is None or abs(linear.value) < ROUNDING_NOISE:
        return None
    return nonlinear.value / linear.value - 1.0


def _number(value: float | None) -> str:
    return "none" if value is None else number(value)


def _parser() -> argparse.ArgumentParser:
    parser = Parser(
        "assess",
        "Rearward amplification, yaw damping, offtracking, understeer and critical speed of a combination,\n"
        "with the levels of the Australian PBS scheme and of RTAC. Each measure is taken at the speed that\n"
        "its standard names, else at the vehicle's own; --speed is for all.\n"
        "Exit status: 0 if no level is failed, 1 if one is or may be, 2 for wrong use.",
        "yawdamp assess --vehicle a_double --srt 0.4",
    )
    add_vehicle_options(parser, MODELS)
    add_format_option(parser)
    parser.add_argument(
        "--differences",
        action="store_true",
        help="by how much each measure differs by the nonlinear model, at its own manoeuvre",
    )
    parser.add_argument(
        "--html",
        metavar="FILE",
        help="also write one page for a browser: table, curves, animated plan view, mode shapes, definitions",
    )
    parser.add_argument(
        "--definitions", action="store_true", help="also say what each measure is, and its levels in full"
    )
    parser.add_argument(
        "--srt",
        type=float,
        metavar="G",
        help="static rollover threshold of the rear roll-coupled unit in g, which a planar model cannot "
        "tell; without it the level that takes it is open",
    )
    return parser


def _record(finding: Finding) -> dict[str, object]:
    return {
        "measure": finding.measure.name,
        "value": finding.value,
        "unit": finding.measure.unit,
        "level": finding.level,
        "pass": finding.passed,
        "definition": _definition(finding),
    }


def _definition(finding: Finding) -> str:
    reason = f"; no value: {finding.reason}" if finding.reason else ""
    ambiguity = f"; ambiguous: {finding.ambiguity}" if finding.ambiguity else ""
    return f"{finding.measure.definition}; at {finding.speed:.6g} m/s{reason}{ambiguity}"


def _verdict(finding: Finding) -> str:
    return "ambiguous" if finding.ambiguity and finding.passed is None else VERDICTS[finding.passed]


def _print_text(title: str, findings: Sequence[Finding]) -> None:
    print_table(
        title,
        ("measure", "value", "unit", "at m/s", "verdict", "level"),
        [
            (
                finding.measure.name,
                "none" if finding.value is None else number(finding.value),
                finding.measure.unit,
                f"{finding.speed:.2f}",
                _verdict(finding),
                finding.level or "",
            )
            for finding in findings
        ],
        prose=(5, 0),
    )
    values = {finding.measure.name: finding.value for finding in findings}
    gradient = values["understeer_gradient"]
    if gradient is not None:
        shown = math.degrees(gradient) * STANDARD_GRAVITY if number(gradient) != "0" else 0.0
        print(f"understeer gradient: {number(shown)} deg/g")
    for reason in dict.fromkeys(finding.reason for finding in findings if finding.reason):
        print(f"no value: {reason}")
    for finding in findings:
        if finding.ambiguity:
            print(f"ambiguous: {finding.ambiguity}")
    if any(
        level.per_srt for finding in findings for level in finding.measure.levels if finding.passed is None
    ):
        print(
            "--srt G, the static rollover threshold, decides on the level of PBS for rearward amplification"
        )


def _print_definitions(findings: Sequence[Finding]) -> None:
    print("\nDefinitions; levels are from secondary sources")
    for finding in findings:
        level = f" ({finding.level})" if finding.level else ""
        print(f"  {finding.measure.name}: {finding.measure.definition}{level}")
