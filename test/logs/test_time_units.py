from pathlib import Path

import pytest

from yawdamp_ros.cli import run
from yawdamp_ros.logs import read_steering_csv


def log(tmp_path: Path, column: str, start: float, interval: float, samples: int = 300) -> Path:
    path = tmp_path / "log.csv"
    rows = "".join(f"{start + index * interval:.0f},0.01,20\n" for index in range(samples))
    path.write_text(f"{column},steering_angle,speed_mps\n{rows}", encoding="utf-8")
    return path


@pytest.mark.parametrize("start", [0, 1.7e9])
@pytest.mark.parametrize("unit, per_second", [("ms", 1e3), ("us", 1e6), ("ns", 1e9)])
@pytest.mark.parametrize("column", ["time", "timestamp"])
def test_times_of_another_unit_are_told_by_their_size(
    column: str, unit: str, per_second: float, start: float, tmp_path: Path
) -> None:
    read = read_steering_csv(log(tmp_path, column, start * per_second, 0.01 * per_second))
    assert read.duration == pytest.approx(2.99, rel=1e-3)
    assert read.warning == f"{tmp_path / 'log.csv'}: {column} is taken to be in {unit}"


def test_a_column_names_its_unit(tmp_path: Path) -> None:
    assert read_steering_csv(log(tmp_path, "time_ms", 0, 1)).duration == pytest.approx(0.299)
    assert read_steering_csv(log(tmp_path, "time_s", 0, 10)).duration == pytest.approx(2990)


def test_seconds_stay_seconds(tmp_path: Path) -> None:
    read = read_steering_csv(log(tmp_path, "time", 1.7e9, 1))
    assert (read.duration, read.warning) == (299.0, "")


def test_what_is_past_the_duration_is_not_read(tmp_path: Path) -> None:
    path = log(tmp_path, "time", 0, 1, samples=2000)
    with path.open("a", encoding="utf-8") as file:
        file.write("none of a log\n")
    read = read_steering_csv(path, until=1500.0)
    assert read.times[-1] == 1500.0
    with pytest.raises(ValueError, match="line 2002: time"):
        read_steering_csv(path)


def test_a_log_of_more_than_a_day_asks_for_its_duration(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = log(tmp_path, "time_s", 0, 1000)
    assert run(["simulate", "--log", str(path), "--output", str(tmp_path / "run.csv")]) == 2
    assert "lasts 299000 s, more than a day: say --duration" in capsys.readouterr().err


def test_what_is_followed_and_what_is_not_are_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "drive.csv"
    path.write_text(
        "time,steering,speed_mps,friction,yaw_rate\n0,0,20,0.3,0\n1,0,20,0.3,0\n", encoding="utf-8"
    )
    assert run(["simulate", "--log", str(path), "--output", str(tmp_path / "run.csv")]) == 0
    told = capsys.readouterr()
    assert "following the log: 2 speeds of 20.00 to 20.00 m/s" in told.out
    assert told.err.splitlines() == [
        f"note: {path}: not followed: yaw_rate (column yaw_rate)",
        f"note: {path}: not followed: friction",  # by a linear model
    ]
