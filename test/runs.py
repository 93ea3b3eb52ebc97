"""Recorded runs, as tests read them."""

from pathlib import Path
from typing import Any

from nav_msgs.msg import Odometry
from rosbags.highlevel import AnyReader
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import Float64

from yawdamp_ros import linear_model, load_vehicle
from yawdamp_ros.logs import McapLog
from yawdamp_ros.runs.jumps import jump_of
from yawdamp_ros.stepping import Sample, Stepper

UNITS = ("truck", "trailer_1", "trailer_2")
OUTPUTS: dict[str, type] = {
    **{f"/{unit}/imu": Imu for unit in UNITS},
    **{f"/{unit}/odom": Odometry for unit in UNITS},
    **{
        f"/{unit}/{scalar}": Float64
        for unit in UNITS
        for scalar in ("yaw", "yaw_rate", "lateral_acceleration")
    },
    "/joint_states": JointState,
}
PERIOD = 10_000_000
"""Period of samples at the default rate [ns]."""


def run_directory(directory: Path) -> Path:
    """The only run below a working directory."""
    (found,) = (directory / "runs").iterdir()
    return found


def recorded(run: Path) -> dict[str, list[tuple[int, Any]]]:
    """Messages of a run by topic, with their log times but for the jumps that are recorded."""
    messages: dict[str, list[tuple[int, Any]]] = {}
    jumped = 0
    with AnyReader([run]) as reader:
        for connection, log_time, data in reader.messages():
            message = reader.deserialize(data, connection.msgtype)
            if connection.topic == "/time_jump":
                jumped += message.data
            messages.setdefault(connection.topic, []).append((log_time - jumped, message))
    return messages


def simulated_times(run: Path, topic: str = "/truck/imu") -> list[int]:
    """Log times of a topic but for the jumps that are recorded, in the order of the file."""
    times, jumped = [], 0
    for message in McapLog(run).messages():
        if message.topic == "/time_jump":
            jumped += jump_of(message.data)
        elif message.topic == topic:
            times.append(message.log_time - jumped)
    return times


def stepped_again(steering: list[tuple[int, Any]], samples: int) -> list[Sample]:
    """Simulate the interlink under the steering that a run recorded as applied."""
    start = steering[0][0]
    angles = {(log_time - start) // 1_000_000: message.data for log_time, message in steering}

    stepper = Stepper(linear_model(load_vehicle("interlink")), 0.001)
    stepper.steer(angles[0])
    taken = [stepper.sample()]
    held = angles[0]
    for index in range(samples - 1):
        ahead = []
        for step in range(10 * index + 1, 10 * index + 11):
            held = angles.get(step, held)
            ahead.append(held)
        taken.append(stepper.run(ahead))
    return taken


def check_all_came(arrived: list[Any], published: list[Any], lost: int) -> None:
    """Check messages that arrived: as published, in order, none missing but those that DDS counts.

    Those before the first that came were published when nobody listened yet.
    """
    assert lost <= len(published) / 100
    assert len(arrived) + lost <= len(published)
    rest = iter(published[len(published) - len(arrived) - lost :])
    assert all(one in rest for one in arrived), f"{lost} lost"
