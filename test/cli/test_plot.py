"""The command `plot`."""

from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest

from yawdamp_ros.cli import run
from yawdamp_ros.manoeuvres import LaneChange
from yawdamp_ros.simulation import simulate
from yawdamp_ros.vehicle import complete, load_vehicle


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


def test_what_a_recorded_run_sweeps_is_drawn_with_its_own_vehicle(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    recorded = tmp_path / "turn"
    drive = ["--model", "nonlinear", "--speed", "3", "--manoeuvre", "step", "--amplitude", "0.25"]
    assert (
        run(["simulate", "--vehicle", "a_double", *drive, "--duration", "6", "--output", str(recorded)]) == 0
    )
    picture = tmp_path / "swept.png"
    assert run(["plot", str(recorded), "--swept", "--output", str(picture)]) == 0
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert run(["plot", str(recorded), "--swept", "--vehicle", "interlink", "--output", str(picture)]) == 2
    assert "interlink has others" in capsys.readouterr().err


def test_a_swept_surface_reaches_to_the_corners_of_the_bodies() -> None:
    from yawdamp_ros.pictures.swept import swept_figure  # noqa: PLC0415 - as the command does

    vehicle = load_vehicle("tractor_semitrailer")
    response = simulate(vehicle, lambda _: 0.0, 2.0, sample_period=0.02, speed=10.0)
    (axes,) = swept_figure("straight", response, vehicle).axes
    corners = np.concatenate([path.vertices for each in axes.collections for path in each.get_paths()])
    widest = max(unit.width for unit in complete(vehicle).units)
    assert np.abs(corners[:, 1]).max() == pytest.approx(0.5 * widest)


@pytest.mark.parametrize(
    "arguments, said",
    [
        (["--swept"], "--swept: expected one RUN"),
        (["{run}", "--swept"], "a CSV file does not hold its vehicle"),
        (["{run}", "--swept", "--vehicle", "interlink"], "it holds no paths"),
    ],
)
def test_what_cannot_be_swept_is_one_line(
    arguments: list[str], said: str, run_csv: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["plot", *(each.format(run=run_csv) for each in arguments)]) == 2
    assert said in capsys.readouterr().err
