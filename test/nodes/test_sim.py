import itertools
import math
import random
import signal
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import Float64
from std_srvs.srv import SetBool, Trigger

from graph import SETTLING, Graph, has_handler, outcome, stamps, stop, until
from runs import (
    OUTPUTS,
    PERIOD,
    UNITS,
    check_all_came,
    recorded,
    run_directory,
    simulated_times,
    stepped_again,
)
from yawdamp_ros import load_vehicle, simulate
from yawdamp_ros.manoeuvres import Sine
from yawdamp_ros.nodes.graph import join, ros_graph, spin
from yawdamp_ros.nodes.server import Server
from yawdamp_ros.nodes.sim import Simulator
from yawdamp_ros.nodes.stop_request import StopRequest
from yawdamp_ros.share import share_directory

pytestmark = pytest.mark.graph


def yaw_of(orientation: Any) -> float:  # noqa: ANN401 - a generated message
    return 2.0 * math.atan2(orientation.z, orientation.w)


def test_a_manoeuvre_arrives_over_the_graph_as_the_model_has_it(graph: Graph) -> None:
    graph.listen(OUTPUTS)
    process = graph.command("sim", "--manoeuvre", "sine")
    # The two sides need a while to find each other; the sine goes on until they have.
    until(lambda: all(len(graph.received[topic]) > 200 for topic in OUTPUTS), "two seconds of every output")
    status, output, errors = stop(process)
    assert status == 0, errors
    path = run_directory(graph.directory)
    messages = recorded(path)
    # Stamps follow ROS time, by jumps where the machine held the node up: a sample is known by its stamp.
    published = stamps([message for _, message in messages["/truck/imu"]])
    index_of = {stamp: index for index, stamp in enumerate(published)}
    count = len(index_of)
    expected = simulate(load_vehicle("interlink"), Sine(), (count - 1) / 100, sample_period=0.01)

    def samples(topic: str) -> list[int]:
        found = [index_of[stamp] for stamp in stamps(graph.messages(topic))]
        check_all_came(found, list(range(count)), graph.lost[topic])
        return found

    for index, unit in enumerate(UNITS):
        imu, odom = graph.messages(f"/{unit}/imu"), graph.messages(f"/{unit}/odom")
        at = samples(f"/{unit}/imu")
        assert [message.angular_velocity.z for message in imu] == list(expected.yaw_rate[at, index])
        assert [message.linear_acceleration.y for message in imu] == list(
            expected.lateral_acceleration[at, index]
        )
        yaw = expected.yaw[at, index]
        np.testing.assert_allclose([yaw_of(message.orientation) for message in imu], yaw, atol=1e-12)
        assert {message.linear_acceleration.z for message in imu} == {9.80665}
        assert {message.header.frame_id for message in imu} == {unit}
        at = samples(f"/{unit}/odom")
        assert {(message.header.frame_id, message.child_frame_id) for message in odom} == {("odom", unit)}
        forward = [message.twist.twist.linear.x for message in odom]
        speed = load_vehicle("interlink").speed
        # A trailer at an angle to the truck is slower along its own axis.
        assert (
            set(forward) == {speed} if index == 0 else forward == pytest.approx([speed] * len(odom), rel=0.01)
        )
        assert [message.pose.pose.position.x for message in odom] == list(expected.x[at, index])
        assert [message.pose.pose.position.y for message in odom] == list(expected.y[at, index])
        scalars = [message.data for message in graph.messages(f"/{unit}/yaw")]
        check_all_came(scalars, list(expected.yaw[:, index]), graph.lost[f"/{unit}/yaw"])
    joints, at = graph.messages("/joint_states"), samples("/joint_states")
    assert list(joints[0].name) == ["steering", "articulation_1", "articulation_2"]
    angles = np.array([message.position for message in joints])
    np.testing.assert_array_equal(angles[:, 0], expected.steering_angle[at])
    np.testing.assert_array_equal(angles[:, 1:], expected.articulation[at])
    assert "trailer_2" in output
    assert f"run: {path.relative_to(graph.directory)}" in output


