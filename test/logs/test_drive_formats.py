"""Drives from every format: which channel is found where, in which unit."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mcap_ros2.writer import Writer
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as BagWriter
from rosbags.typesys import Stores, get_typestore
from scipy.io import savemat

from yawdamp_ros.drives import Drive
from yawdamp_ros.logs import LogError
from yawdamp_ros.logs.drive_formats import load_drive

TYPES = get_typestore(Stores.ROS2_JAZZY)
TIME = "builtin_interfaces/Time stamp\n"
STAMP = f"{'=' * 80}\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n"
HEADER = f"{'=' * 80}\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n{STAMP}"


def written(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "drive.csv"
    path.write_text(text, encoding="utf-8")
    return path


def values(drive: Drive) -> dict[str, list[float]]:
    return {name: channel.values.tolist() for name, channel in drive.channels.items()}


def message(kind: str, index: int, value: float) -> Any:  # noqa: ANN401 - generated types
    types = TYPES.types
    if kind == "std_msgs/msg/Float64":
        return types[kind](value)
    stamp = types["builtin_interfaces/msg/Time"](sec=1000, nanosec=index * 100_000_000)
    header = types["std_msgs/msg/Header"](stamp=stamp, frame_id="")
    vector = types["geometry_msgs/msg/Vector3"]
    if kind == "sensor_msgs/msg/JointState":
        return types[kind](
            header, ["steering", "articulation_1"], np.array([value, -value]), np.zeros(2), np.zeros(2)
        )
    if kind == "geometry_msgs/msg/TwistStamped":
        return types[kind](
            header, types["geometry_msgs/msg/Twist"](vector(20.0, 0.0, 0.0), vector(0.0, 0.0, value))
        )
    assert kind == "sensor_msgs/msg/Imu"
    quaternion = types["geometry_msgs/msg/Quaternion"](0.0, 0.0, 0.0, 1.0)
    return types[kind](
        header,
        quaternion,
        np.zeros(9),
        vector(0.0, 0.0, value),
        np.zeros(9),
        vector(0.0, 10.0 * value, 9.81),
        np.zeros(9),
    )


def bag(path: Path, topics: dict[str, str], plugin: StoragePlugin) -> Path:
    """Recording as rosbags writes it: three messages a topic, 0.1 s apart."""
    with BagWriter(path, version=9, storage_plugin=plugin) as writer:
        for topic, kind in topics.items():
            connection = writer.add_connection(topic, kind, typestore=TYPES)
            for index in range(3):
                data = TYPES.serialize_cdr(message(kind, index, index / 8), kind)
                writer.write(connection, (10_000 + index) * 100_000_000, data)
    return path


NODE = {
    "/truck/imu": "sensor_msgs/msg/Imu",
    "/truck/yaw": "std_msgs/msg/Float64",
    "/truck/yaw_rate": "std_msgs/msg/Float64",
    "/truck/lateral_acceleration": "std_msgs/msg/Float64",
    "/joint_states": "sensor_msgs/msg/JointState",
}
"""Some topics of the node, as a recording of all topics holds them."""


@pytest.mark.parametrize("plugin", [StoragePlugin.MCAP, StoragePlugin.SQLITE3])
def test_a_recording_of_all_topics_of_a_node_is_a_drive(tmp_path: Path, plugin: StoragePlugin) -> None:
    drive = load_drive(bag(tmp_path / "bag", NODE, plugin))
    assert drive["steering"].source == "/joint_states (sensor_msgs/msg/JointState)"
    assert values(drive) == {
        "steering": [0.0, 0.125, 0.25],
        "truck/yaw_rate": [0.0, 0.125, 0.25],
        "truck/lateral_acceleration": [0.0, 1.25, 2.5],
        "truck/yaw": [0.0, 0.125, 0.25],
        "articulation_1": [0.0, -0.125, -0.25],
    }
    for channel in drive.channels.values():
        np.testing.assert_allclose(channel.times, [0.0, 0.1, 0.2], atol=1e-12)


@pytest.mark.parametrize("plugin", [StoragePlugin.MCAP, StoragePlugin.SQLITE3])
def test_a_steering_topic_comes_before_joint_states(tmp_path: Path, plugin: StoragePlugin) -> None:
    path = bag(tmp_path / "bag", {**NODE, "/steering": "std_msgs/msg/Float64"}, plugin)
    assert load_drive(path)["steering"].source == "/steering (std_msgs/msg/Float64)"


def test_yaw_and_acceleration_are_no_candidates_for_steering(tmp_path: Path) -> None:
    scalars = {topic: kind for topic, kind in NODE.items() if kind == "std_msgs/msg/Float64"}
    path = bag(tmp_path / "bag", scalars, StoragePlugin.MCAP)
    with pytest.raises(LogError, match="no steering in it; its topics: /truck/yaw, /truck/yaw_rate, /truck"):
        load_drive(path)
    path = bag(tmp_path / "other", {**scalars, "/command": "std_msgs/msg/Float64"}, StoragePlugin.MCAP)
    assert load_drive(path)["steering"].source.startswith("/command ")


def test_a_twist_gives_speed_and_a_yaw_rate_of_no_unit(tmp_path: Path) -> None:
    topics = {"/steering": "std_msgs/msg/Float64", "/twist": "geometry_msgs/msg/TwistStamped"}
    drive = load_drive(bag(tmp_path / "bag", topics, StoragePlugin.MCAP))
    assert values(drive)["speed"] == [20.0, 20.0, 20.0]
    assert values(drive)["yaw_rate"] == [0.0, 0.125, 0.25]


def test_a_channel_is_taken_from_a_named_field_with_its_unit_and_sign(tmp_path: Path) -> None:
    topics = {"/steering": "std_msgs/msg/Float64", "/imu": "sensor_msgs/msg/Imu"}
    path = bag(tmp_path / "bag", topics, StoragePlugin.MCAP)
    drive = load_drive(path, channels=["truck/yaw_rate=-/imu.angular_velocity.z:deg/s"])
    np.testing.assert_allclose(drive["truck/yaw_rate"].values, -np.radians([0.0, 0.125, 0.25]))
    with pytest.raises(LogError, match="/gps: no such topic; expected one of /steering, /imu"):
        load_drive(path, channels=["speed=/gps"])
    with pytest.raises(LogError, match="/imu: sensor_msgs/msg/Imu has no number at 'speed'"):
        load_drive(path, channels=["speed=/imu.speed"])


def test_autowares_status_messages_are_steering_and_speed(tmp_path: Path) -> None:
    path = tmp_path / "drive.mcap"
    with path.open("wb") as file, Writer(file) as writer:
        steering = writer.register_msgdef(
            "autoware_vehicle_msgs/msg/SteeringReport", f"{TIME}float32 steering_tire_angle\n{STAMP}"
        )
        velocity = writer.register_msgdef(
            "autoware_vehicle_msgs/msg/VelocityReport",
            "std_msgs/Header header\nfloat32 longitudinal_velocity\nfloat32 lateral_velocity\n"
            f"float32 heading_rate\n{HEADER}",
        )
        for index in range(2):
            stamp = {"sec": index, "nanosec": 5}
            angle = {"stamp": stamp, "steering_tire_angle": index / 4}
            writer.write_message("/vehicle/status/steering_status", steering, angle, index * 10**9)
            report = {
                "header": {"stamp": stamp, "frame_id": ""},
                "longitudinal_velocity": 8.0 + index,
                "lateral_velocity": 0.0,
                "heading_rate": index / 2,
            }
            writer.write_message("/vehicle/status/velocity_status", velocity, report, index * 10**9)
    drive = load_drive(path)
    assert values(drive)["steering"] == [0.0, 0.25]
    assert values(drive)["speed"] == [8.0, 9.0]
    assert values(drive)["status/yaw_rate"] == [0.0, 0.5]


def test_columns_are_found_by_name_and_unit(tmp_path: Path) -> None:
    drive = load_drive(
        written(
            tmp_path,
            "time,steering_angle,speed_kmh,truck/yaw_rate_deg_s,ay_g,articulation_1,remark\n"
            "0,0.1,36,180,1,0.2,7\n1,0.2,72,-180,0,0.1,7\n",
        )
    )
    assert values(drive) == {
        "steering": [0.1, 0.2],
        "speed": [10.0, 20.0],
        "truck/yaw_rate": [pytest.approx(math.pi), pytest.approx(-math.pi)],
        "lateral_acceleration": [9.80665, 0.0],
        "articulation_1": [0.2, 0.1],
    }


def test_what_was_measured_less_often_has_its_own_times(tmp_path: Path) -> None:
    drive = load_drive(written(tmp_path, "t,steering,yaw_rate,speed\n5,0,0.1,\n6,0,,\n7,0,nan,9\n8,0,0.2\n"))
    assert drive["steering"].times.tolist() == [0.0, 1.0, 2.0, 3.0]
    assert drive["yaw_rate"].times.tolist() == [0.0, 3.0]
    assert drive["speed"].times.tolist() == [2.0]
    assert drive.notes == (
        "yaw_rate: 2 of 4 values of yaw_rate are no numbers",
        "speed: 3 of 4 values of speed are no numbers",
    )


def test_a_named_column_may_have_any_name_unit_and_sign(tmp_path: Path) -> None:
    path = written(tmp_path, "t,steering,gyro,wheel\n0,0,90,-180\n")
    drive = load_drive(path, channels=["truck/yaw_rate=-gyro:deg/s", "steering=-wheel:deg"])
    assert drive["truck/yaw_rate"].values == pytest.approx([-math.pi / 2])
    assert drive["steering"].values == pytest.approx([math.pi])
    assert drive["steering"].source == "minus column wheel"


@pytest.mark.parametrize(
    "wish, problem",
    [
        ("yaw_rate", "expected CHANNEL=PLACE"),
        ("spin=gyro", "expected CHANNEL=PLACE"),
        ("yaw_rate=gyro:km/h", "unit 'km/h': expected one of rad/s, deg/s"),
        ("yaw_rate=gyro", "gyro: no such column; expected one of t, steering"),
    ],
)
def test_a_channel_that_cannot_be_taken_is_refused_in_one_line(
    tmp_path: Path, wish: str, problem: str
) -> None:
    with pytest.raises(LogError) as caught:
        load_drive(written(tmp_path, "t,steering\n0,0\n"), channels=[wish])
    assert problem in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("nested", [False, True])
def test_vectors_of_a_mat_file_are_channels(tmp_path: Path, nested: bool) -> None:  # noqa: FBT001
    vectors = {"time": [3.0, 4.0], "steering_wheel_angle_deg": [[180.0], [0.0]], "speed_kmh": [36, 72]}
    path = tmp_path / "drive.mat"
    savemat(path, {"log": vectors} if nested else {**vectors, "note": "text", "other": [1.0, 2.0, 3.0]})
    drive = load_drive(path)
    assert drive["steering"].times.tolist() == [0.0, 1.0]
    assert values(drive) == {"steering": [pytest.approx(math.pi), 0.0], "speed": [10.0, 20.0]}


@pytest.mark.parametrize(
    "vectors, problem",
    [
        ({"steering": [0.0, 1.0]}, "no time vector; expected one of time, time_s"),
        ({"time": [0.0, 1.0], "angle": [0.0, 1.0]}, "no steering column"),
        ({"time": [0.0, 1.0], "steering": [0.0, np.nan]}, "steering(2): nan: expected a finite number"),
        ({"time": [1.0, 0.0], "steering": [0.0, 0.0]}, "time(2): 0.0: expected a time not before 1.0"),
        ({"time": [0.0, 2e9], "steering": [0.0, 0.0]}, "it lasts 2e+09 s"),
        ({"time": [0.0, 1.0], "steering": [0.0, 2e4]}, "steering(2): expected an angle within 10000 rad"),
    ],
)
def test_a_mat_file_that_is_no_drive_is_refused_in_one_line(
    tmp_path: Path, vectors: dict[str, list[float]], problem: str
) -> None:
    path = tmp_path / "drive.mat"
    savemat(path, vectors)
    with pytest.raises(LogError) as caught:
        load_drive(path)
    assert problem in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "content, problem",
    [
        (b"", "not a MATLAB file"),
        (b"MATLAB 7.3 MAT-file, Platform: GLNXA64", "a MATLAB 7.3 file; expected one saved with -v7"),
        (b"time,steering\n0,0\n" * 20, "not a MATLAB file"),
    ],
)
def test_what_is_no_mat_file_is_refused_in_one_line(tmp_path: Path, content: bytes, problem: str) -> None:
    path = tmp_path / "drive.mat"
    path.write_bytes(content)
    with pytest.raises(LogError, match=problem):
        load_drive(path)


def test_a_broken_sqlite_recording_is_refused_in_one_line(tmp_path: Path) -> None:
    path = bag(tmp_path / "bag", NODE, StoragePlugin.SQLITE3)
    (file,) = path.glob("*.db3")
    file.write_bytes(b"SQLite format 3\0" + bytes(100))
    with pytest.raises(LogError) as caught:
        load_drive(path)
    assert str(caught.value).startswith(f"{path}: cannot be read: ")
    assert "\n" not in str(caught.value)
