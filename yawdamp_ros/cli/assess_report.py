"""Report of `assess`: as text, as JSON, as CSV."""

import csv
import json
import math
import sys
import textwrap
from collections.abc import Sequence

from yawdamp_ros.analysis import Assessment, Finding, VehicleMeasure
from yawdamp_ros.analysis.engineering import SI, converted
from yawdamp_ros.analysis.schemes import DEFAULT_SCHEME, SIGNS
from yawdamp_ros.cli.number import number
from yawdamp_ros.cli.table import print_table
from yawdamp_ros.vehicle import STANDARD_GRAVITY, assumed

VERDICTS = {True: "pass", False: "FAIL", None: "n/a"}
WIDTH = 80
"""Columns of a table of one scheme."""


def record(assessed: Assessment) -> dict[str, object]:
    """Return an assessment by a chosen scheme as a JSON object."""
    names = assessed.scheme.levels
    return {
        "vehicle": assessed.vehicle.name,
        "model": assessed.model,
        "scheme": assessed.scheme.name,
        "level": assessed.level,
        "verdict": assessed.outcome.verdict.value,
        "level_reached": assessed.outcome.reached,
        "deciding": assessed.outcome.deciding,
        "unknown": assessed.outcome.unknown,
        "assumed": [each.key for each in assumed(assessed.vehicle)],
        "measures": [
            finding_record(finding)
            | {
                "limit": _limit(finding),
                "level_reached": None if finding.reached is None else names[finding.reached] or None,
                "reason": finding.reason or None,
                "assumes": getattr(finding.measure, "assumes", "") or None,
            }
            for finding in assessed.findings
        ],
    }


def finding_record(finding: Finding) -> dict[str, object]:
    """Return one measure as a JSON object, in SI units."""
    return {
        "measure": finding.measure.name,
        "value": finding.value,
        "unit": finding.measure.unit,
        "level": finding.level,
        "pass": finding.passed,
        "definition": _definition(finding),
    }


def print_json(assessments: Sequence[Assessment]) -> None:
    """Print one object, or a list of several; of the default scheme the measures alone."""
    if assessments[0].scheme.name == DEFAULT_SCHEME:
        records: list[object] = [[finding_record(each) for each in one.findings] for one in assessments]
    else:
        records = [record(one) for one in assessments]
    print(json.dumps(records[0] if len(records) == 1 else records, indent=2))


def table(assessments: Sequence[Assessment], units: str = SI) -> list[list[object]]:
    """Rows of a spreadsheet, the first of headings: a row for each measure of each vehicle."""
    rows: list[list[object]] = [
        [
            "vehicle",
            "scheme",
            "measure",
            "value",
            "unit",
            "limit",
            "verdict",
            "level_reached",
            "speed",
            "reason",
        ]
    ]
    for one in assessments:
        for finding in one.findings:
            value, unit = converted(finding.value, finding.measure.unit, units)
            limit, _ = converted(_limit(finding), finding.measure.unit, units)
            reached = "" if finding.reached is None else one.scheme.levels[finding.reached]
            cells = [value, unit, limit, verdict(finding), reached, converted(finding.speed, "m/s", units)[0]]
            rows.append([one.vehicle.name, one.scheme.name, finding.measure.name, *cells, finding.reason])
    return rows


def print_csv(assessments: Sequence[Assessment], units: str) -> None:
    """Print the rows of `table`."""
    csv.writer(sys.stdout, lineterminator="\n").writerows(table(assessments, units))


def print_text(assessed: Assessment, units: str) -> None:
    """Print the verdict first, then the measures."""
    title = f"{assessed.vehicle.name}, {assessed.model} model"
    if assessed.scheme.name == DEFAULT_SCHEME:
        _print_plain(title, assessed.findings, units)
    else:
        print(title)
        print(textwrap.fill(assessed.sentence, WIDTH))
        _print_scheme(assessed, units)
        _print_assumed(assessed)
    _print_notes(assessed.findings)


def print_side_by_side(assessments: Sequence[Assessment], units: str) -> None:
    """Print several vehicles beside each other, values that fail marked with an exclamation mark."""
    rows = []
    for findings in zip(*(one.findings for one in assessments), strict=True):
        unit = converted(None, findings[0].measure.unit, units)[1]
        cells = [_value(finding, units) + ("!" if finding.passed is False else "") for finding in findings]
        rows.append((findings[0].measure.name, *cells, unit))
    whole = [f"{one.outcome.verdict.value}, {one.outcome.reached or '-'}" for one in assessments]
    rows.append(("verdict, level reached", *whole, ""))
    scheme = assessments[0].scheme
    print_table(
        scheme.title, ("measure", *(one.vehicle.name for one in assessments), "unit"), rows, width=WIDTH
    )
    print("! fails")


