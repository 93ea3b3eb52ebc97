"""`compare` on one bag that holds a run of the simulator and what was measured beside it."""

import json
import math
from pathlib import Path

import pytest
from mcap.reader import make_reader
from mcap.writer import Writer
from rclpy.serialization import deserialize_message, serialize_message
from sensor_msgs.msg import Imu

from yawdamp_ros.cli import run

LATE_NS, BIAS = 50_000_000, 0.01


def with_sensor(recording: Path, bag: Path) -> None:
    """Copy a recording, the truck's motion in it once more as /imu/data: later, and with a bias."""
    with recording.open("rb") as read, bag.open("wb") as written:
        writer = Writer(written)
        writer.start(profile="ros2")
        channels: dict[int, int] = {}
        sensor = None
        for schema, channel, message in make_reader(read).iter_messages():
            assert schema is not None
            if channel.id not in channels:
                kind = writer.register_schema(schema.name, schema.encoding, schema.data)
                channels[channel.id] = writer.register_channel(channel.topic, "cdr", kind)
                if channel.topic == "/truck/imu":
                    sensor = writer.register_channel("/imu/data", "cdr", kind)
            times = message.log_time, message.publish_time
            writer.add_message(channels[channel.id], times[0], message.data, times[1])
            if channel.topic == "/truck/imu":
                imu = deserialize_message(message.data, Imu)
                imu.angular_velocity.z += BIAS
                stamp = imu.header.stamp.sec * 10**9 + imu.header.stamp.nanosec + LATE_NS
                imu.header.stamp.sec, imu.header.stamp.nanosec = divmod(stamp, 10**9)
                assert sensor is not None
                late = [time + LATE_NS for time in times]
                writer.add_message(sensor, late[0], serialize_message(imu), late[1])
        writer.finish()


def test_measured_topics_are_laid_over_the_simulated_ones_of_the_same_bag(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    directory, bag = tmp_path / "run", str(tmp_path / "bag.mcap")
    vehicle = ["--vehicle", "truck_trailer"]
    manoeuvre = ["--manoeuvre", "lane_change", "--amplitude", "0.02", "--duration", "20"]
    assert run(["simulate", *vehicle, *manoeuvre, "--output", str(directory)]) == 0
    with_sensor(next(directory.glob("*.mcap")), Path(bag))
    capsys.readouterr()
    measured = ["--channel", "truck/yaw_rate=/imu/data"]
    assert run(["compare", bag, "--run", bag, *vehicle, *measured, "--format", "json"]) == 0
    record = json.loads(capsys.readouterr().out)
    found = {each["output"]: each for each in record["channels"]}["truck/yaw_rate"]
    assert any("/imu/data" in line for line in record["taken"])
    assert found["bias"] == pytest.approx(BIAS, rel=0.02)
    assert found["lag"] == pytest.approx(LATE_NS / 1e9, abs=0.005)
    assert math.isclose(found["gain"], 1.0, abs_tol=0.01)
