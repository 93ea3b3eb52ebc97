"""Logs written by other programs, and logs that are none."""

import io
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mcap.writer import Writer as BareWriter
from mcap_ros2.writer import Writer
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as BagWriter
from rosbags.typesys import Stores, get_typestore

from yawdamp_ros.cli import run
from yawdamp_ros.logs import LogError, read_steering_mcap

SEPARATOR = "=" * 80
TIME = f"{SEPARATOR}\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n"
HEADER = f"{SEPARATOR}\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n{TIME}"
LATERAL = (
    "builtin_interfaces/Time stamp\nbuiltin_interfaces/Time control_time\nfloat32 steering_tire_angle\n"
    "float32 steering_tire_rotation_rate\nbool is_defined_steering_tire_rotation_rate\n"
)
DEFINITIONS = {
    "std_msgs/msg/Float64": "float64 data\n",
    "sensor_msgs/msg/JointState": "std_msgs/Header header\nstring[] name\nfloat64[] position\n"
    f"float64[] velocity\nfloat64[] effort\n{HEADER}",
    "ackermann_msgs/msg/AckermannDriveStamped": "std_msgs/Header header\n"
    f"ackermann_msgs/AckermannDrive drive\n{HEADER}{SEPARATOR}\nMSG: ackermann_msgs/AckermannDrive\n"
    "float32 steering_angle\nfloat32 steering_angle_velocity\nfloat32 speed\nfloat32 acceleration\n"
    "float32 jerk\n",
    "autoware_control_msgs/msg/Lateral": LATERAL + TIME,
    "autoware_control_msgs/msg/Control": "builtin_interfaces/Time stamp\n"
    f"builtin_interfaces/Time control_time\nautoware_control_msgs/Lateral lateral\n{TIME}"
    f"{SEPARATOR}\nMSG: autoware_control_msgs/Lateral\n{LATERAL}",
    "std_msgs/msg/String": "string data\n",
}
ANGLES = [0.0, 0.125, -0.25, 0.5]  # exact in single precision, too


