"""Runs as the Python readers see them: rosbags, mcap with mcap-ros2-support, and ROS itself."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rclpy.serialization import deserialize_message
from rosbags.highlevel import AnyReader

from runs import OUTPUTS
from yawdamp_ros.cli import run

FIELDS = {
    "imu": (
        "header.stamp.sec",
        "header.frame_id",
        "orientation.z",
        "angular_velocity.z",
        "linear_acceleration",
    ),
    "odom": ("header.stamp.nanosec", "child_frame_id", "pose.pose.position.x", "twist.twist.linear.y"),
    "joint_states": ("header.stamp.nanosec", "name", "position", "velocity", "effort"),
}


@pytest.fixture(scope="module")
def recorded_run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("conformance") / "run"
    assert run(["simulate", "--manoeuvre", "chirp", "--duration", "3", "--output", str(path)]) == 0
    return path


def values(topic: str, message: Any) -> list[Any]:  # noqa: ANN401 - a message of any library
    """Fields of a message as plain values, alike for every library."""
    found = []
    for path in FIELDS.get(topic.rpartition("/")[2], ("data",)):
        value = message
        for name in path.split("."):
            value = getattr(value, name)
        if hasattr(value, "y"):
            value = [value.x, value.y, value.z]
        found.append(
            list(value) if isinstance(value, list | tuple | np.ndarray) or hasattr(value, "tolist") else value
        )
    return found


def by_ros(path: Path) -> list[tuple[str, int, list[Any]]]:
    with path.open("rb") as file:
        return [
            (
                channel.topic,
                message.log_time,
                values(channel.topic, deserialize_message(message.data, OUTPUTS[channel.topic])),
            )
            for _, channel, message in make_reader(file).iter_messages()
            if channel.topic in OUTPUTS
        ]


def by_mcap_ros2_support(path: Path) -> list[tuple[str, int, list[Any]]]:
    with path.open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()], validate_crcs=True)
        return [
            (channel.topic, message.log_time, values(channel.topic, decoded))
            for _, channel, message, decoded in reader.iter_decoded_messages()
            if channel.topic in OUTPUTS
        ]


def by_rosbags(path: Path) -> list[tuple[str, int, list[Any]]]:
    with AnyReader([path]) as reader:
        return [
            (connection.topic, time, values(connection.topic, reader.deserialize(data, connection.msgtype)))
            for connection, time, data in reader.messages()
            if connection.topic in OUTPUTS
        ]


def test_all_readers_see_the_same_values(recorded_run: Path) -> None:
    file = recorded_run / "run_0.mcap"
    expected = by_ros(file)
    assert len(expected) == 301 * len(OUTPUTS)

    def ordered(messages: list[tuple[str, int, list[Any]]]) -> list[tuple[str, int, list[Any]]]:
        return sorted(messages, key=lambda message: message[:2])

    for read in (by_mcap_ros2_support(file), by_rosbags(file), by_rosbags(recorded_run)):
        assert ordered(read) == ordered(expected)
