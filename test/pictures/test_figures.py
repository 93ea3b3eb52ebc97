"""Figures hold what they were given, and files do not change when nothing has."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from yawdamp_ros.analysis import eigenvalue_locus
from yawdamp_ros.dynamics import linear_model
from yawdamp_ros.manoeuvres import LaneChange
from yawdamp_ros.pictures import PictureError, save
from yawdamp_ros.pictures.eigenvalues import locus_figure
from yawdamp_ros.pictures.run_panels import bands, run_panels
from yawdamp_ros.pictures.runs import runs_figure
from yawdamp_ros.simulation import simulate
from yawdamp_ros.vehicle import load_vehicle

INTERLINK = load_vehicle("interlink")
RESPONSE = simulate(INTERLINK, LaneChange(), 3.0, sample_period=0.05)


def labels(figure: object) -> list[str]:
    return [axes.get_ylabel() for axes in figure.axes]


def test_a_run_is_drawn_with_its_paths_where_they_are_known() -> None:
    figure = runs_figure([("run", RESPONSE)])
    assert labels(figure) == [
        "steer angle, rad",
        "yaw, rad",
        "yaw rate, rad/s",
        "lateral acceleration, m/s²",
        "articulation, rad",
        "y (left), m",
    ]
    for index, line in enumerate(figure.axes[1].lines):
        np.testing.assert_array_equal(line.get_ydata(), RESPONSE.yaw[:, index])
    unknown = np.full_like(RESPONSE.x, np.nan)
    without = dataclasses.replace(RESPONSE, x=unknown, y=unknown)
    assert "y (left), m" not in labels(runs_figure([("run", without)]))


def test_a_curve_with_a_gap_is_drawn() -> None:
    gap = RESPONSE.yaw_rate.copy()
    gap[7, 1] = np.nan
    figure = runs_figure([("run", dataclasses.replace(RESPONSE, yaw_rate=gap))])
    assert [len(axes.lines) for axes in figure.axes] == [1, 3, 3, 3, 2, 3]


def test_one_unit_has_no_articulation_panel() -> None:
    response = simulate(load_vehicle("single_vehicle"), LaneChange(), 1.0, sample_period=0.05)
    assert "articulation, rad" not in labels(runs_figure([("car", response)]))


def test_locus_marks_its_boundary() -> None:
    locus = eigenvalue_locus(lambda u: linear_model(INTERLINK, u, "published"), [5.0, 10.0, 20.0])
    figure = locus_figure(locus, "speed")
    (legend,) = figure.legends
    assert "boundary at 12.2302" in [text.get_text() for text in legend.get_texts()]


@pytest.mark.parametrize("suffix", ["png", "svg"])
def test_the_same_figure_gives_the_same_bytes(suffix: str, tmp_path: Path) -> None:
    paths = [tmp_path / f"{name}.{suffix}" for name in "ab"]
    for path in paths:
        save(runs_figure([("run", RESPONSE)]), path)
    assert paths[0].read_bytes() == paths[1].read_bytes()


def test_a_directory_that_is_not_there_is_said(tmp_path: Path) -> None:
    with pytest.raises(PictureError, match=r"no/picture\.png: cannot be written"):
        save(runs_figure([("run", RESPONSE)]), tmp_path / "no" / "picture.png")


def test_what_lies_beyond_the_linear_range_is_shaded() -> None:
    def shaded(amplitude: float) -> list[tuple[float, float]]:
        response = simulate(
            load_vehicle("interlink"), LaneChange(amplitude=amplitude), 8.0, sample_period=0.01
        )
        return [band for panel in run_panels([("run", response)]) for band in bands(panel)]

    assert shaded(0.018) == []
    high, low = shaded(0.1)
    assert (high[0], low[1]) == (4.0, -4.0)
    assert high[1] == pytest.approx(6.4, abs=0.2)
