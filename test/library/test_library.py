"""What a notebook gets: units, tables, pictures, and drives that are followed."""

from pathlib import Path

import numpy as np
import pytest

from yawdamp_ros import load_drive, load_run, load_vehicle, simulate
from yawdamp_ros.cli import run
from yawdamp_ros.drives import DriveError
from yawdamp_ros.library import Curves
from yawdamp_ros.manoeuvres import LaneChange


@pytest.fixture(scope="module")
def curves() -> Curves:
    return simulate("interlink", LaneChange(amplitude=0.02), 5.0, sample_period=0.01)


def drive_file(tmp_path: Path) -> Path:
    path = tmp_path / "drive.csv"
    rows = [f"{row / 10},{0.02 * np.sin(0.2 * row)},{10.0 + 0.05 * row}" for row in range(60)]
    path.write_text("\n".join(["time,steering,speed", *rows]), encoding="utf-8")
    return path


def test_a_unit_is_found_by_its_name(curves: Curves) -> None:
    last = curves["trailer_2"]
    np.testing.assert_array_equal(last.yaw_rate, curves.yaw_rate[:, 2])
    np.testing.assert_array_equal(last.x, curves.x[:, 2])
    with pytest.raises(KeyError, match="'dolly': no such unit; expected one of truck, trailer_1, trailer_2"):
        curves["dolly"]


def test_a_table_has_every_curve_and_the_units_of_measure(curves: Curves) -> None:
    table = curves.to_dataframe()
    assert table.index.name == "time"
    assert list(table.columns[:4]) == [
        "steering_angle",
        "truck/yaw",
        "truck/yaw_rate",
        "truck/lateral_acceleration",
    ]
    assert table.attrs["units"]["trailer_2/lateral_acceleration"] == "m/s^2"
    assert table.attrs["units"]["truck/x"] == "m"
    assert table.attrs["units"].keys() == {"time", *table.columns}
    np.testing.assert_array_equal(table["articulation_2"], curves.articulation[:, 1])


def test_a_picture_is_drawn_and_written(curves: Curves, tmp_path: Path) -> None:
    figure = curves.plot(tmp_path / "run.svg")
    assert len(figure.axes) >= 6
    assert (tmp_path / "run.svg").stat().st_size > 10_000


@pytest.mark.parametrize("name", ["run.csv", "run"])
def test_a_run_is_read_as_it_was_written(tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    assert run(["simulate", "--manoeuvre", "lane_change", "--duration", "2", "--output", str(path)]) == 0
    found = load_run(path)
    period = 0.001 if name == "run.csv" else 0.01
    expected = simulate("interlink", LaneChange(), 2.0, sample_period=period)
    np.testing.assert_array_equal(found.yaw_rate, expected.yaw_rate)
    np.testing.assert_array_equal(found.x, expected.x)
    np.testing.assert_array_equal(found["trailer_1"].y, expected["trailer_1"].y)


def test_a_drive_is_followed_as_simulate_follows_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, output = drive_file(tmp_path), tmp_path / "run.csv"
    assert run(["simulate", "--log", str(path), "--output", str(output)]) == 0
    assert "following the log: 60 speeds of 10.00 to 12.95 m/s" in capsys.readouterr().out
    followed = simulate("interlink", load_drive(path))
    np.testing.assert_array_equal(load_run(output).lateral_acceleration, followed.lateral_acceleration)
    rows = np.genfromtxt(output, delimiter=",", names=True, deletechars="")
    np.testing.assert_allclose(rows["speed"][:5901:100], 10.0 + 0.05 * np.arange(60), rtol=1e-12)


def test_a_speed_that_is_asked_for_counts(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path, output = drive_file(tmp_path), tmp_path / "run.csv"
    assert run(["simulate", "--log", str(path), "--speed", "20", "--output", str(output)]) == 0
    assert "--speed counts; the log's own is not followed" in capsys.readouterr().out
    assert set(np.genfromtxt(output, delimiter=",", names=True, deletechars="")["speed"]) == {20.0}
    asked = simulate("interlink", load_drive(path), speed=20.0)
    np.testing.assert_array_equal(load_run(output).yaw_rate, asked.yaw_rate)


def test_an_acceleration_makes_a_speed(tmp_path: Path) -> None:
    path = tmp_path / "drive.csv"
    rows = [f"{row / 100},0,1" for row in range(201)]
    path.write_text("\n".join(["time,steering,acceleration", *rows]), encoding="utf-8")
    straight = simulate(load_vehicle("interlink"), load_drive(path))
    gained = np.hypot(np.diff(straight.x[:, 0]), np.diff(straight.y[:, 0])) / 0.001
    assert gained[-1] - gained[0] == pytest.approx(2.0, abs=0.02)


def test_only_a_drive_has_a_duration_of_its_own() -> None:
    with pytest.raises(DriveError, match="duration: expected a time in s"):
        simulate("interlink", LaneChange())


def test_a_table_has_what_the_nonlinear_model_adds() -> None:
    run = simulate("truck_trailer", LaneChange(amplitude=0.02), 1.0, sample_period=0.1, model="nonlinear")
    table = run.columns()
    np.testing.assert_array_equal(table["trailer/roll"], run.extra["roll"][:, 1])
    assert run.column_units()["trailer/load_transfer_ratio"] == "1"
