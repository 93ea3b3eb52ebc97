"""`simulate` tells of a run that leaves the linear range."""

import json
from pathlib import Path

import pytest

from yawdamp_ros.cli import run


def told(capsys: pytest.CaptureFixture[str], path: Path, amplitude: str, *options: str) -> str:
    arguments = ["--manoeuvre", "lane_change", "--amplitude", amplitude, "--sample-period", "0.01"]
    assert run(["simulate", *arguments, "--output", str(path / "run.csv"), *options]) == 0
    return capsys.readouterr().out


def test_a_hard_lane_change_has_a_note_under_its_peaks(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert "note: lateral acceleration of truck 4.0" in told(capsys, tmp_path, "0.1")
    assert "note:" not in told(capsys, tmp_path, "0.018")


def test_json_holds_the_peaks_and_where_the_linear_range_was_left(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    hard = json.loads(told(capsys, tmp_path, "0.1", "--format", "json"))
    assert hard["peaks"]["truck"]["lateral_acceleration"] == pytest.approx(6.312, abs=1e-3)
    assert hard["beyond_linear_range"]["quantity"] == "lateral_acceleration"
    assert hard["beyond_linear_range"]["where"] == "truck"
    assert 1.0 < hard["beyond_linear_range"]["time"] < 2.0
    gentle = json.loads(told(capsys, tmp_path, "0.018", "--format", "json"))
    assert gentle["beyond_linear_range"] is None
    assert gentle["output"].endswith("run.csv")


def test_a_speed_of_0_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    output = str(tmp_path / "run.csv")
    assert run(["simulate", "--manoeuvre", "sine", "--speed", "0", "--output", output]) == 2
    assert "speed: 0.0: expected a speed in m/s" in capsys.readouterr().err
