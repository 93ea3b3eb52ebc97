import math
import signal
import time
from typing import Any

import numpy as np
import pytest
from builtin_interfaces.msg import Time
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, Header

from graph import Graph, outcome, state, stop, until
from runs import recorded, run_directory
from yawdamp_ros import load_vehicle

pytestmark = pytest.mark.graph

HOUR = 3600 * 10**9


def joint_state(angle: float, stamp: int, joint: str = "wheel") -> JointState:
    header = Header(stamp=Time(sec=stamp // 10**9, nanosec=stamp % 10**9))
    return JointState(header=header, name=["other", joint], position=[9.0, angle])


def steering_angle(graph: Graph) -> float:
    return float(graph.messages("/joint_states")[-1].position[0])


def started(graph: Graph, *parameters: str) -> Any:  # noqa: ANN401 - a process
    graph.listen({"/joint_states": JointState})
    arguments = [word for parameter in parameters for word in ("-p", parameter)]
    process = graph.command("sim", "--ros-args", *arguments)
    until(lambda: bool(graph.received["/joint_states"]), "a sample")
    return process


def test_a_joint_state_steers_and_a_stamp_that_is_not_of_now_is_refused(graph: Graph) -> None:
    process = started(graph, "steering_type:=sensor_msgs/msg/JointState", "steering_joint:=wheel")
    publisher = graph.publisher(JointState, "/steering")
    publisher.publish(joint_state(0.1, time.time_ns()))
    until(lambda: steering_angle(graph) == 0.1, "the joint's angle")
    publisher.publish(joint_state(0.2, time.time_ns() - HOUR))
    publisher.publish(joint_state(0.3, time.time_ns() + HOUR))
    publisher.publish(joint_state(0.4, time.time_ns(), joint="front"))
    publisher.publish(joint_state(-0.05, 0))  # no stamp at all
    until(lambda: steering_angle(graph) == -0.05, "the last command")
    status, _, errors = stop(process)
    assert status == 0
    assert "rejected, its time stamp is too far from now" in errors
    assert "no joint 'wheel' with a position" in errors
    steering = recorded(run_directory(graph.directory))["/steering_applied"]
    assert [message.data for _, message in steering] == [0.0, 0.1, -0.05]


@pytest.mark.parametrize(
    "kind",
    ["ackermann_msgs/msg/AckermannDriveStamped", "autoware_control_msgs/msg/Lateral"],
)
def test_a_type_that_is_not_installed_names_its_package(graph: Graph, kind: str) -> None:
    package = kind.partition("/")[0]
    if graph.installed(package):
        pytest.skip(f"{package} is installed")
    status, _, errors = outcome(graph.command("sim", "--ros-args", "-p", f"steering_type:={kind}"))
    assert status == 2
    assert f"{kind}: needs the package {package}, which is not installed" in errors


def test_the_model_follows_the_speed_topic(graph: Graph) -> None:
    graph.listen({"/truck/odom": Odometry})
    process = started(graph, "speed_source:=topic")
    publisher = graph.publisher(Float64, "/speed")
    for speed, followed in ((15.0, 15.0), (18.25, 18.25), (0.2, 1.0)):
        for refused in (math.nan, -3.0, math.inf):
            publisher.publish(Float64(data=refused))
        publisher.publish(Float64(data=speed))
        until(
            lambda followed=followed: graph.messages("/truck/odom")[-1].twist.twist.linear.x == followed,
            f"the model at {followed} m/s",
        )
    status, _, errors = stop(process)
    assert status == 0
    assert "speed: nan: rejected, not a finite number" in errors
    speeds = [message.data for _, message in recorded(run_directory(graph.directory))["/speed"]]
    assert speeds == [load_vehicle("interlink").speed, 15.0, 18.25, 1.0]


def test_the_actuator_lags_behind_the_command(graph: Graph) -> None:
    process = started(graph, "steering_rate_limit:=0.5", "steering_time_constant:=0.1")
    graph.steering_publisher().publish(Float64(data=0.2))
    until(lambda: abs(steering_angle(graph) - 0.2) < 1e-4, "the command to be reached")
    assert stop(process)[0] == 0
    steering = recorded(run_directory(graph.directory))["/steering_applied"]
    angles = np.array([message.data for _, message in steering])
    assert (np.diff(angles) > 0.0).all()
    assert np.diff(angles).max() <= 0.0005 + 1e-12
    assert len(angles) > 400  # 0.4 s at the rate limit, and the lag on top, step by step


def test_diagnostics_warn_of_refused_and_of_missing_commands(graph: Graph) -> None:
    process = started(graph)
    statuses = graph.statuses()
    until(lambda: state(statuses("steering")) == "no_command", "the first look")
    assert statuses("steering").level == b"\0"
    publisher = graph.steering_publisher()
    publisher.publish(Float64(data=math.nan))
    until(lambda: state(statuses("steering"), "problems") == "rejected_not_finite", "a warning of NaN")
    assert statuses("steering").level == b"\1"
    publisher.publish(Float64(data=5.0))
    until(lambda: "clamped" in state(statuses("steering"), "problems"), "a warning of clamping")
    until(lambda: state(statuses("steering")) == "timed_out", "a warning of silence")
    assert statuses("steering").level == b"\1"
    values = {value.key: value.value for value in statuses("steering").values}
    assert values["clamped"] == "1"
    assert values["rejected_not_finite"] == "1"
    assert float(values["age"].removesuffix(" s")) > 0.5
    assert stop(process)[0] == 0


def test_diagnostics_tell_of_time_model_and_recorder(graph: Graph) -> None:
    process = started(graph)
    statuses = graph.statuses()
    until(lambda: state(statuses("timing")) == "in_time", "the first look")
    assert state(statuses("recorder")) == "recording"
    assert (statuses("model").level, state(statuses("model"))) == (b"\0", "stable")
    values = {value.key: value.value for value in statuses("model").values}
    assert values["least_damping_ratio"] == "0.6576"
    assert values["speed"] == "22.2222 m/s"
    process.send_signal(signal.SIGSTOP)
    time.sleep(1.0)
    process.send_signal(signal.SIGCONT)
    until(lambda: state(statuses("timing")) == "steps_dropped", "a warning of lost time")
    assert statuses("timing").level == b"\1"
    until(lambda: state(statuses("timing")) == "in_time", "good order again")
    assert stop(process)[0] == 0


def test_a_joint_state_without_the_joint_is_warned_of(graph: Graph) -> None:
    process = started(graph, "steering_type:=sensor_msgs/msg/JointState")
    statuses = graph.statuses()
    graph.publisher(JointState, "/steering").publish(joint_state(0.1, 0, joint="wheel"))
    until(lambda: state(statuses("steering"), "problems") == "rejected_no_joint", "a warning")
    assert statuses("steering").level == b"\1"
    assert stop(process)[0] == 0


def test_an_unstable_vehicle_is_warned_of(graph: Graph) -> None:
    process = started(graph, "model:=published", "speed:=10.0")
    statuses = graph.statuses()
    until(lambda: state(statuses("model")) == "unstable", "the look at the model")
    assert statuses("model").level == b"\1"
    assert stop(process)[0] == 0


def test_a_failing_disk_is_an_error(graph: Graph) -> None:
    limited = ("bash", "-c", 'ulimit -f 40; trap "" XFSZ; exec "$@"', "bash")
    process = graph.command("sim", "--manoeuvre", "chirp", under=limited)
    statuses = graph.statuses()
    until(lambda: state(statuses("recorder")) == "failed", "the failure")
    assert statuses("recorder").level == b"\2"
    status, _, errors = stop(process)
    assert status == 1
    assert "Traceback" not in errors
