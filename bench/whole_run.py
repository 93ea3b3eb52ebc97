"""An hour of steering as a run on disk, and what serialising and writing its messages takes at least."""

import math
import subprocess
import sys
import time
from pathlib import Path

from mcap.writer import CompressionType, Writer
from rclpy.serialization import deserialize_message, serialize_message
from rosbags.highlevel import AnyReader

from yawdamp_ros.runs.encoder import message_class


def steering_log(path: Path, seconds: int) -> None:
    """Write a log of 100 Hz."""
    rows = (f"{index / 100},{0.03 * math.sin(index / 70):.9f}" for index in range(100 * seconds + 1))
    path.write_text("time,steering_angle\n" + "\n".join(rows))


def simulated(log: Path, run: Path) -> float:
    """Time in s that `simulate` takes from its start to its end."""
    command = [sys.executable, "-m", "yawdamp_ros", "simulate", "--log", str(log), "--output", str(run)]
    begin = time.perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)  # noqa: S603 - this package's own command
    return time.perf_counter() - begin


def written_anew(run: Path, copy: Path) -> float:
    """Time in s that serialising the messages of a run and writing them takes, and nothing else."""
    with AnyReader([run]) as reader:
        connections = {connection.topic: connection for connection in reader.connections}
        first: dict[str, list[object]] = {}
        for connection, _, data in reader.messages():
            kept = first.setdefault(connection.topic, [])
            if len(kept) < 100:  # noqa: PLR2004 - as many different messages of each topic as stay in a cache
                kept.append(_message(data, connection.msgtype))
        counts = {topic: connection.msgcount for topic, connection in connections.items()}
        definitions = {topic: str(connection.msgdef.data) for topic, connection in connections.items()}
    topics = [topic for topic in counts if counts[topic] > 1]
    instants = min(counts[topic] for topic in topics)
    begin = time.perf_counter()
    with copy.open("wb") as file:
        writer = Writer(file, compression=CompressionType.ZSTD, enable_data_crcs=True)
        writer.start(profile="ros2")
        channels = {}
        for topic in topics:
            schema = writer.register_schema(
                connections[topic].msgtype, "ros2msg", definitions[topic].encode()
            )
            channels[topic] = writer.register_channel(topic, "cdr", schema)
        for index in range(instants):
            stamp = index * 10_000_000
            for topic in topics:
                message = first[topic][index % 100]
                data = message if isinstance(message, bytes) else serialize_message(message)
                writer.add_message(channels[topic], stamp, data, stamp, index)
        writer.finish()
    return time.perf_counter() - begin


def _message(data: bytes, type_name: str) -> object:
    """Message of a type, or its bytes where the package of the type, as tf2_msgs, is not installed."""
    try:
        return deserialize_message(data, message_class(type_name))
    except ModuleNotFoundError:
        return bytes(data)