def test_steering_from_the_graph_is_applied_recorded_and_stepped_as_recorded(graph: Graph) -> None:
    graph.listen(OUTPUTS)
    process = graph.command("sim")
    publisher = graph.steering_publisher()
    commands = itertools.count()

    def applied() -> int:
        publisher.publish(Float64(data=0.05 * math.sin(0.1 * next(commands))))
        return len({message.position[0] for message in graph.messages("/joint_states")})

    until(lambda: applied() > 60, "sixty commands to be applied")
    status, _, errors = stop(process)
    assert status == 0, errors
    run = run_directory(graph.directory)
    messages = recorded(run)
    count = len(messages["/truck/imu"])
    samples = stepped_again(messages["/steering_applied"], count)
    assert max(abs(message.data) for _, message in messages["/steering_applied"]) == pytest.approx(
        0.05, abs=1e-4
    )
    assert len({message.data for _, message in messages["/steering_applied"]}) > 50
    for index, unit in enumerate(UNITS):
        assert [message.data for _, message in messages[f"/{unit}/lateral_acceleration"]] == [
            sample.lateral_acceleration[index] for sample in samples
        ]
        assert [message.data for _, message in messages[f"/{unit}/yaw"]] == [
            sample.yaw[index] for sample in samples
        ]
    for topic in OUTPUTS:
        assert len(messages[topic]) == count


def test_bad_commands_are_refused_or_clamped_and_said(graph: Graph) -> None:
    graph.listen({"/joint_states": JointState})
    process = graph.command("sim", "--ros-args", "-p", "steering_ratio:=2.0", "-p", "max_steering_angle:=0.3")
    publisher = graph.steering_publisher()

    def angle() -> float:
        return float(graph.messages("/joint_states")[-1].position[0])

    until(lambda: bool(graph.received["/joint_states"]), "a sample")
    publisher.publish(Float64(data=0.2))
    until(lambda: angle() == 0.1, "0.2 rad of the hand wheel to become 0.1 rad")
    for bad in (math.nan, math.inf, -math.inf):
        publisher.publish(Float64(data=bad))
    publisher.publish(Float64(data=-7.0))
    until(lambda: angle() == -0.3, "the clamped angle")
    status, _, errors = stop(process)
    assert status == 0
    assert "rejected, not a finite number" in errors
    assert "outside the limits, clamped" in errors
    applied = [message.data for _, message in recorded(run_directory(graph.directory))["/steering_applied"]]
    assert applied == [0.0, 0.1, -0.3]


