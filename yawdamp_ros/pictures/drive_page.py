"""Simulated over measured signals, and the results of a fit, as one HTML page."""

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from yawdamp_ros.drives import ChannelComparison
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.pictures.assessment_data import side_view, vehicle_tables
from yawdamp_ros.pictures.page import page_text
from yawdamp_ros.vehicle import Vehicle

MOST_POINTS = 4000
"""Limit on the points of a curve; a longer one is thinned out evenly."""
FIGURES = 5
"""Significant figures of a point."""
HIGHEST_FREQUENCY = 5.0
"""Highest frequency of a drawn coherence [Hz]."""

DEFINITIONS: Mapping[str, str] = MappingProxyType(
    {
        "bias": "Mean of measured less simulated.",
        "gain": "Slope of measured over simulated, both less their means, with the lag taken out.",
        "lag": "Time by which the measured signal follows the simulated one, where they correlate best.",
        "RMS error": "Root mean square of measured less simulated, bias included.",
        "R2": "Share of the measured variance that the simulation explains as it is.",
        "R2 max": "What a perfect model would reach: the variance that changes from sample to sample, as no "
        "vehicle does, is taken for noise (by third differences).",
        "coherence": "Share of the measured power at a frequency that is linear in the simulated signal, "
        "by Welch's method.",
    }
)
"""Words of the tables."""


class PageTable(NamedTuple):
    """A table of texts.

    Attributes
    ----------
    title : str
    columns : sequence of str
    rows : sequence of sequence of str
    """

    title: str
    columns: Sequence[str]
    rows: Sequence[Sequence[str]]


class DriveReport(NamedTuple):
    """Contents of the page of a comparison or an identification.

    Attributes
    ----------
    title, subtitle : str
    verdict : str
    passed : bool or None
        Whether the verdict is good; None if there is nothing to pass.
    vehicle : Vehicle
        Vehicle that is drawn, with its data.
    tables : sequence of PageTable
    notes : sequence of str
    taken : sequence of str
        Sources of the drive's channels.
    comparisons : sequence of (str, sequence of ChannelComparison)
        Parts of the drive, each with its name; the curves of a part are overlaid.
    """

    title: str
    subtitle: str
    verdict: str
    passed: bool | None
    vehicle: Vehicle
    tables: Sequence[PageTable]
    notes: Sequence[str]
    taken: Sequence[str]
    comparisons: Sequence[tuple[str, Sequence[ChannelComparison]]]


def drive_page(report: DriveReport) -> str:
    """HTML text of a comparison or an identification.

    Parameters
    ----------
    report : DriveReport

    Returns
    -------
    str
    """
    vehicle = report.vehicle
    data = {
        "title": report.title,
        "subtitle": report.subtitle,
        "verdict": report.verdict,
        "passed": report.passed,
        "tables": [_shown(table) for table in report.tables],
        "notes": list(report.notes),
        "vehicle": {"name": vehicle.name, **side_view(vehicle), "tables": vehicle_tables(vehicle)},
        "sections": [
            {"title": name, "charts": [chart for each in found for chart in _charts(each)]}
            for name, found in report.comparisons
            if found
        ],
        "taken": list(report.taken),
        "definitions": list(DEFINITIONS.items()),
    }
    return page_text("drive.html", report.title, data)


def _shown(table: PageTable) -> dict[str, object]:
    return {**table._asdict(), "rows": [[_squared(cell) for cell in row] for row in table.rows]}


def _squared(text: str) -> str:
    return text.replace("^2", "²")


def _charts(found: ChannelComparison) -> list[dict[str, object]]:
    every = -(-len(found.times) // MOST_POINTS)
    times = _rounded(found.times[::every])
    unit = _squared(found.unit)
    thinned = f" One sample in {every} is drawn." if every > 1 else ""
    charts: list[dict[str, object]] = [
        {
            "wide": True,
            "title": found.output.replace("_", " "),
            "x_label": "time, s",
            "y_label": unit,
            "series": [
                {"name": name, "xs": times, "ys": _rounded(values[::every]), "colour": colour}
                for colour, (name, values) in enumerate(
                    (("measured", found.measured), ("simulated", found.simulated))
                )
            ],
            "caption": f"R2 {found.r_squared:.3f}, at most {found.attainable:.3f} with its noise of "
            f"{found.noise:.3g} {unit}.{thinned}",
        },
        {
            "title": f"{found.output.replace('_', ' ')}: measured less simulated",
            "x_label": "time, s",
            "y_label": unit,
            "series": [
                {
                    "name": "error",
                    "xs": times,
                    "ys": _rounded((found.measured - found.simulated)[::every]),
                    "colour": 6,
                }
            ],
            "caption": f"RMS {found.rms_error:.3g} {unit}, mean {found.bias:.3g} {unit}",
        },
    ]
    shown = (found.frequencies <= HIGHEST_FREQUENCY) & np.isfinite(found.coherence)
    if shown.any():
        charts.append(
            {
                "title": f"{found.output.replace('_', ' ')}: coherence",
                "x_label": "frequency, Hz",
                "y_label": "share of the measured power",
                "series": [
                    {
                        "name": "coherence",
                        "xs": _rounded(found.frequencies[shown]),
                        "ys": _rounded(found.coherence[shown]),
                        "colour": 2,
                    }
                ],
                "caption": "",
            }
        )
    return charts


def _rounded(values: FloatArray) -> list[object]:
    rounded: list[object] = [float(f"{value:.{FIGURES}g}") for value in np.asarray(values)]
    return rounded
