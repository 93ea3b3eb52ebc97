import csv
from pathlib import Path

import numpy as np
import pytest
from rosbags.highlevel import AnyReader

from yawdamp_ros import load_vehicle, simulate
from yawdamp_ros.cli import run
from yawdamp_ros.manoeuvres import LaneChange

RAV4 = Path(__file__).parents[3] / "shared" / "data" / "rav4_highway_steering.csv"


def test_a_csv_has_the_promised_columns_and_full_precision(tmp_path: Path) -> None:
    path = tmp_path / "run.csv"
    assert run(["simulate", "--manoeuvre", "lane_change", "--duration", "5", "--output", str(path)]) == 0
    with path.open(newline="") as file:
        header, *rows = csv.reader(file)
    assert header == [
        "time",
        "steering_angle",
        *(
            f"{unit}/{quantity}"
            for unit in ("truck", "trailer_1", "trailer_2")
            for quantity in ("yaw", "yaw_rate", "lateral_acceleration")
        ),
        "articulation_1",
        "articulation_2",
        "speed",
        *(f"{unit}/{axis}" for unit in ("truck", "trailer_1", "trailer_2") for axis in ("x", "y")),
    ]
    table = np.array(rows, dtype=float)
    response = simulate(load_vehicle("interlink"), LaneChange(), 5.0)
    np.testing.assert_array_equal(table[:, 0], response.time)
    np.testing.assert_array_equal(table[:, 1], response.steering_angle)
    np.testing.assert_array_equal(table[:, 2:11:3], response.yaw)
    np.testing.assert_array_equal(table[:, 3:11:3], response.yaw_rate)
    np.testing.assert_array_equal(table[:, 4:11:3], response.lateral_acceleration)
    np.testing.assert_array_equal(table[:, 11:13], response.articulation)
    assert set(table[:, 13]) == {load_vehicle("interlink").speed}
    np.testing.assert_array_equal(table[:, 14::2], response.x)
    np.testing.assert_array_equal(table[:, 15::2], response.y)


