import signal

import numpy as np
import pytest
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import Float64
from std_srvs.srv import SetBool, Trigger
from visualization_msgs.msg import MarkerArray

from graph import Graph, outcome, stamps, stop, until
from runs import PERIOD, UNITS, recorded, run_directory, simulated_times
from yawdamp_ros.cli import run
from yawdamp_ros.vehicle import vehicle_text

pytestmark = pytest.mark.graph


def test_clock_and_markers_bear_the_stamps_of_the_samples(graph: Graph) -> None:
    graph.listen({"/clock": Clock, "/markers": MarkerArray, "/truck/imu": Imu})
    parameters = ["-p", "publish_clock:=true", "-p", "publish_markers:=true"]
    process = graph.command("sim", "--manoeuvre", "step", "--ros-args", *parameters)
    until(lambda: all(len(graph.received[topic]) > 50 for topic in ("/clock", "/markers")), "samples")
    assert graph.call("/yawdamp_sim/pause", SetBool, SetBool.Request(data=True)).success
    assert stop(process)[0] == 0
    samples = set(stamps([message for _, message in recorded(run_directory(graph.directory))["/truck/imu"]]))
    clock = [message.clock.sec * 10**9 + message.clock.nanosec for message in graph.messages("/clock")]
    assert np.diff(clock).tolist() == [PERIOD] * (len(clock) - 1)
    assert set(clock) <= samples
    boxes = graph.messages("/markers")[-1].markers
    assert [box.id for box in boxes] == [0, 1, 2]
    assert {box.header.frame_id for box in boxes} == {"odom"}
    # The truck's box reaches from its rearmost to its foremost axle, 5.159 m, its middle behind the CG.
    assert boxes[0].scale.x == pytest.approx(5.159)
    assert boxes[0].pose.position.x > boxes[1].pose.position.x > boxes[2].pose.position.x


def test_as_fast_as_it_goes_publishes_and_records_every_sample(graph: Graph) -> None:
    parameters = ["--ros-args", "-p", "real_time_factor:=0.0"]
    status, _, errors = outcome(graph.command("sim", "--manoeuvre", "sine", "--duration", "20", *parameters))
    assert status == 0, errors
    found = simulated_times(run_directory(graph.directory))
    assert np.diff(found).tolist() == [PERIOD] * 2000
    assert run(["resimulate", str(run_directory(graph.directory))]) == 0


def test_the_rate_can_change_while_running(graph: Graph) -> None:
    process = graph.command("sim")
    statuses = graph.statuses()

    def wanted() -> str:
        return {value.key: value.value for value in statuses("timing").values}["wanted_rate"]

    until(lambda: wanted() == "100.00 Hz", "the first look")
    assert graph.set_parameter("/yawdamp_sim", "real_time_factor", 5.0).successful
    until(lambda: wanted() == "500.00 Hz", "the new rate")
    refused = graph.set_parameter("/yawdamp_sim", "real_time_factor", 0.05)
    assert not refused.successful
    assert "expected 0, or 0.1 to 100" in refused.reason
    assert stop(process)[0] == 0
    found = simulated_times(run_directory(graph.directory))
    assert np.diff(found).tolist() == [PERIOD] * (len(found) - 1)


def test_a_whole_set_of_parameters_is_refused_for_one_of_them(graph: Graph) -> None:
    process = graph.command("sim")
    until(lambda: graph.publishers("/truck/imu") == 1, "the node")
    result = graph.set_parameters_atomically(
        "/yawdamp_sim", {"max_steering_angle": 0.1, "on_steering_timeout": "panic"}
    )
    assert not result.successful
    assert "on_steering_timeout: 'panic': expected one of hold, zero" in result.reason
    assert graph.parameter("/yawdamp_sim", "max_steering_angle") == 0.8
    assert graph.set_parameters_atomically(
        "/yawdamp_sim", {"max_steering_angle": 0.1, "on_steering_timeout": "zero"}
    ).successful
    assert graph.parameter("/yawdamp_sim", "max_steering_angle") == 0.1
    assert stop(process)[0] == 0


def test_a_recording_can_be_stopped_and_started_and_each_part_repeats(graph: Graph) -> None:
    process = graph.command(
        *("sim", "--no-record", "--manoeuvre", "chirp", "--ros-args", "-p", "yaw_rate_stddev:=0.01"),
        *("-p", "yaw_rate_drift:=0.01", "-p", "yaw_bias:=0.02", "-p", "imu_delay:=0.05"),
    )
    graph.listen({"/truck/imu": Imu})
    until(lambda: len(graph.received["/truck/imu"]) > 50, "samples before any recording")
    for _ in range(2):
        assert graph.call("/yawdamp_sim/record", SetBool, SetBool.Request(data=True)).success
        before = len(graph.received["/truck/imu"])
        until(lambda before=before: len(graph.received["/truck/imu"]) > before + 120, "a second of samples")
        answer = graph.call("/yawdamp_sim/record", SetBool, SetBool.Request(data=False))
        assert (answer.success, answer.message) == (True, "idle: not recording")
    assert stop(process)[0] == 0
    runs = sorted((graph.directory / "runs").iterdir())
    assert len(runs) == 2
    for part in runs:
        assert len(recorded(part)["/truck/imu"]) >= 100
        assert run(["resimulate", str(part)]) == 0


