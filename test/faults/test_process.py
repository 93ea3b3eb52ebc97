import random
import signal
import subprocess
import sys
import time
from typing import Any

import numpy as np
import pytest
from sensor_msgs.msg import Imu

from graph import Graph, outcome, stamps, stop, until, values
from runs import PERIOD, recorded, run_directory, simulated_times
from yawdamp_ros.cli import run
from yawdamp_ros.logs import McapLog, MessageDecoder

pytestmark = pytest.mark.graph

SHUT_DOWN_UNDERNEATH = """
import pathlib, sys, threading, time, rclpy
from yawdamp_ros.cli import run

def shut_down():
    while not list(pathlib.Path("runs").glob("*/*.mcap")):
        time.sleep(0.01)
    time.sleep(1.0)
    rclpy.shutdown()

threading.Thread(target=shut_down, daemon=True).start()
sys.exit(run(["sim", "--manoeuvre", "sine"]))
"""


def more_samples(graph: Graph, count: int) -> None:
    before = len(graph.received["/truck/imu"])
    until(lambda: len(graph.received["/truck/imu"]) >= before + count, f"{count} samples more")


def test_a_kill_loses_at_most_a_second(graph: Graph) -> None:
    moments = random.Random(9)  # noqa: S311 - any moments will do, the same ones each time
    names = [f"at_{index}" for index in range(8)]
    graph.listen({f"/{name}/truck/imu": Imu for name in names})
    losses = []
    for batch in range(0, 8, 2):
        processes = {
            name: graph.command("sim", "--output", name, "--ros-args", "-r", f"__ns:=/{name}")
            for name in names[batch : batch + 2]
        }
        for name, process in processes.items():
            until(lambda name=name: len(graph.received[f"/{name}/truck/imu"]) > 0, "a sample")
            time.sleep(moments.uniform(0.0, 0.6))
            process.kill()
            process.communicate()
            time.sleep(0.1)  # what was under way arrives
            seen = stamps(graph.messages(f"/{name}/truck/imu"))
            log, decode = McapLog(graph.directory / name), MessageDecoder()
            kept = [decode(one) for one in log.messages() if one.topic.endswith("/truck/imu")]
            losses.append((seen[-1] - (stamps(kept) or seen)[-1]) / 1e9)
    assert len(losses) == 8
    assert max(losses) <= 1.0


def test_whatever_signals_come_while_it_ends_it_ends_in_good_order(graph: Graph) -> None:
    moments = random.Random(3)  # noqa: S311
    graph.listen({"/truck/imu": Imu})
    for index in range(2):
        process = graph.command("sim", "--output", str(index))
        graph.received["/truck/imu"].clear()
        more_samples(graph, 20)
        for number in moments.choices([signal.SIGINT, signal.SIGTERM, signal.SIGHUP], k=10):
            process.send_signal(number)
            time.sleep(moments.uniform(0.0, 0.02))
        status, _, errors = outcome(process)
        assert status == 0, errors
        assert "Traceback" not in errors
        assert run(["resimulate", str(graph.directory / str(index))]) == 0


def test_three_seconds_of_standstill_are_dropped_and_counted_and_not_made_up_for_in_a_burst(
    graph: Graph,
) -> None:
    graph.listen({"/truck/imu": Imu})
    process = graph.command("sim")
    statuses = graph.statuses()
    more_samples(graph, 20)
    process.send_signal(signal.SIGSTOP)
    time.sleep(3.0)
    process.send_signal(signal.SIGCONT)

    def dropped() -> int:
        return int(values(statuses("timing"))["steps_dropped"])

    # All but the 0.1 s that are made up for, and the sample that was under way.
    until(lambda: dropped() >= 2890, "the count of steps")
    more_samples(graph, 20)
    status, output, errors = stop(process)
    assert status == 0
    assert "late by more than can be caught up" in errors
    assert "steps dropped" in output
    found = simulated_times(run_directory(graph.directory))
    assert np.diff(found).tolist() == [PERIOD] * (len(found) - 1)


def test_a_context_shut_down_underneath_is_said_and_the_recording_finished(graph: Graph) -> None:
    done: Any = subprocess.run(
        [sys.executable, "-c", SHUT_DOWN_UNDERNEATH],
        cwd=graph.directory,
        env=graph.environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1
    assert "the ROS context was shut down underneath the node" in done.stderr
    assert "Traceback" not in done.stderr
    assert "run: runs/" in done.stdout
    assert len(recorded(run_directory(graph.directory))["/truck/imu"]) > 20
    assert run(["resimulate", str(run_directory(graph.directory))]) == 0