def print_definitions(assessed: Assessment) -> None:
    """Print the definition of each measure and the sources of its limits."""
    secondary = assessed.scheme.name == DEFAULT_SCHEME
    print(f"\nDefinitions{'; levels are from secondary sources' if secondary else ''}")
    for finding in assessed.findings:
        level = f" ({finding.level})" if finding.level else ""
        print(f"  {finding.measure.name}: {finding.measure.definition}{level}")
    if not secondary:
        print("\nSources of the limits")
        for source in assessed.scheme.sources:
            print(f"  {source}")


def verdict(finding: Finding) -> str:
    """Return the verdict of one measure in a word."""
    return "ambiguous" if finding.ambiguity and finding.passed is None else VERDICTS[finding.passed]


def _print_plain(title: str, findings: Sequence[Finding], units: str) -> None:
    at = converted(None, "m/s", units)[1]
    print_table(
        title,
        ("measure", "value", "unit", f"at {at}", "verdict", "level"),
        [
            (
                finding.measure.name,
                _value(finding, units),
                converted(None, finding.measure.unit, units)[1],
                f"{converted(finding.speed, 'm/s', units)[0]:.2f}",
                verdict(finding),
                finding.level or "",
            )
            for finding in findings
        ],
        prose=(5, 0),
    )
    values = {finding.measure.name: finding.value for finding in findings}
    gradient = values["understeer_gradient"]
    if gradient is not None and units == SI:
        shown = math.degrees(gradient) * STANDARD_GRAVITY if number(gradient) != "0" else 0.0
        print(f"understeer gradient: {number(shown)} deg/g")


def _print_scheme(assessed: Assessment, units: str) -> None:
    levels = assessed.scheme.levels
    columns = ["measure", "value", "unit", "limit", "verdict", *(["level"] if levels[0] else [])]
    rows = []
    for finding in assessed.findings:
        limits = [
            f"{SIGNS[each.kind]} {number(shown)}" if shown is not None else f"{SIGNS[each.kind]} ?"
            for each, limit in zip(finding.requirements, finding.limits, strict=True)
            for shown in [converted(limit, finding.measure.unit, units)[0]]
        ]
        reached = "" if finding.reached is None else levels[finding.reached]
        row = [finding.measure.name, _value(finding, units), converted(None, finding.measure.unit, units)[1]]
        rows.append([*row, "; ".join(limits), verdict(finding) if limits else "", reached][: len(columns)])
    print_table(assessed.scheme.title, columns, rows, width=WIDTH)


def _print_assumed(assessed: Assessment) -> None:
    """Name the values that the file does not give, where a measure may use them."""
    names = dict.fromkeys(each.key.rpartition(".")[2] for each in assumed(assessed.vehicle))
    if names and any(isinstance(finding.measure, VehicleMeasure) for finding in assessed.findings):
        said = f"assumed, not given by the file (yawdamp show lists them): {', '.join(names)}"
        print(textwrap.fill(said, WIDTH))


def _print_notes(findings: Sequence[Finding]) -> None:
    for reason in dict.fromkeys(finding.reason for finding in findings if finding.reason):
        print(f"no value: {reason}")
    for finding in findings:
        if finding.ambiguity:
            print(f"ambiguous: {finding.ambiguity}")
        if finding.value is not None and (assumes := getattr(finding.measure, "assumes", "")):
            print(textwrap.fill(f"{finding.measure.name} assumes: {assumes}", WIDTH))
    if any(limit is None for finding in findings if finding.value is not None for limit in finding.limits):
        print(
            "--srt G, the static rollover threshold, decides on the level of PBS for rearward amplification"
        )


def _value(finding: Finding, units: str) -> str:
    value, _ = converted(finding.value, finding.measure.unit, units)
    return "none" if value is None else number(value)


def _limit(finding: Finding) -> float | None:
    """The first limit of the level in question."""
    return next((limit for limit in finding.limits if limit is not None), None)


def _definition(finding: Finding) -> str:
    reason = f"; no value: {finding.reason}" if finding.reason else ""
    ambiguity = f"; ambiguous: {finding.ambiguity}" if finding.ambiguity else ""
    return f"{finding.measure.definition}; at {finding.speed:.6g} m/s{reason}{ambiguity}"