def test_a_command_that_comes_before_the_first_sample_acts_from_the_first_step_on(
    graph: Graph, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROS_DOMAIN_ID", graph.environment["ROS_DOMAIN_ID"])
    path = graph.directory / "run"
    with StopRequest() as request, ros_graph([]):
        node = join("yawdamp_sim", {"record_directory": str(path)})
        simulator = Simulator(node)
        graph.steering_publisher().publish(Float64(data=0.1))
        time.sleep(SETTLING)  # the command has come
        simulator.publish_first()
        Server(node, simulator)
        assert spin(node, request, lambda: simulator.run.samples > 5, lambda: None)
        simulator.close()
    (start, at_rest), (then, steered) = recorded(path)["/steering_applied"]
    assert (at_rest.data, steered.data, then - start) == (0.0, 0.1, 1_000_000)


@pytest.mark.parametrize("reaction, last", [("hold", 0.1), ("zero", 0.0)])
def test_silence_holds_or_zeroes_as_asked(graph: Graph, reaction: str, last: float) -> None:
    parameters = ["-p", f"on_steering_timeout:={reaction}", "-p", "steering_timeout:=0.2"]
    process = graph.command("sim", "--ros-args", *parameters)
    graph.listen({"/joint_states": JointState})
    graph.steering_publisher().publish(Float64(data=0.1))
    until(
        lambda: any(message.position[0] == 0.1 for message in graph.messages("/joint_states")[-5:]),
        "the command to be applied",
    )
    heard = len(graph.received["/joint_states"])
    until(lambda: len(graph.received["/joint_states"]) > heard + 50, "half a second more")
    assert graph.messages("/joint_states")[-1].position[0] == last
    assert stop(process)[0] == 0
    steering = recorded(run_directory(graph.directory))["/steering_applied"]
    if reaction == "zero":
        (_, (on, _), (off, _)) = steering
        # The command is in force one step after the last it could not change any more.
        assert 200_000_000 <= off - on <= 211_000_000


def test_a_signal_at_any_moment_ends_in_good_order(graph: Graph) -> None:
    moments = random.Random(2)  # noqa: S311 - any moments will do, the same ones each time
    cases = [
        (number, delay)
        for number, count in ((signal.SIGINT, 9), (signal.SIGTERM, 4), (signal.SIGHUP, 4))
        for delay in (0.0, *(moments.uniform(0.0, 1.5) for _ in range(count)))
    ]

    def end(case: tuple[int, float]) -> tuple[Path, int, str]:
        number, delay = case
        directory = graph.directory / f"{number}_{delay:.6f}"
        process = graph.command("sim", "--output", str(directory))
        # Before the project's first line, a signal meets the bare interpreter; SIGHUP's handler comes last.
        until(lambda: has_handler(process, signal.SIGHUP), "the handlers")
        time.sleep(delay)
        process.send_signal(number)
        time.sleep(0.01)
        status, _, errors = stop(process, number)
        return directory, status, errors

    with ThreadPoolExecutor(3) as pool:
        ended = list(pool.map(end, cases))
    for case, (directory, status, errors) in zip(cases, ended, strict=True):
        assert status == 0, (case, errors)
        assert "Traceback" not in errors
        assert "Exception" not in errors
        if directory.exists():
            assert recorded(directory) is not None
            assert (directory / "metadata.yaml").is_file()


def test_time_that_was_lost_is_counted_and_samples_stay_on_the_grid(graph: Graph) -> None:
    graph.listen({"/truck/imu": Imu})
    process = graph.command("sim")
    until(lambda: len(graph.received["/truck/imu"]) > 20, "some samples")
    process.send_signal(signal.SIGSTOP)
    time.sleep(1.0)
    process.send_signal(signal.SIGCONT)
    before = len(graph.received["/truck/imu"])
    until(lambda: len(graph.received["/truck/imu"]) > before + 50, "more samples")
    status, output, errors = stop(process)
    assert status == 0
    assert "steps dropped so far" in errors
    assert "steps dropped" in output
    got = simulated_times(run_directory(graph.directory))
    assert np.diff(got).tolist() == [PERIOD] * (len(got) - 1)


def test_a_namespace_moves_every_topic(graph: Graph) -> None:
    graph.listen({"/left/trailer_2/imu": Imu})
    process = graph.command("sim", "--ros-args", "-r", "__ns:=/left")
    graph.steering_publisher("/left/steering")
    until(lambda: len(graph.received["/left/trailer_2/imu"]) > 5, "samples in the namespace")
    names = {name for name, _ in graph.node.get_topic_names_and_types()}
    outside = {name for name in names if not name.startswith("/left/")}
    assert outside <= {"/rosout", "/parameter_events", "/diagnostics"}
    assert stop(process)[0] == 0
    # Where the machine held the node up, its stamps jumped.
    kept = set(recorded(run_directory(graph.directory))) - {"/left/time_jump"}
    named = {f"/left{topic}" for topic in OUTPUTS if not topic.startswith("/tf")}
    assert kept == {"/left/steering_applied", "/left/speed", "/tf", "/tf_static", *named}


def test_what_is_not_wanted_is_neither_published_nor_recorded(graph: Graph) -> None:
    process = graph.command("sim", "--no-record", "--ros-args", "-p", "publish_scalars:=false")
    graph.listen({"/truck/imu": Imu})
    until(lambda: len(graph.received["/truck/imu"]) > 5, "samples")
    assert graph.publishers("/truck/yaw") == 0
    status, output, _ = stop(process)
    assert status == 0
    assert "run:" not in output
    assert list(graph.directory.iterdir()) == []


@pytest.mark.parametrize(
    "arguments, message",
    [
        (["--vehicle", "lorry"], "lorry: no such vehicle"),
        (["--manoeuvre", "step", "--cycles", "2"], "cycles: manoeuvre step does not use it"),
        (["--output", "."], "cannot be recorded to: File exists"),
        (
            ["--ros-args", "-p", "publish_rate:=50"],
            "parameter publish_rate: 50: expected a double, write 50.0",
        ),
        (["--ros-args", "-p", "publish_rate:=-1.0"], "parameter publish_rate: -1.0: expected a number from"),
        (["--ros-args", "-p", "publsh_rate:=50.0"], "no such parameter; did you mean publish_rate?"),
        (["--ros-args", "-p", "model:=exact"], "parameter model: 'exact': expected one of consistent"),
        (["--ros-args", "-p", "noise_seed:=-1"], "parameter noise_seed: -1: expected a number from 0"),
        (["--ros-args", "-p", "speed:=1e-300"], "speed: 1e-300: model consistent cannot stand or reverse"),
        (["--no-record", "--output", "run"], "--output: there is no recording with --no-record"),
        (["--ros-args", "-p", "step_size:=0.003"], "step_size: 0.003 s: expected a whole number of steps"),
        (
            ["--ros-args", "-p", "manoeuvre.amplitude:=0.1"],
            "parameter manoeuvre.amplitude: manoeuvre.name is none",
        ),
        (["--ros-args", "-p", "vehicle_overrides:=['units.1.mass=0']"], "units.1.mass: 0: expected a mass"),
    ],
)
def test_wrong_use_is_one_line_and_status_2(graph: Graph, arguments: list[str], message: str) -> None:
    status, output, errors = outcome(graph.command("sim", *arguments))
    assert (status, output) == (2, "")
    assert message in errors
    assert errors.count("\n") == 1


def test_parameters_come_from_the_file_that_ships_with_the_package(graph: Graph) -> None:
    file = share_directory() / "config" / "sim.yaml"
    process = graph.command("sim", "--duration", "0.5", "--ros-args", "--params-file", str(file))
    status, output, errors = outcome(process)
    assert status == 0, errors
    assert "interlink" in output


def test_a_disk_that_fills_does_not_stop_the_simulation(graph: Graph) -> None:
    limited = ("bash", "-c", 'ulimit -f 40; trap "" XFSZ; exec "$@"', "bash")
    process = graph.command("sim", under=limited)
    graph.listen({"/truck/imu": Imu})
    until(lambda: len(graph.received["/truck/imu"]) > 300, "three seconds of samples")
    status, output, errors = stop(process)
    assert status == 1
    assert "messages not recorded, the simulation goes on" in errors
    assert "Traceback" not in errors
    assert "truck" in output


def test_pause_stops_time_step_takes_one_period_and_resume_goes_on(graph: Graph) -> None:
    graph.listen({"/truck/imu": Imu, "/clock": Clock})
    process = graph.command("sim", "--ros-args", "-p", "publish_clock:=true")
    until(lambda: all(len(graph.received[topic]) > 20 for topic in ("/truck/imu", "/clock")), "some samples")
    assert not graph.call("/yawdamp_sim/step", Trigger, Trigger.Request()).success
    assert graph.call("/yawdamp_sim/pause", SetBool, SetBool.Request(data=True)).success
    time.sleep(0.5)  # whatever was under way has arrived
    still, clock = len(graph.received["/truck/imu"]), len(graph.received["/clock"])
    time.sleep(0.5)
    assert (len(graph.received["/truck/imu"]), len(graph.received["/clock"])) == (still, clock)
    for index in range(1, 4):
        assert graph.call("/yawdamp_sim/step", Trigger, Trigger.Request()).success
        until(lambda index=index: len(graph.received["/truck/imu"]) == still + index, "one sample more")
    assert graph.call("/yawdamp_sim/pause", SetBool, SetBool.Request(data=False)).success
    until(lambda: len(graph.received["/truck/imu"]) > still + 20, "more samples")
    assert len(graph.received["/clock"]) > clock + 3
    status, _, errors = stop(process)
    assert status == 0, errors
    assert np.diff(stamps(graph.messages("/truck/imu"))).tolist() == [PERIOD] * (
        len(graph.received["/truck/imu"]) - 1
    )


def test_a_reset_returns_the_truck_to_rest_and_time_goes_on(graph: Graph) -> None:
    graph.listen({"/truck/odom": Odometry})
    process = graph.command("sim", "--manoeuvre", "step", "--start", "0")
    until(lambda: len(graph.received["/truck/odom"]) > 100, "a second of samples")
    assert graph.call("/yawdamp_sim/reset", Trigger, Trigger.Request()).success
    until(lambda: graph.messages("/truck/odom")[-1].pose.pose.position.x < 5.0, "the truck at the origin")
    assert stop(process)[0] == 0
    run = recorded(run_directory(graph.directory))
    ((reset, _),) = run["/reset"]
    after = [message for log_time, message in run["/truck/odom"] if log_time >= reset]
    assert after[0].pose.pose.position.x < 0.25
    assert all(np.diff([log_time for log_time, _ in run["/truck/odom"]]) == PERIOD)


def test_speed_can_change_while_running_and_nothing_else(graph: Graph) -> None:
    graph.listen({"/truck/odom": Odometry})
    process = graph.command("sim")
    until(lambda: len(graph.received["/truck/odom"]) > 20, "some samples")
    assert graph.set_parameter("/yawdamp_sim", "speed", 15.0).successful
    until(lambda: graph.messages("/truck/odom")[-1].twist.twist.linear.x == 15.0, "the new speed")
    assert not graph.set_parameter("/yawdamp_sim", "speed", -1.0).successful
    assert not graph.set_parameter("/yawdamp_sim", "speed", 500.0).successful
    assert not graph.set_parameter("/yawdamp_sim", "step_size", 0.01).successful
    assert stop(process)[0] == 0
    speeds = [message.data for _, message in recorded(run_directory(graph.directory))["/speed"]]
    assert speeds == [load_vehicle("interlink").speed, 15.0]
