import json
import math
import os
import platform
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from mcap.reader import make_reader
from mcap.writer import Writer
from rclpy.serialization import deserialize_message, serialize_message
from sensor_msgs.msg import Imu
from std_msgs.msg import Float64
from std_srvs.srv import SetBool, Trigger

from graph import Graph, stop, until
from runs import run_directory
from yawdamp_ros.cli import run
from yawdamp_ros.plain_yaml import parse_yaml
from yawdamp_ros.vehicle import vehicle_text


@pytest.fixture
def busy_cores() -> Iterator[None]:
    """Both cores kept busy by processes of their own, for a bounded time."""
    work = "import time\nend = time.monotonic() + 60\nwhile time.monotonic() < end: pass"
    load = [subprocess.Popen([sys.executable, "-c", work]) for _ in range(os.cpu_count() or 1)]
    yield
    for process in load:
        process.kill()
        process.wait()


def verdict(path: Path, capsys: pytest.CaptureFixture[str]) -> tuple[int, dict[str, object]]:
    capsys.readouterr()
    status = run(["resimulate", str(path), "--format", "json"])
    return status, json.loads(capsys.readouterr().out)


@pytest.mark.graph
@pytest.mark.usefixtures("busy_cores")
def test_a_run_under_load_with_everything_that_can_happen_is_bit_identical(
    graph: Graph, capsys: pytest.CaptureFixture[str]
) -> None:
    graph.listen({"/truck/imu": Imu})
    parameters = ["-p", "on_steering_timeout:=zero", "-p", "steering_timeout:=0.1"]
    process = graph.command("sim", "--set", "units.2.mass=25000", "--ros-args", *parameters)
    publisher = graph.steering_publisher()
    for index in range(150):
        publisher.publish(Float64(data=0.05 * math.sin(0.05 * index)))
        time.sleep(0.25 if index % 50 == 49 else 0.01)
        if index == 40:
            graph.set_parameter("/yawdamp_sim", "speed", 17.3)
        if index == 80:
            graph.call("/yawdamp_sim/pause", SetBool, SetBool.Request(data=True))
            for _ in range(3):
                graph.call("/yawdamp_sim/step", Trigger, Trigger.Request())
            graph.call("/yawdamp_sim/pause", SetBool, SetBool.Request(data=False))
        if index == 100:
            graph.call("/yawdamp_sim/reset", Trigger, Trigger.Request())
        if index == 120:
            graph.set_parameter("/yawdamp_sim", "speed", 29.0)
    status, _, errors = stop(process)
    assert status == 0, errors
    status, found = verdict(run_directory(graph.directory), capsys)
    assert (status, found["bit_identical"], found["difference"]) == (0, True, None)
    assert found["promise"] == "bit-identical"
    assert int(str(found["samples"])) > 150


@pytest.mark.graph
def test_a_run_that_was_killed_loses_at_most_a_second_and_is_bit_identical(
    graph: Graph, capsys: pytest.CaptureFixture[str]
) -> None:
    graph.listen({"/truck/imu": Imu})
    process = graph.command("sim", "--manoeuvre", "chirp")
    until(lambda: len(graph.received["/truck/imu"]) > 200, "two seconds of samples")
    process.kill()
    process.communicate()
    published = len(graph.received["/truck/imu"])
    status, found = verdict(run_directory(graph.directory), capsys)
    assert (status, found["bit_identical"]) == (0, True)
    assert "unfinished" in str(found["warning"])
    assert int(str(found["samples"])) >= published - 100


@pytest.fixture
def offline(tmp_path: Path) -> Path:
    path = tmp_path / "run"
    options = ["--vehicle", "truck_trailer", "--speed", "25", "--duration", "2", "--output", str(path)]
    assert run(["simulate", "--manoeuvre", "lane_change", "--start", "0", *options]) == 0
    return path