def test_noise_is_on_the_imu_alone_with_its_covariance_and_repeats(graph: Graph) -> None:
    noise = ["yaw_stddev:=0.01", "yaw_rate_stddev:=0.02", "lateral_acceleration_stddev:=0.3", "noise_seed:=7"]
    arguments = [word for parameter in noise for word in ("-p", parameter)]
    process = graph.command("sim", "--duration", "5", "--ros-args", *arguments)
    status, _, errors = outcome(process)
    assert status == 0, errors
    path = run_directory(graph.directory)
    messages = recorded(path)
    for unit in UNITS:
        imu = [message for _, message in messages[f"/{unit}/imu"]]
        assert np.std([message.angular_velocity.z for message in imu]) == pytest.approx(0.02, rel=0.15)
        assert np.std([message.linear_acceleration.y for message in imu]) == pytest.approx(0.3, rel=0.15)
        assert {message.angular_velocity_covariance[8] for message in imu} == {0.02**2}
        assert {message.linear_acceleration_covariance[4] for message in imu} == {0.3**2}
        assert {message.orientation_covariance[8] for message in imu} == {0.01**2}
        assert {message.twist.twist.angular.z for _, message in messages[f"/{unit}/odom"]} == {0.0}
        assert {message.data for _, message in messages[f"/{unit}/yaw_rate"]} == {0.0}
    assert run(["resimulate", str(path)]) == 0


def test_simulators_side_by_side_do_not_meet_and_stand_in_one_world(graph: Graph) -> None:
    graph.listen({f"/{side}/truck/imu": Imu for side in ("left", "right")})
    processes = {
        side: graph.command(
            *("sim", "--manoeuvre", "step", "--amplitude", amplitude, "--ros-args", "-r", f"__ns:=/{side}"),
            *("-p", "world_frame:=map", "-p", f"initial_pose:=[0.0, {y}, 0.0]"),
            *("-p", f"record_directory:=runs/{side}"),
        )
        for side, amplitude, y in (("left", "0.05", "3.5"), ("right", "-0.05", "-3.5"))
    }
    until(lambda: all(len(messages) > 150 for messages in graph.received.values()), "samples of both")
    assert graph.call("/left/yawdamp_sim/reset", Trigger, Trigger.Request()).success
    for process in processes.values():
        assert stop(process)[0] == 0
    assert graph.messages("/left/truck/imu")[150].angular_velocity.z > 0.0
    assert all(message.angular_velocity.z <= 0.0 for message in graph.messages("/right/truck/imu"))
    parents: dict[str, str] = {}
    for side, y in (("left", 3.5), ("right", -3.5)):
        messages = recorded(graph.directory / "runs" / side)
        assert messages[f"/{side}/truck/odom"][0][1].pose.pose.position.y == y
        frames = [*messages["/tf"][0][1].transforms, *messages["/tf_static"][0][1].transforms]
        for each in frames:
            assert each.child_frame_id not in parents  # two nodes on one /tf would move it to and fro
            parents[each.child_frame_id] = each.header.frame_id
    assert (parents["left/odom"], parents["right/odom"]) == ("map", "map")
    assert parents["right/truck"] == "right/odom"


def test_a_recording_holds_the_vehicle_that_runs_whatever_became_of_its_file(graph: Graph) -> None:
    file = graph.directory / "mine.yaml"
    file.write_text(vehicle_text("interlink"))
    parameters = ["--ros-args", "-p", "publish_rate:=1.0"]
    process = graph.command(
        "sim", "--vehicle", "mine.yaml", "--no-record", "--manoeuvre", "sine", *parameters
    )
    until(lambda: graph.publishers("/truck/imu") == 1, "the node")
    file.unlink()
    # At one sample a second, the first is out and the next far: the recording begins between them.
    assert graph.call("/yawdamp_sim/record", SetBool, SetBool.Request(data=True)).success
    graph.listen({"/truck/imu": Imu})
    until(lambda: len(graph.received["/truck/imu"]) > 1, "two samples")
    assert stop(process)[0] == 0
    assert run(["resimulate", str(run_directory(graph.directory))]) == 0


def test_a_lower_limit_holds_for_the_command_in_force(graph: Graph) -> None:
    graph.listen({"/joint_states": JointState})
    process = graph.command("sim")
    until(lambda: bool(graph.received["/joint_states"]), "a sample")
    graph.steering_publisher().publish(Float64(data=0.5))
    until(lambda: graph.messages("/joint_states")[-1].position[0] == 0.5, "the command")
    assert graph.set_parameter("/yawdamp_sim", "max_steering_angle", 0.05).successful
    until(lambda: graph.messages("/joint_states")[-1].position[0] == 0.05, "the new limit")
    assert stop(process)[0] == 0


def test_a_prefix_tells_the_frames_of_simulators_apart(graph: Graph) -> None:
    graph.listen({"/truck/odom": Odometry, "/markers": MarkerArray})
    parameters = ["-p", "frame_prefix:=left/", "-p", "publish_markers:=true"]
    process = graph.command("sim", "--ros-args", *parameters)
    until(lambda: all(graph.received[topic] for topic in ("/truck/odom", "/markers")), "samples")
    odometry = graph.messages("/truck/odom")[0]
    assert (odometry.header.frame_id, odometry.child_frame_id) == ("left/odom", "left/truck")
    assert graph.messages("/markers")[0].markers[0].header.frame_id == "left/odom"
    assert stop(process)[0] == 0
    assert run(["resimulate", str(run_directory(graph.directory))]) == 0


def test_under_nohup_a_hang_up_is_ignored(graph: Graph) -> None:
    process = graph.command("sim", under=["nohup"])
    graph.listen({"/truck/imu": Imu})
    until(lambda: len(graph.received["/truck/imu"]) > 5, "samples")
    process.send_signal(signal.SIGHUP)
    before = len(graph.received["/truck/imu"])
    until(lambda: len(graph.received["/truck/imu"]) > before + 50, "samples after the hang-up")
    assert stop(process)[0] == 0
