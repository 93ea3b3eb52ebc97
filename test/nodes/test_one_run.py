"""The node and `simulate` are one run: what one recorded the other repeats, offline and bit for bit."""

import math
import time
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest
from sensor_msgs.msg import Imu
from std_msgs.msg import Float64

from graph import Graph, stop
from runs import UNITS, recorded, run_directory
from yawdamp_ros.cli import run

pytestmark = pytest.mark.graph

LAGGING = {"steering_ratio": 16.0, "steering_time_constant": 0.1, "max_steering_angle": 0.03}


def offline(path: Path, output: Path, *options: str) -> npt.NDArray[np.float64]:
    """Table of `simulate` under the steering of a recording, a row a step."""
    assert run(["simulate", "--log", str(path), "--output", str(output), *options]) == 0
    return np.genfromtxt(output, delimiter=",", names=True, deletechars="")


def test_offline_repeats_what_the_node_applied_and_what_it_was_commanded(
    graph: Graph, tmp_path: Path
) -> None:
    graph.listen({"/truck/imu": Imu})
    # With a clock of its own its stamps are those of the steps, however late it is.
    asked = LAGGING | {"publish_clock": "true"}
    parameters = [word for name, value in asked.items() for word in ("-p", f"{name}:={value}")]
    process = graph.command("sim", "--ros-args", *parameters)
    publisher = graph.steering_publisher()
    for index in range(150):
        publisher.publish(Float64(data=0.8 * math.sin(0.05 * index)))
        time.sleep(0.01)
    assert stop(process)[0] == 0
    path = run_directory(graph.directory)
    messages = recorded(path)
    stamps, applied = zip(*messages["/steering_applied"], strict=True)
    steps = (np.array(stamps) - stamps[0]) // 1_000_000
    values = np.array([message.data for message in applied])
    # What was applied gives the same motion, every value of it.
    table = offline(path, tmp_path / "applied.csv", "--topic", "/steering_applied")
    for unit in UNITS:
        for quantity in ("yaw", "yaw_rate", "lateral_acceleration"):
            online = [message.data for _, message in messages[f"/{unit}/{quantity}"]]
            every_tenth = table[f"{unit}/{quantity}"][::10]
            count = min(len(online), len(every_tenth))
            assert count > 50
            np.testing.assert_array_equal(every_tenth[:count], online[:count])
    # The commands as received are clamped, divided and lagged again, to the same applied angles.
    assert max(abs(message.data) for _, message in messages["/steering"]) > 0.7
    options = [f"--{name.replace('_', '-')}={value}" for name, value in LAGGING.items()]
    again = offline(path, tmp_path / "commands.csv", *options)["steering_angle"]
    # A log begins with its first command, before which the wheels are straight.
    first = (messages["/steering"][0][0] - stamps[0]) // 1_000_000
    by_step = values[np.searchsorted(steps, np.arange(first, first + len(again)), side="right") - 1]
    assert np.abs(again).max() > 0.02
    np.testing.assert_array_equal(again, by_step)
