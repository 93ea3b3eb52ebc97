import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from std_msgs.msg import Float64

from graph import Graph, outcome, stop, until
from runs import OUTPUTS, PERIOD, check_all_came, recorded, run_directory, stepped_again
from yawdamp_ros.logs import read_steering_csv

pytestmark = pytest.mark.graph

RAV4 = Path(__file__).parents[3] / "shared" / "data" / "rav4_highway_steering.csv"
COUNT = 400


@pytest.fixture
def log(tmp_path: Path) -> Path:
    """Three seconds at about 130 Hz, unevenly stamped."""
    path = tmp_path / "log.csv"
    rows = [
        f"{0.0075 * index + 0.003 * math.sin(index):.6f},{0.04 * math.sin(0.02 * index):.9f}"
        for index in range(COUNT)
    ]
    path.write_text("\n".join(["time,steering_angle", *rows]), encoding="utf-8")
    return path


def angles(graph: Graph) -> list[float]:
    return [message.data for message in graph.messages("/steering")]


def test_nothing_is_lost_at_the_start_for_replay_waits_for_a_subscriber(graph: Graph, log: Path) -> None:
    process = graph.command("replay", str(log), "--rate", "5")
    until(lambda: graph.publishers("/steering") == 1, "the replay node")
    graph.listen({"/steering": Float64})
    status, output, errors = outcome(process)
    assert (status, errors) == (0, "")
    assert f"{COUNT} samples over 2.9" in output
    until(lambda: len(angles(graph)) == COUNT, "the whole log")
    assert angles(graph) == read_steering_csv(log).angles


def test_a_part_of_a_log_is_scaled_and_played(graph: Graph, tmp_path: Path) -> None:
    path = tmp_path / "wheel.csv"
    path.write_text("t,speed,wheel\n" + "".join(f"{index / 10},20,{index}\n" for index in range(30)))
    graph.listen({"/steering": Float64})
    options = ["--column", "wheel", "--degrees", "--steering-ratio", "10"]
    part = ["--start-offset", "1", "--duration", "0.5"]
    assert outcome(graph.command("replay", str(path), *options, *part))[0] == 0
    expected = [math.radians(angle) / 10 for angle in range(10, 16)]
    until(lambda: len(angles(graph)) == 6, "the part")
    np.testing.assert_allclose(angles(graph), expected)


def test_a_loop_goes_on_until_it_is_stopped(graph: Graph, log: Path) -> None:
    graph.listen({"/steering": Float64})
    process = graph.command("replay", str(log), "--rate", "5", "--loop")
    until(lambda: len(angles(graph)) > 2 * COUNT, "the third round")
    status, _, errors = stop(process)
    assert (status, errors) == (0, "")
    once = read_steering_csv(log).angles
    assert angles(graph)[: 2 * COUNT] == once + once


def test_a_stop_while_waiting_for_a_subscriber_is_in_good_order(graph: Graph, log: Path) -> None:
    process = graph.command("replay", str(log))
    until(lambda: graph.publishers("/steering") == 1, "the replay node")
    status, _, errors = stop(process)
    assert (status, errors) == (0, "")


@pytest.mark.parametrize(
    "arguments, message",
    [
        (["none.csv"], "none.csv: cannot be read: No such file"),
        (["log.csv", "--rate", "0"], "--rate: 0.0: expected a number above 0"),
        (["log.csv", "--column", "x"], "log.csv: x: no such column; expected one of time, steering_angle"),
        (["log.csv", "--start-offset", "9"], "log.csv: no sample between 9 s and inf s"),
        ([], "the following arguments are required: LOG"),
    ],
)
@pytest.mark.usefixtures("log")
def test_wrong_use_is_one_line_and_status_2(graph: Graph, arguments: list[str], message: str) -> None:
    status, output, errors = outcome(graph.command("replay", *arguments))
    assert (status, output) == (2, "")
    assert message in errors
    assert errors.count("\n") == 1


def check_run_of_a_log(graph: Graph, log_angles: list[float]) -> dict[str, list[tuple[int, Any]]]:
    """What must hold of a run that followed a log: nothing missing, nothing but the log applied."""
    run = run_directory(graph.directory)
    messages = recorded(run)
    count = len(messages["/truck/imu"])
    for topic in OUTPUTS:
        times = [log_time for log_time, _ in messages[topic]]
        assert np.diff(times).tolist() == [PERIOD] * (count - 1)
    applied = [message.data for _, message in messages["/steering_applied"]]
    # Of samples between two steps of the node's timer the newest wins, so applied is a part of the log.
    rest = iter([0.0, *log_angles])
    assert all(angle in rest for angle in applied)
    samples = stepped_again(messages["/steering_applied"], count)
    assert [message.data for _, message in messages["/trailer_2/yaw_rate"]] == [
        sample.yaw_rate[2] for sample in samples
    ]
    return messages