def stamp(index: int) -> dict[str, int]:
    return {"sec": 100 + index // 2, "nanosec": index % 2 * 500_000_000}


def lateral(index: int, angle: float) -> dict[str, Any]:
    return {
        "stamp": stamp(index),
        "control_time": stamp(0),
        "steering_tire_angle": angle,
        "steering_tire_rotation_rate": 9.0,
        "is_defined_steering_tire_rotation_rate": True,
    }


MESSAGES: dict[str, Callable[[int, float], dict[str, Any]]] = {
    "std_msgs/msg/Float64": lambda _, angle: {"data": angle},
    "sensor_msgs/msg/JointState": lambda index, angle: {
        "header": {"stamp": stamp(index), "frame_id": ""},
        "name": ["wheel", "steering"],
        "position": [9.0, angle],
        "velocity": [0.0, 0.0],
        "effort": [0.0, 0.0],
    },
    "ackermann_msgs/msg/AckermannDriveStamped": lambda index, angle: {
        "header": {"stamp": stamp(index), "frame_id": ""},
        "drive": {
            "steering_angle": angle,
            "steering_angle_velocity": 9.0,
            "speed": 9.0,
            "acceleration": 0.0,
            "jerk": 0.0,
        },
    },
    "autoware_control_msgs/msg/Lateral": lateral,
    "autoware_control_msgs/msg/Control": lambda index, angle: {
        "stamp": stamp(index),
        "control_time": stamp(index),
        "lateral": lateral(index, angle),
    },
}


def record(path: Path, topics: dict[str, str], angles: Sequence[float] = ANGLES) -> Path:
    """A log as mcap-ros2-support writes it: every topic holds the same angles, half a second apart."""
    with path.open("wb") as file, Writer(file) as writer:
        for topic, kind in topics.items():
            schema = writer.register_msgdef(kind, DEFINITIONS[kind])
            for index, angle in enumerate(angles):
                time = 100_000_000_000 + index * 500_000_000
                message = MESSAGES[kind](index, angle) if kind in MESSAGES else {"data": "left"}
                writer.write_message(topic, schema, message, time, time)
    return path


@pytest.mark.parametrize("kind", MESSAGES)
def test_every_type_is_decoded_by_the_definition_in_the_file(tmp_path: Path, kind: str) -> None:
    log = read_steering_mcap(record(tmp_path / "log.mcap", {"/command": kind}))
    assert log.angles == ANGLES
    assert log.times == [0.0, 0.5, 1.0, 1.5]
    assert log.start_time == 100_000_000_000


def test_the_topic_named_so_is_taken_and_another_on_demand(tmp_path: Path) -> None:
    float64 = "std_msgs/msg/Float64"
    path = record(tmp_path / "log.mcap", {"/speed": float64, "/steering_cmd": float64, "/yaw": float64})
    assert read_steering_mcap(path).angles == ANGLES
    assert read_steering_mcap(path, "/yaw").angles == ANGLES


def test_a_joint_is_found_by_its_name(tmp_path: Path) -> None:
    path = record(tmp_path / "log.mcap", {"/joint_states": "sensor_msgs/msg/JointState"})
    assert read_steering_mcap(path, joint="wheel").angles == [9.0] * 4
    with pytest.raises(LogError, match="message 1: no joint 'front' with a position; name one with --joint"):
        read_steering_mcap(path, joint="front")


def test_degrees_are_degrees(tmp_path: Path) -> None:
    path = record(tmp_path / "log.mcap", {"/steering": "std_msgs/msg/Float64"})
    np.testing.assert_allclose(read_steering_mcap(path, degrees=True).angles, np.radians(ANGLES))


@pytest.mark.parametrize("with_metadata", [True, False])
def test_a_bag_of_several_files_as_rosbags_writes_them(tmp_path: Path, with_metadata: bool) -> None:  # noqa: FBT001
    typestore = get_typestore(Stores.ROS2_JAZZY)
    float64 = typestore.types["std_msgs/msg/Float64"]
    for part in range(2):
        with BagWriter(tmp_path / f"part{part}", version=9, storage_plugin=StoragePlugin.MCAP) as writer:
            connection = writer.add_connection("/steering", "std_msgs/msg/Float64", typestore=typestore)
            for index in range(2):
                data = typestore.serialize_cdr(float64(ANGLES[2 * part + index]), "std_msgs/msg/Float64")
                writer.write(connection, (2 * part + index) * 500_000_000, data)
    bag = tmp_path / "bag"
    bag.mkdir()
    for part in range(2):
        (tmp_path / f"part{part}" / f"part{part}.mcap").rename(bag / f"bag_{part}.mcap")
    if with_metadata:
        (bag / "metadata.yaml").write_text(
            "rosbag2_bagfile_information:\n  version: 9\n  storage_identifier: mcap\n"
            "  relative_file_paths: [bag_0.mcap, bag_1.mcap]\n"
        )
    log = read_steering_mcap(bag)
    assert log.angles == ANGLES
    assert log.times == [0.0, 0.5, 1.0, 1.5]


def test_a_file_that_was_cut_off_is_read_up_to_there_with_a_warning(tmp_path: Path) -> None:
    path = tmp_path / "log.mcap"
    with path.open("wb") as file, Writer(file, chunk_size=200) as writer:
        schema = writer.register_msgdef("std_msgs/msg/Float64", "float64 data\n")
        for index in range(1000):
            writer.write_message("/steering", schema, {"data": index / 1000}, index * 1_000_000)
    whole = path.read_bytes()
    path.write_bytes(whole[: len(whole) // 3])
    log = read_steering_mcap(path)
    assert 100 < len(log.angles) < 900
    assert log.angles == [index / 1000 for index in range(len(log.angles))]
    assert log.warning.startswith(f"{path}: unfinished or damaged")


def test_a_damaged_chunk_is_not_taken_for_data(tmp_path: Path) -> None:
    path = tmp_path / "log.mcap"
    with path.open("wb") as file:
        writer = Writer(file, chunk_size=2000)
        schema = writer.register_msgdef("std_msgs/msg/Float64", "float64 data\n")
        for index in range(1000):
            writer.write_message("/steering", schema, {"data": index / 1000}, index * 1_000_000)
        writer.finish()
    damaged = bytearray(path.read_bytes())
    for position in range(len(damaged) // 3, len(damaged) // 3 + 2500):
        damaged[position] ^= 0xFF
    path.write_bytes(damaged)
    log = read_steering_mcap(path)
    assert log.warning
    assert log.angles == [index / 1000 for index in range(len(log.angles))]


def bare(profile: str = "ros2", encoding: str = "ros2msg", data: bytes = b"\0\1\0\0" + bytes(8)) -> bytes:
    stream = io.BytesIO()
    writer = BareWriter(stream)
    writer.start(profile=profile)
    schema = writer.register_schema("std_msgs/msg/Float64", encoding, b"float64 data\n")
    channel = writer.register_channel("/steering", "cdr", schema)
    writer.add_message(channel, 0, data, 0)
    writer.finish()
    return stream.getvalue()


NAN = b"\0\1\0\0" + np.array([np.nan]).tobytes()


@pytest.mark.parametrize(
    "content, message",
    [
        (b"", "empty; expected an MCAP file"),
        (b"time,steering\n0,0\n", "not an MCAP file"),
        (b"\x89MCAP0\r\n", "no steering in it; its topics: none"),
        (bare(profile="ros1"), "profile 'ros1': expected an MCAP of profile 'ros2'"),
        (bare(encoding="ros2idl"), "ros2idl in cdr: expected ros2msg in cdr"),
        (bare(data=b"\0\1\0\0"), "/steering: message at 0 ns is no std_msgs/msg/Float64"),
        (bare(data=NAN), "/steering: message 1: nan: expected a finite angle"),
    ],
    ids=["empty", "text", "cut after its magic", "profile", "encoding", "too short", "nan"],
)
def test_a_bad_recording_is_one_line_and_status_2(
    tmp_path: Path, content: bytes, message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "log.mcap"
    path.write_bytes(content)
    assert run(["simulate", "--log", str(path), "--output", str(tmp_path / "out.csv")]) == 2
    errors = capsys.readouterr().err
    assert message in errors
    assert errors.count("\n") == 1


@pytest.mark.parametrize(
    "topics, options, message",
    [
        ({"/a": "std_msgs/msg/String"}, [], "no steering in it; its topics: /a"),
        (
            {"/a": "std_msgs/msg/Float64", "/b": "std_msgs/msg/Float64"},
            [],
            "several topics could be steering; name one with --topic: /a, /b",
        ),
        (
            {
                "/steer_l": "std_msgs/msg/Float64",
                "/steer_r": "std_msgs/msg/Float64",
                "/x": "std_msgs/msg/Float64",
            },
            [],
            "several topics could be steering; name one with --topic: /steer_l, /steer_r",
        ),
        ({"/a": "std_msgs/msg/Float64"}, ["--topic", "/b"], "/b: no such topic; expected one of /a"),
        (
            {"/a": "std_msgs/msg/String"},
            ["--topic", "/a"],
            "/a: std_msgs/msg/String: expected one of std_msgs/msg/Float64",
        ),
        ({"/a": "std_msgs/msg/Float64"}, ["--column", "x"], "is a recording and has none"),
    ],
)
def test_a_topic_that_cannot_be_chosen_lists_those_that_can(
    tmp_path: Path,
    topics: dict[str, str],
    options: list[str],
    message: str,
    capsys: pytest.CaptureFixture[str],
) -> None:
    path = record(tmp_path / "log.mcap", topics)
    assert run(["simulate", "--log", str(path), *options, "--output", str(tmp_path / "out.csv")]) == 2
    assert message in capsys.readouterr().err


def test_time_that_goes_back_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "log.mcap"
    kind = "autoware_control_msgs/msg/Lateral"
    with path.open("wb") as file, Writer(file) as writer:
        schema = writer.register_msgdef(kind, DEFINITIONS[kind])
        for log_time, index in enumerate((0, 3, 1)):
            writer.write_message("/steering", schema, lateral(index, 0.0), log_time)
    with pytest.raises(LogError, match="message 3: time goes back by 1 s"):
        read_steering_mcap(path)


@pytest.mark.parametrize(
    "files, message",
    [
        ({}, "neither metadata.yaml nor an .mcap in it"),
        ({"metadata.yaml": "a: [\n"}, "not the metadata of a rosbag2 recording"),
        ({"metadata.yaml": "a: 1\n"}, "not the metadata of a rosbag2 recording"),
        (
            {
                "metadata.yaml": "rosbag2_bagfile_information: "
                "{storage_identifier: sqlite3, relative_file_paths: [a.db3]}\n"
            },
            "storage 'sqlite3': expected uncompressed files of storage 'mcap'",
        ),
        (
            {
                "metadata.yaml": "rosbag2_bagfile_information: "
                "{storage_identifier: mcap, relative_file_paths: [../a.mcap]}\n"
            },
            "a.mcap: cannot be read: No such file",
        ),
        (
            {
                "metadata.yaml": "rosbag2_bagfile_information: {storage_identifier: mcap, "
                "compression_format: zstd, compression_mode: MESSAGE, relative_file_paths: [a.mcap]}\n"
            },
            "metadata.yaml: compression_mode MESSAGE: expected messages that are not compressed",
        ),
    ],
)
def test_a_directory_that_is_no_recording_is_refused(
    tmp_path: Path, files: dict[str, str], message: str
) -> None:
    for name, text in files.items():
        (tmp_path / name).write_text(text)
    with pytest.raises(LogError) as caught:
        read_steering_mcap(tmp_path)
    assert message in str(caught.value)


def test_a_file_that_is_listed_twice_plays_once(tmp_path: Path) -> None:
    with (tmp_path / "a.mcap").open("wb") as file, Writer(file) as writer:
        schema = writer.register_msgdef("std_msgs/msg/Float64", "float64 data\n")
        for index in range(3):
            writer.write_message("/steering", schema, {"data": 0.1 * index}, index, index)
    (tmp_path / "metadata.yaml").write_text(
        "rosbag2_bagfile_information: {storage_identifier: mcap, relative_file_paths: [a.mcap, ./a.mcap]}\n"
    )
    assert len(read_steering_mcap(tmp_path).angles) == 3
