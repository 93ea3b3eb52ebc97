"""What earlier versions recorded; see test/data/README.md."""

import json
from pathlib import Path

import numpy as np
import pytest

from yawdamp_ros.cli import run
from yawdamp_ros.runs.response_recording import read_response_recording

RUNS = sorted((Path(__file__).parents[1] / "data" / "runs").iterdir())


def test_there_is_one_of_every_kind() -> None:
    assert [path.name for path in RUNS] == [
        "node_from_the_middle",
        "node_lane_change",
        "node_ratio_16",
        "node_speed_and_reset",
        "simulate_chirp",
    ]


@pytest.mark.parametrize("path", RUNS, ids=lambda path: path.name)
def test_it_is_run_again_to_the_last_sample_as_closely_as_its_build_allows(
    path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["resimulate", str(path), "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["difference"], found["warning"]) == (None, "")
    assert found["bit_identical"] or found["promise"] == "1e-9 of the motion"
    assert found["samples"] == len(read_response_recording(path).time)


@pytest.mark.parametrize("path", RUNS, ids=lambda path: path.name)
def test_its_steering_is_read_as_the_road_wheels_had_it(path: Path, tmp_path: Path) -> None:
    output = tmp_path / "again.csv"
    options = ["--log", str(path), "--topic", "/steering", "--output", str(output)]
    assert run(["simulate", *options]) == 0
    angles = np.loadtxt(output, delimiter=",", skiprows=1, usecols=1)
    assert angles.max() == pytest.approx(read_response_recording(path).steering_angle.max(), rel=0.01)
