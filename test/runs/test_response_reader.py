"""Runs read back from CSV files."""

from pathlib import Path

import numpy as np
import pytest

from yawdamp_ros.cli import run
from yawdamp_ros.logs.errors import LogError
from yawdamp_ros.manoeuvres import LaneChange
from yawdamp_ros.runs.response_reader import read_response_csv
from yawdamp_ros.simulation import simulate
from yawdamp_ros.vehicle import load_vehicle

HEADER = (
    "time,steering_angle,a/yaw,a/yaw_rate,a/lateral_acceleration,b/yaw,b/yaw_rate,b/lateral_acceleration,"
    "articulation_1"
)


def write(path: Path, *lines: str) -> Path:
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def test_columns_are_read_to_their_units(tmp_path: Path) -> None:
    path = write(tmp_path / "run.csv", HEADER, "0,0.1,1,2,3,4,5,6,-3", "0.5,0.2,7,8,9,10,11,12,-3")
    response = read_response_csv(path)
    assert response.unit_names == ("a", "b")
    np.testing.assert_array_equal(response.time, [0.0, 0.5])
    np.testing.assert_array_equal(response.steering_angle, [0.1, 0.2])
    np.testing.assert_array_equal(response.yaw, [[1, 4], [7, 10]])
    np.testing.assert_array_equal(response.yaw_rate, [[2, 5], [8, 11]])
    np.testing.assert_array_equal(response.lateral_acceleration, [[3, 6], [9, 12]])
    np.testing.assert_array_equal(response.articulation, [[-3], [-3]])
    assert np.isnan(response.x).all()


def test_what_simulate_writes_is_read_back_bit_for_bit(tmp_path: Path) -> None:
    path = tmp_path / "run.csv"
    arguments = ["--vehicle", "interlink", "--manoeuvre", "lane_change", "--duration", "2"]
    assert run(["simulate", *arguments, "--sample-period", "0.01", "--output", str(path)]) == 0
    written = simulate(load_vehicle("interlink"), LaneChange(), 2.0, sample_period=0.01)
    found = read_response_csv(path)
    for field in ("time", "steering_angle", "yaw", "yaw_rate", "lateral_acceleration", "articulation"):
        np.testing.assert_array_equal(getattr(found, field), getattr(written, field))


def test_one_unit_has_no_articulation(tmp_path: Path) -> None:
    header = "time,steering_angle,car/yaw,car/yaw_rate,car/lateral_acceleration"
    assert read_response_csv(write(tmp_path / "run.csv", header, "0,0,0,0,0")).articulation.shape == (1, 0)


@pytest.mark.parametrize(
    "lines, said",
    [
        ([""], "no column <unit>/yaw; expected a run"),
        ([HEADER.replace("b/yaw_rate", "b/roll"), "0"], "no column b/yaw_rate; it has time"),
        ([HEADER], "no rows below the column names"),
        ([HEADER, "0,0,1,2,3,4,5,6"], "line 2: 8 values; expected 9"),
        ([HEADER, "0,0,1,2,3,4,5,6,7", "1,0,1,x,3,4,5,6,7"], "line 3: a/yaw_rate: 'x': expected a number"),
        ([HEADER, "0,0,1,nan,3,4,5,6,7"], "line 2: a/yaw_rate: nan: expected a finite number"),
    ],
)
def test_a_file_that_is_no_run_is_refused(lines: list[str], said: str, tmp_path: Path) -> None:
    path = write(tmp_path / "run.csv", *lines)
    with pytest.raises(LogError) as caught:
        read_response_csv(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert said in str(caught.value)


def test_what_is_no_file_or_no_text_is_refused(tmp_path: Path) -> None:
    with pytest.raises(LogError, match="cannot be read"):
        read_response_csv(tmp_path / "missing.csv")
    binary = tmp_path / "binary.csv"
    binary.write_bytes(b"\xff\xfe\xff")
    with pytest.raises(LogError, match="not UTF-8 text"):
        read_response_csv(binary)