def test_an_offline_run_is_bit_identical(offline: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, found = verdict(offline, capsys)
    assert (status, found["bit_identical"], found["samples"]) == (0, True, 201)
    assert run(["resimulate", str(offline)]) == 0
    assert "every value is bit-identical" in capsys.readouterr().out


def changed(topic: str, log_time: int, data: bytes, change: str) -> bytes | None:
    """What becomes of a message; None if it is left out."""
    if change == "gap" and 1_000_000_000 < log_time <= 1_500_000_000:
        return None
    if topic == "/trailer/imu" and log_time == 1_230_000_000:
        if change == "missing":
            return None
        if change == "last bit":
            imu = deserialize_message(data, Imu)
            imu.angular_velocity.z = math.nextafter(imu.angular_velocity.z, 1.0)
            return bytes(serialize_message(imu))
    return data


def rewritten(run_path: Path, change: str) -> Path:
    """A copy of a run in which one thing is not as it was recorded."""
    source, target = next(run_path.glob("*.mcap")), run_path.parent / "changed.mcap"
    with source.open("rb") as file, target.open("wb") as output:
        reader = make_reader(file)
        writer = Writer(output)
        writer.start(profile="ros2")
        for attachment in reader.iter_attachments():
            writer.add_attachment(0, 0, attachment.name, attachment.media_type, attachment.data)
        for record in reader.iter_metadata():
            if change == "build":
                record.metadata["build"] = "another machine"
            if change != "unexplained":
                writer.add_metadata(record.name, record.metadata)
        channels = {}
        for schema, channel, message in reader.iter_messages(log_time_order=False):
            assert schema is not None
            if channel.id not in channels:
                schema_id = writer.register_schema(schema.name, schema.encoding, schema.data)
                channels[channel.id] = writer.register_channel(channel.topic, "cdr", schema_id)
            data = changed(channel.topic, message.log_time, message.data, change)
            if data is None:
                continue
            writer.add_message(channels[channel.id], message.log_time, data, message.publish_time)
        writer.finish()
    return target


def test_a_change_of_one_last_bit_is_found(offline: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = rewritten(offline, "last bit")
    status, found = verdict(path, capsys)
    assert (status, found["bit_identical"]) == (1, False)
    difference = found["difference"]
    assert isinstance(difference, dict)
    assert (difference["where"], difference["time"], difference["field"]) == (
        "/trailer/imu",
        1.23,
        "angular_velocity.z",
    )
    assert math.nextafter(float(difference["repeated"]), 1.0) == float(difference["recorded"])
    assert run(["resimulate", str(path)]) == 1
    assert "DIFFERENT first at 1.23 s, /trailer/imu angular_velocity.z: recorded" in capsys.readouterr().out


def test_a_message_that_is_missing_is_found(offline: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, found = verdict(rewritten(offline, "missing"), capsys)
    assert status == 1
    assert found["difference"] == {
        "where": "/trailer/imu",
        "field": "",
        "time": 1.23,
        "recorded": "no message",
        "repeated": "a message",
    }


def test_samples_that_are_missing_are_found(offline: Path, capsys: pytest.CaptureFixture[str]) -> None:
    status, found = verdict(rewritten(offline, "gap"), capsys)
    assert (status, found["bit_identical"]) == (1, False)
    difference = found["difference"]
    assert isinstance(difference, dict)
    assert (difference["where"], difference["time"]) == ("every output", 1.01)


def test_a_run_of_another_build_need_only_agree_closely(
    offline: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    status, found = verdict(rewritten(offline, "build"), capsys)
    assert (status, found["bit_identical"], found["promise"]) == (0, True, "1e-9 of the motion")
    assert str(found["reason"]).startswith("it was recorded with another machine; this is ")
    assert run(["resimulate", str(offline.parent / "changed.mcap")]) == 0
    assert (
        "promised is 1e-9 of the motion, for it was recorded with another machine" in capsys.readouterr().out
    )


@pytest.mark.skipif(platform.machine() != "x86_64", reason="these kernels are of x86-64")
def test_a_run_that_other_kernels_computed_is_not_promised_bits_and_agrees(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    train = parse_yaml(vehicle_text("a_double"), 10_000)
    dolly, semitrailer = train["units"][2:]
    for index in range(3):
        train["units"][-1]["rear_hitch"] = -6.0656
        train["units"] += [{**dolly, "name": f"dolly_{index}"}, {**semitrailer, "name": f"trailer_{index}"}]
    vehicle = tmp_path / "train.yaml"
    vehicle.write_text(json.dumps({**train, "speed": 15.0}))
    program = [sys.executable, "-m", "yawdamp_ros", "simulate", "--vehicle", str(vehicle)]
    recorded = tmp_path / "recorded"
    subprocess.run(
        [*program, "--manoeuvre", "lane_change", "--duration", "4", "--output", str(recorded)],
        env={**os.environ, "OPENBLAS_CORETYPE": "Prescott"},
        check=True,
        capture_output=True,
    )
    status, found = verdict(recorded, capsys)
    assert (status, found["bit_identical"], found["difference"]) == (0, False, None)
    assert found["promise"] == "1e-9 of the motion"
    assert "kernels, numerics" in str(found["reason"])


def test_what_is_no_run_is_refused(offline: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for path in (rewritten(offline, "unexplained"), tmp_path / "none", tmp_path):
        assert run(["resimulate", str(path)]) == 2
        errors = capsys.readouterr().err
        assert str(path) in errors
        assert errors.count("\n") == 1
