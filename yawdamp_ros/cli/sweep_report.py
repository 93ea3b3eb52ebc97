"""Reports of `sweep`, as text and as JSON."""

import json
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from yawdamp_ros.analysis import Boundary, Variation
from yawdamp_ros.analysis.measures import ALL_MEASURES
from yawdamp_ros.analysis.points import Points
from yawdamp_ros.analysis.study import Study
from yawdamp_ros.cli.boundary_text import boundary_record, boundary_text
from yawdamp_ros.cli.number import number
from yawdamp_ros.cli.table import print_table
from yawdamp_ros.dynamics.kinematics import FloatArray

MOST_ROWS, MOST_COLUMNS = 60, 12
"""Largest size of a table that is printed whole."""

QUANTILES = (0.0, 0.05, 0.5, 0.95, 1.0)


@dataclass(frozen=True)
class Sweep:
    """A sweep that is done.

    Attributes
    ----------
    study : Study
    axes : tuple of Variation
        None for vehicles drawn at random.
    points : Points
    answers : ndarray, shape (k, a)
    columns : tuple of str
        Names of the columns: those of points, then those of answers.
    """

    study: Study
    axes: tuple[Variation, ...]
    points: Points
    answers: FloatArray
    columns: tuple[str, ...]

    @property
    def unstable(self) -> float:
        """Share of the points that are unstable."""
        return float((self.answers[:, 0] > 0.0).mean())

    @property
    def unit(self) -> str:
        """Unit of the last column."""
        name = self.columns[-1]
        return ALL_MEASURES[name].unit if name in ALL_MEASURES else "1/s"


def print_json(sweep: Sweep, boundaries: Sequence[Boundary], segments: FloatArray) -> None:
    """Print a sweep as one JSON object; null marks a missing value."""
    rows = np.hstack([sweep.points[:], sweep.answers]).tolist()
    report = {
        "vehicle": sweep.study.source,
        "model": sweep.study.model,
        "columns": sweep.columns,
        "rows": [[None if math.isnan(value) else value for value in row] for row in rows],
        "fraction_unstable": sweep.unstable,
        "stability_boundaries": [boundary_record(boundary) for boundary in boundaries],
        "stability_boundary_segments": segments.tolist(),
    }
    print(json.dumps(report, indent=2))


def print_text(sweep: Sweep, boundaries: Sequence[Boundary], segments: FloatArray) -> None:
    """Print a sweep as a table, or as a summary."""
    count = len(sweep.points)
    print(f"{sweep.study.source}, {sweep.study.model} model, {count} points")
    if len(sweep.axes) == 1:
        _print_curve(sweep)
    elif sweep.axes:
        _print_map(sweep)
    _print_distribution(sweep)
    for boundary in boundaries:
        print(boundary_text(boundary, ""))
    if len(segments):
        lows, highs = segments.min(axis=(0, 1)), segments.max(axis=(0, 1))
        spans = ", ".join(
            f"{axis.label} {low:.6g} to {high:.6g}"
            for axis, low, high in zip(sweep.axes, lows, highs, strict=True)
        )
        print(f"boundary of stability: {spans}")


def _print_curve(sweep: Sweep) -> None:
    if len(sweep.points) > MOST_ROWS:
        print(f"(more than {MOST_ROWS} rows: --output FILE.csv holds them)")
        return
    print_table(
        "",
        (sweep.axes[0].label, *sweep.study.columns),
        [
            tuple(number(value, ".6g") for value in (*point, *row))
            for point, row in zip(sweep.points[:], sweep.answers, strict=True)
        ],
    )


def _print_map(sweep: Sweep) -> None:
    first, second = (axis.values for axis in sweep.axes)
    if len(first) > MOST_ROWS or len(second) > MOST_COLUMNS:
        print(f"(more than {MOST_ROWS} by {MOST_COLUMNS} values: --output FILE.csv holds them)")
        return
    table = sweep.answers[:, -1].reshape(len(first), len(second))
    print_table(
        f"{sweep.columns[-1]}; rows {sweep.axes[0].label}, columns {sweep.axes[1].label}",
        ("", *(f"{value:.6g}" for value in second)),
        [(f"{value:.6g}", *(number(each) for each in row)) for value, row in zip(first, table, strict=True)],
    )


def _print_distribution(sweep: Sweep) -> None:
    values = sweep.answers[:, -1]
    known = values[~np.isnan(values)]
    print(f"unstable: {100.0 * sweep.unstable:.4g} %")
    if len(known) < len(values):
        print(f"without a value: {100.0 * (1.0 - len(known) / len(values)):.4g} %")
    if len(known):
        unit = f" {sweep.unit}" if sweep.unit else ""
        shown = ", ".join(
            f"{name} {number(value)}"
            for name, value in zip(
                ("least", "5 %", "median", "95 %", "most"), np.quantile(known, QUANTILES), strict=True
            )
        )
        print(f"{sweep.columns[-1]}{unit and ','}{unit}: {shown}")