def test_a_run_directory_holds_what_the_csv_holds(tmp_path: Path) -> None:
    common = ["simulate", "--manoeuvre", "step", "--duration", "2", "--vehicle", "truck_trailer"]
    assert run([*common, "--output", str(tmp_path / "run")]) == 0
    assert run([*common, "--sample-period", "0.01", "--output", str(tmp_path / "run.csv")]) == 0
    with (tmp_path / "run.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    with AnyReader([tmp_path / "run"]) as reader:
        recorded: dict[str, list[float]] = {}
        for connection, time, data in reader.messages():
            message = reader.deserialize(data, connection.msgtype)
            if connection.topic in {"/truck/yaw_rate", "/trailer/lateral_acceleration"}:
                recorded.setdefault(connection.topic[1:], []).append(message.data)
            if connection.topic == "/joint_states":
                assert time == message.header.stamp.sec * 10**9 + message.header.stamp.nanosec
                recorded.setdefault("articulation_1", []).append(message.position[1])
    assert len(recorded) == 3
    for column, values in recorded.items():
        assert values == [float(row[column]) for row in rows]


def test_the_steering_in_a_run_is_logged_at_the_step_where_it_took_effect(tmp_path: Path) -> None:
    assert (
        run(["simulate", "--manoeuvre", "pulse", "--duration", "3", "--output", str(tmp_path / "run")]) == 0
    )
    with AnyReader([tmp_path / "run"]) as reader:
        steering = [
            (time, reader.deserialize(data, connection.msgtype).data)
            for connection, time, data in reader.messages()
            if connection.topic == "/steering_applied"
        ]
    assert steering == [(0, 0.0), (1_000_000_000, 0.1), (1_500_000_000, 0.0)]


def test_a_log_lasts_as_long_as_its_samples_and_is_scaled(tmp_path: Path) -> None:
    log, output = tmp_path / "log.csv", tmp_path / "run.csv"
    log.write_text("time,steering_wheel_deg\n3,0\n3.5,90\n4,45\n")
    options = ["--log", str(log), "--steering-ratio", "15", "--sample-period", "0.5", "--output", str(output)]
    assert run(["simulate", *options]) == 0
    with output.open(newline="") as file:
        angles = [float(row["steering_angle"]) for row in csv.DictReader(file)]
    np.testing.assert_allclose(angles, np.radians([0.0, 6.0, 3.0]))


@pytest.mark.skipif(not RAV4.exists(), reason="the recorded drive is not part of the project")
def test_a_minute_of_real_driving_is_followed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    output = tmp_path / "run.csv"
    options = ["--log", str(RAV4), "--steering-ratio", "16.88", "--sample-period", "0.01"]
    assert run(["simulate", *options, "--output", str(output)]) == 0
    with output.open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 5999
    accelerations = [abs(float(row["truck/lateral_acceleration"])) for row in rows]
    assert 0.1 < max(accelerations) < 1.0  # a car's calm motorway minute
    assert "trailer_2" in capsys.readouterr().out


def test_overrides_and_speed_reach_the_model(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    output = tmp_path / "run.csv"
    options = ["--speed", "10", "--set", "units.1.mass=4156", "--duration", "1", "--output", str(output)]
    assert run(["simulate", "--manoeuvre", "step", "--start", "0", *options]) == 0
    assert "at 10 m/s" in capsys.readouterr().out
    with output.open(newline="") as file:
        last = list(csv.DictReader(file))[-1]
    light = load_vehicle("interlink", ["units.1.mass=4156"])
    expected = simulate(light, lambda _: 0.1, 1.0, speed=10.0)
    assert float(last["truck/yaw_rate"]) == expected.yaw_rate[-1, 0]


@pytest.mark.parametrize(
    "arguments, message",
    [
        ([], "no steering; expected --manoeuvre NAME or --log FILE"),
        (["--manoeuvre", "slalom"], "argument --manoeuvre: invalid choice: 'slalom'"),
        (["--manoeuvre", "step", "--frequency", "1"], "frequency: manoeuvre step does not use it"),
        (["--manoeuvre", "step", "--duration", "nan"], "--duration: nan: expected a time in s"),
        (["--manoeuvre", "step", "--duration", "-1"], "--duration: -1.0: expected a time in s"),
        (["--manoeuvre", "step", "--step-size", "0.003", "--sample-period", "0.01"], "step_size: 0.003 s"),
        (["--manoeuvre", "step", "--vehicle", "lorry"], "lorry: no such vehicle"),
        (["--manoeuvre", "step", "--set", "units.1.mass=0"], "units.1.mass: 0: expected a mass in kg"),
        (["--manoeuvre", "step", "--speed", "80"], "speed: 80.0: expected a speed in m/s"),
        (["--manoeuvre", "step", "--step-size", "nan"], "step_size: nan: expected a time in s above 0"),
        (["--manoeuvre", "step", "--sample-period", "0"], "sample_period: 0.0: expected a time in s above 0"),
        (["--manoeuvre", "step", "--vehicle", ""], "no such vehicle"),
        (["--manoeuvre", "step", "--column", "x"], "--column: there is no --log that it could be of"),
        (["--manoeuvre", "step", "--degrees"], "--degrees: there is no --log that it could be of"),
        (
            ["--manoeuvre", "step", "--speed", "1e-300"],
            "speed: 1e-300: expected a speed in m/s, from 0.01 to 70",
        ),
        (["--log", "a.csv", "--output", "./a.csv"], "--output: ./a.csv: that is the log"),
        (["--manoeuvre", "step", "--unknown"], "unrecognized arguments: --unknown"),
        (["--log", "none.csv"], "none.csv: cannot be read: No such file"),
        (["--log", "none.csv", "--amplitude", "0.1"], "--amplitude: expected either a manoeuvre or --log"),
        (
            ["--log", "none.csv", "--steering-ratio", "0"],
            "--steering-ratio: 0.0: expected a number from 0.001",
        ),
    ],
)
def test_wrong_use_is_one_line_and_status_2(
    arguments: list[str],
    message: str,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run(["simulate", *arguments]) == 2
    captured = capsys.readouterr()
    assert captured.err.startswith(f"yawdamp simulate: {message}") or message in captured.err
    assert captured.err.count("\n") == 1
    assert captured.out == ""
    assert list(tmp_path.iterdir()) == []


def test_a_run_directory_is_never_overwritten(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["simulate", "--manoeuvre", "step", "--output", str(tmp_path)]) == 2
    assert "cannot be recorded to: File exists" in capsys.readouterr().err


def test_an_acceleration_in_a_log_is_followed_as_the_speed_that_it_makes(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    written = []
    for name, values, options in (
        ("acceleration", (0.5, -1.0, 0.0), ["--speed", "15"]),
        ("speed", (15.0, 16.0, 14.0), []),
    ):
        log, output = tmp_path / f"{name}.csv", tmp_path / f"{name}_run.csv"
        rows = [f"{2 * index},0.01,{value}" for index, value in enumerate(values)]
        log.write_text("\n".join([f"time,steering_angle,{name}", *rows]) + "\n")
        assert run(["simulate", "--log", str(log), *options, "--output", str(output)]) == 0
        written.append(np.genfromtxt(output, delimiter=",", skip_header=1))
    captured = capsys.readouterr()
    assert "following the log's acceleration, from 15 m/s on\n" in captured.out
    assert captured.err == ""
    np.testing.assert_allclose(written[0], written[1], rtol=1e-9, atol=1e-12)
