"""The command `plot`."""

from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest

from yawdamp_ros.cli import run
from yawdamp_ros.manoeuvres import LaneChange
from yawdamp_ros.simulation import simulate
from yawdamp_ros.vehicle import load_vehicle


@pytest.fixture
def run_csv(tmp_path: Path) -> Path:
    response = simulate(load_vehicle("interlink"), LaneChange(), 3.0, sample_period=0.05)
    columns = {"time": response.time, "steering_angle": response.steering_angle}
    for index, unit in enumerate(response.unit_names):
        for quantity in ("yaw", "yaw_rate", "lateral_acceleration"):
            columns[f"{unit}/{quantity}"] = getattr(response, quantity)[:, index]
    for joint, angles in enumerate(response.articulation.T, 1):
        columns[f"articulation_{joint}"] = angles
    path = tmp_path / "run.csv"
    rows = np.column_stack(list(columns.values()))
    np.savetxt(path, rows, fmt="%.17g", delimiter=",", header=",".join(columns), comments="")
    return path


@pytest.mark.parametrize(
    "suffix, start", [("png", b"\x89PNG"), ("svg", b"<?xml"), ("html", b"<!DOCTYPE html>")]
)
def test_picture_is_what_its_name_says(suffix: str, start: bytes, run_csv: Path) -> None:
    picture = run_csv.with_suffix(f".{suffix}")
    assert run(["plot", str(run_csv), "--output", str(picture)]) == 0
    assert picture.read_bytes().startswith(start)


def test_runs_compared_are_named_in_the_legend(
    run_csv: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    # Letters as letters, so that the picture's words can be read.
    monkeypatch.setitem(mpl.rcParams, "svg.fonttype", "none")
    other = tmp_path / "other.csv"
    other.write_bytes(run_csv.read_bytes())
    picture = tmp_path / "both.svg"
    assert run(["plot", str(run_csv), str(other), "--output", str(picture)]) == 0
    assert capsys.readouterr().out == f"{picture}\n"
    text = picture.read_text(encoding="utf-8")
    for word in (">run<", ">other<", ">truck<", ">trailer_2<", "yaw rate, rad/s", ">articulation 2<"):
        assert word in text


@pytest.mark.parametrize(
    "arguments, said",
    [
        (["missing.csv"], "missing.csv: cannot be read"),
        ([], "no run; expected RUN, or --models with a manoeuvre"),
    ],
)
def test_wrong_use_is_one_line_and_status_2(
    arguments: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["plot", *arguments]) == 2
    captured = capsys.readouterr()
    assert captured.err.count("\n") == 1
    assert said in captured.err


def test_a_picture_of_another_kind_is_refused(run_csv: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["plot", str(run_csv), "--output", "x.pdf"]) == 2
    assert "--output: x.pdf: expected a name ending in .png, .svg, .html" in capsys.readouterr().err


def test_more_runs_than_can_be_told_apart_are_refused(
    run_csv: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["plot", *[str(run_csv)] * 7]) == 2
    assert "7 runs in one picture; expected at most 6" in capsys.readouterr().err