def test_a_log_drives_the_node(graph: Graph, log: Path) -> None:
    node = graph.command("sim")
    assert outcome(graph.command("replay", str(log)))[0] == 0
    status, _, errors = stop(node)
    assert status == 0, errors
    messages = check_run_of_a_log(graph, read_steering_csv(log).angles)
    assert len(messages["/steering_applied"]) > 10  # how many depends on how busy the machine is


def commands(run: Path) -> list[float]:
    return [message.data for _, message in recorded(run)["/steering"]]


def test_a_recording_that_is_played_into_the_node_drives_it_as_it_was_driven(graph: Graph, log: Path) -> None:
    runs = [graph.directory / "first", graph.directory / "second"]
    for played, made in zip([log, runs[0]], runs, strict=True):
        node = graph.command("sim", "--output", made.name)
        assert outcome(graph.command("replay", str(played)))[0] == 0
        status, _, errors = stop(node)
        assert status == 0, errors
    first, second = (commands(made) for made in runs)
    # A machine that is busy may lose messages; none comes twice, late, or as another angle.
    rest = iter(first)
    assert all(angle in rest for angle in second)
    assert len(second) > 0.9 * len(first) > 0.8 * COUNT


@pytest.mark.timeout(180)
@pytest.mark.skipif(not RAV4.exists(), reason="the recorded drive is not part of the project")
def test_a_minute_of_real_driving_drives_the_node(graph: Graph) -> None:
    graph.listen(OUTPUTS)
    node = graph.command("sim")
    until(lambda: all(graph.received[topic] for topic in OUTPUTS), "every output")
    replay = graph.command("replay", str(RAV4), "--steering-ratio", "16.88")
    replay.wait(timeout=120)
    assert outcome(replay)[0] == 0
    status, output, errors = stop(node)
    assert status == 0, errors
    # On a machine that is busy with other things, steps may be dropped, but then it is counted.
    dropped = sum(map(int, re.findall(r"(\d+) steps dropped", output))) // 10
    log = read_steering_csv(RAV4).divided(16.88)
    messages = check_run_of_a_log(graph, list(log.angles))
    count = len(messages["/truck/imu"])
    assert count + dropped >= 6000
    for topic in OUTPUTS:
        arrived, lost = graph.messages(topic), graph.lost[topic]
        assert len(arrived) + lost + dropped >= 6000
        if topic.endswith("/yaw_rate"):
            published = [message.data for _, message in messages[topic]]
            check_all_came([message.data for message in arrived], published, lost)


def test_speed_and_acceleration_of_a_drive_are_published_beside_its_steering_and_in_step(
    graph: Graph, tmp_path: Path
) -> None:
    path = tmp_path / "drive.csv"
    path.write_text(
        "time,steering,speed_kmh,acceleration\n"
        + "".join(f"{0.02 * row},{0.001 * row},{36 + row},{0.1 * row}\n" for row in range(50))
    )
    graph.listen({"/steering": Float64, "/speed": Float64, "/acceleration": Float64})
    status, output, errors = outcome(graph.command("replay", str(path)))
    assert (status, errors) == (0, "")
    assert "with 50 speeds of 10.00 to 23.61 m/s, for a node whose longitudinal_source is speed" in output
    assert "with 50 accelerations of 0.00 to 4.90 m/s², for a node whose longitudinal_source is" in output
    until(lambda: len(angles(graph)) == 50, "the whole log")
    speeds = [message.data for message in graph.messages("/speed")]
    np.testing.assert_allclose(speeds, (36.0 + np.arange(50)) / 3.6)
    accelerations = [message.data for message in graph.messages("/acceleration")]
    np.testing.assert_allclose(accelerations, 0.1 * np.arange(50))


def test_what_the_node_made_of_a_drive_simulate_makes_of_its_recording_to_the_last_bit(
    graph: Graph, tmp_path: Path
) -> None:
    path = tmp_path / "drive.csv"
    rows = [f"{0.02 * row},{0.04 * math.sin(0.05 * row)},{15.0 + 0.03 * row}" for row in range(100)]
    path.write_text("\n".join(["time,steering,speed", *rows]), encoding="utf-8")
    process = graph.command("sim", "--ros-args", "-p", "longitudinal_source:=speed")
    until(lambda: graph.publishers("/joint_states") == 1, "the simulator")
    assert outcome(graph.command("replay", str(path)))[0] == 0
    stop(process)
    run = run_directory(tmp_path)
    arguments = ["--log", str(run), "--topic", "/steering_applied", "--output", "again"]
    assert outcome(graph.command("simulate", *arguments))[0] == 0
    made, again = recorded(run), recorded(tmp_path / "again")
    speeds = [message.data for _, message in made["/speed"]]
    assert len(speeds) > 50
    assert speeds[-1] == pytest.approx(15.0 + 0.03 * 99)
    for topic in (topic for topic, kind in OUTPUTS.items() if kind is Float64):
        second = [message.data for _, message in again[topic]]
        first = [message.data for _, message in made[topic]]
        assert len(second) > 150
        assert first[: len(second)] == second
