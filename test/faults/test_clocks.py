import math
import shutil
import struct
import subprocess
import time
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticArray
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import Float64, Header
from std_srvs.srv import Trigger

from graph import Graph, stamps, stop, until, values
from runs import PERIOD, run_directory, simulated_times
from yawdamp_ros.cli import run

pytestmark = pytest.mark.graph

HOUR = 3600 * 10**9


def more_samples(graph: Graph, count: int) -> None:
    before = len(graph.received["/truck/imu"])
    until(lambda: len(graph.received["/truck/imu"]) >= before + count, f"{count} samples more")


class SystemClock:
    """The system clock as one process sees it: it can jump without disturbing any other."""

    def __init__(self, directory: Path) -> None:
        compiler = shutil.which("cc")
        if compiler is None:
            pytest.skip("there is no C compiler for a clock that can jump")
        library, self._file = directory / "system_clock.so", directory / "clock"
        source = Path(__file__).with_name("system_clock.c")
        subprocess.run([compiler, "-shared", "-fPIC", "-o", library, source, "-ldl"], check=True)
        self._file.write_bytes(bytes(8))
        self.offset = 0
        self.environment = {"LD_PRELOAD": str(library), "SYSTEM_CLOCK_FILE": str(self._file)}

    def jump(self, hours: int) -> None:
        """Let it be off by some hours from now on."""
        self.offset = hours * HOUR
        with self._file.open("r+b") as file:
            file.write(struct.pack("@q", 3600 * hours))

    def is_seen(self, graph: Graph) -> bool:
        """Whether the node's newest diagnostics are stamped by the clock as it is now."""
        found = stamps(graph.messages("/diagnostics"))
        return bool(found) and abs(found[-1] - self.offset - time.time_ns()) < HOUR // 2


def joint_state(angle: float, stamp: int) -> JointState:
    header = Header(stamp=Time(sec=stamp // 10**9, nanosec=stamp % 10**9))
    return JointState(header=header, name=["steering"], position=[angle])


def started(graph: Graph, *parameters: str) -> Any:  # noqa: ANN401 - a process
    graph.listen({"/truck/imu": Imu, "/joint_states": JointState})
    arguments = [word for parameter in parameters for word in ("-p", parameter)]
    process = graph.command("sim", "--ros-args", *arguments)
    more_samples(graph, 20)
    return process


def ended(graph: Graph, process: Any) -> str:  # noqa: ANN401
    """What a node has said that was asked to end, once its recording is finished.

    After a jump, Fast DDS may crash or hang when it takes down its shared memory, the last that is done.
    """
    process.terminate()
    metadata = run_directory(graph.directory) / "metadata.yaml"
    until(metadata.is_file, "the end of the recording")
    with suppress(subprocess.TimeoutExpired):
        process.wait(10.0)
    process.kill()
    return str(process.communicate()[1])


def test_jumps_of_the_system_clock_move_stamps_and_neither_time_nor_rate(graph: Graph) -> None:
    clock = SystemClock(graph.directory)
    graph.environment |= clock.environment
    graph.listen({"/diagnostics": DiagnosticArray})
    process = started(graph, "steering_type:=sensor_msgs/msg/JointState")
    statuses = graph.statuses()
    publisher = graph.publisher(JointState, "/steering")

    def steered(angle: float) -> bool:
        publisher.publish(joint_state(angle, time.time_ns() + clock.offset))
        return bool(graph.messages("/joint_states")[-1].position[0] == angle)

    def newest() -> int:
        return stamps(graph.messages("/truck/imu"))[-1]

    def refused() -> int:
        return int(values(statuses("steering"))["rejected_stale"])

    for index, hours in enumerate((1, -1), 1):
        clock.jump(hours)
        until(lambda: abs(newest() - time.time_ns() - clock.offset) < HOUR // 2, "stamps that follow")
        until(lambda: clock.is_seen(graph), "the jump, in the stamps of diagnostics")
        # A command is held against the clock as it is now; one by the clock as it was is not of now.
        until(lambda index=index: steered(0.01 * index), "the command")
        before = refused()
        publisher.publish(joint_state(0.5, time.time_ns() + clock.offset + HOUR))
        until(lambda before=before: refused() > before, "the refusal, in diagnostics that go on")
        assert graph.call("/yawdamp_sim/reset", Trigger, Trigger.Request()).success
    ended(graph, process)
    path = run_directory(graph.directory)
    found = simulated_times(path)
    assert np.diff(found).tolist() == [PERIOD] * (len(found) - 1)
    assert run(["resimulate", str(path)]) == 0


def test_jumps_back_of_the_system_clock_hold_nothing_up_and_silence_nothing(graph: Graph) -> None:
    clock = SystemClock(graph.directory)
    graph.environment |= clock.environment
    process = started(graph, "longitudinal_source:=speed")
    publisher = graph.publisher(Float64, "/speed")
    statuses = graph.statuses()

    def refuse(count: int) -> None:
        publisher.publish(Float64(data=math.nan))
        until(lambda: values(statuses("inputs")).get("speed_rejected_not_finite") == str(count), "a refusal")

    refuse(1)
    for hours in range(1, 11):
        clock.jump(-hours)
        more_samples(graph, 20)
    # Without care, a wait by that clock would last until something else happens, seconds or an hour.
    assert int(values(statuses("timing"))["steps_dropped"]) < 1000
    more_samples(graph, 400)  # warnings of one kind are 5 s apart
    refuse(2)
    assert "speed: nan: rejected, not a finite number, 2 so far" in ended(graph, process)


def test_use_sim_time_without_a_clock_is_warned_of_and_changes_nothing(graph: Graph) -> None:
    process = started(graph, "use_sim_time:=true")
    statuses = graph.statuses()
    until(lambda: values(statuses("timing"))["state"] == "in_time", "diagnostics")
    assert values(statuses("timing"))["wanted_rate"] == "100.00 Hz"
    assert graph.call("/yawdamp_sim/reset", Trigger, Trigger.Request()).success
    graph.steering_publisher().publish(Float64(data=0.1))
    until(lambda: graph.messages("/joint_states")[-1].position[0] == 0.1, "the command")
    status, _, errors = stop(process)
    assert status == 0
    assert "use_sim_time: not followed" in errors
    assert run(["resimulate", str(run_directory(graph.directory))]) == 0
