"""Long checks of faults: `make soak`. Each says what it saw."""

import random
import re
import signal
import time
from collections import Counter
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import psutil
import pytest
from diagnostic_msgs.msg import DiagnosticArray
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import Imu
from std_srvs.srv import SetBool

from graph import SLEEPER, Graph, has_handler, outcome, stamps, stop, until, values
from runs import run_directory
from yawdamp_ros.cli import run
from yawdamp_ros.logs import McapLog, MessageDecoder

pytestmark = pytest.mark.timeout(3600)

FLOOD = """
import time, rclpy
from std_msgs.msg import Float64
rclpy.init()
node = rclpy.create_node("flood")
publisher = node.create_publisher(Float64, "steering", 10)
start = time.monotonic()
for index in range(500_000):
    publisher.publish(Float64(data=1e-7 * index))
    time.sleep(max(start + index / 10_000 - time.monotonic(), 0.0))
print(round(500_000 / (time.monotonic() - start)))
"""
CROWD = """
import rclpy, time
from sensor_msgs.msg import Imu
from std_msgs.msg import Float64
rclpy.init()
for index in range(100):
    node = rclpy.create_node(f"passer_by_{index}")
    node.create_publisher(Float64, "speed", 10)
    node.create_subscription(Imu, "truck/imu", lambda _: None, 10)
    rclpy.spin_once(node, timeout_sec=0.2)
    node.destroy_node()
"""

SAY = Callable[[str], None]
SIGNALS = (signal.SIGKILL, signal.SIGTERM, signal.SIGINT, signal.SIGHUP)
DAY = 86_400


def signalled(graph: Graph, lane: int, index: int) -> tuple[signal.Signals, int, float | None]:
    """A node ended by a signal: its status, and the seconds of samples lost, if any had come."""
    moments = random.Random(index)  # noqa: S311 - any moments will do, the same ones each time
    number, phase = SIGNALS[index % 4], index // 4 % 3
    received = graph.received[f"/lane_{lane}/truck/imu"]
    received.clear()
    path = graph.directory / f"run_{index}"
    arguments = ["--manoeuvre", "chirp", "--output", str(path), "--ros-args", "-r", f"__ns:=/lane_{lane}"]
    process = graph.command("sim", *arguments)
    until(lambda: has_handler(process, signal.SIGHUP), "the handlers")
    if phase == 0:
        time.sleep(moments.uniform(0.0, 1.5))
    else:
        until(lambda: bool(received), "a sample")
        time.sleep(moments.uniform(0.0, 2.0))
    if phase == 2:
        process.send_signal(signal.SIGTERM)
        time.sleep(moments.uniform(0.0, 0.3))
    process.send_signal(number)
    status, _, errors = outcome(process)
    assert "Traceback" not in errors, (index, errors)
    expected = {-signal.SIGKILL, 0} if number == signal.SIGKILL else {0}
    # When all is done, the interpreter has its own way with signals again.
    assert status in (expected | {-number, 130} if phase == 2 else expected), (index, status, errors)
    time.sleep(0.2)  # what was under way arrives
    seen = stamps([deserialize_message(data, Imu) for data in received])
    if not seen:
        return number, status, None
    decode = MessageDecoder()
    kept = stamps([decode(one) for one in McapLog(path).messages() if one.topic.endswith("/truck/imu")])
    return number, status, max(seen[-1] - (kept or seen)[-1], 0) / 1e9


def test_two_hundred_signals_during_start_run_and_shutdown(graph: Graph, say: SAY) -> None:
    graph.listen({f"/lane_{lane}/truck/imu": Imu for lane in range(4)})

    def drive(lane: int) -> list[tuple[signal.Signals, int, float | None]]:
        return [signalled(graph, lane, index) for index in range(lane * 50, lane * 50 + 50)]

    with ThreadPoolExecutor(4) as lanes:
        found = [one for results in lanes.map(drive, range(4)) for one in results]
    ended = Counter(f"{number.name} {status}" for number, status, _ in found)
    killed = [loss for number, _, loss in found if loss is not None and number == signal.SIGKILL]
    asked = [loss for number, _, loss in found if loss is not None and number != signal.SIGKILL]
    how_often = ", ".join(f"{how}: {count}" for how, count in sorted(ended.items()))
    say(
        f"200 signals ({how_often}); of the nodes that had published, {len(killed)} killed ones "
        f"lost at most {max(killed):.2f} s of samples, {len(asked)} others {max(asked):.2f} s"
    )
    assert len(found) == 200
    assert len(killed) > 25
    assert max(killed) <= 1.0
    assert max(asked) == 0.0


def test_a_day_at_full_speed_neither_grows_nor_drifts(graph: Graph, say: SAY) -> None:
    graph.listen({"/truck/imu": Imu})
    parameters = {"real_time_factor": "0.0", "publish_rate": "1.0", "step_size": "0.01"}
    arguments = [word for name, value in parameters.items() for word in ("-p", f"{name}:={value}")]
    began = time.monotonic()
    process = graph.command("sim", "--manoeuvre", "sine", "--duration", str(DAY), "--ros-args", *arguments)
    # An MCAP file's index grows with the file; what the recording has to say is when the run began.
    assert graph.call("/yawdamp_sim/record", SetBool, SetBool.Request(data=False)).success
    log = McapLog(run_directory(graph.directory))
    assert list(log.messages())
    start = int(log.metadata["yawdamp_ros"]["start_time_ns"])

    def simulated() -> float:
        newest = deserialize_message(graph.received["/truck/imu"][-1], Imu)
        return (stamps([newest])[0] - start) / 1e9

    memory = []
    for tenth in range(1, 10):
        until(lambda tenth=tenth: simulated() >= tenth * DAY / 10, f"{tenth} tenths of a day")
        memory.append(psutil.Process(process.pid).memory_info().rss / 2**20)
    status, output, errors = outcome(process)
    assert status == 0, errors
    until(lambda: simulated() >= DAY, "the last sample")
    say(
        f"a day in {time.monotonic() - began:.0f} s, its last sample {simulated():.9f} s after its start; "
        f"{memory[0]:.1f} MB after a tenth, {memory[-1]:.1f} MB after nine"
    )
    assert stamps(graph.messages("/truck/imu"))[-1] == start + DAY * 10**9
    assert memory[-1] <= memory[0] + 5.0
    assert "steps dropped" not in output


def test_a_minute_in_bad_company_keeps_the_rate_or_counts_the_loss(graph: Graph, say: SAY) -> None:
    process = graph.command("sim")
    sleepers = [graph.script(SLEEPER) for _ in range(3)]
    for sleeper in sleepers:
        assert sleeper.stdout is not None
        assert sleeper.stdout.readline() == "heard\n"
        sleeper.send_signal(signal.SIGSTOP)
    graph.listen({"/diagnostics": DiagnosticArray})
    company = [graph.script(FLOOD), graph.script(CROWD)]
    until(lambda: len(graph.received["/diagnostics"]) > 25, "half a minute")
    until(lambda: len(graph.received["/diagnostics"]) > 50, "the other half")
    sent, _ = company[0].communicate()
    company[1].communicate()
    for sleeper in sleepers:
        sleeper.kill()
        sleeper.communicate()
    status, _, errors = stop(process)
    assert status == 0, errors
    looks = graph.messages("/diagnostics")
    at = [look.header.stamp.sec + look.header.stamp.nanosec / 1e9 for look in looks]
    found = [values(look.status[0]) for look in looks]
    time_passed = [float(one["simulated_time"].removesuffix(" s")) for one in found]
    dropped = [int(one["steps_dropped"]) for one in found]
    behind = [
        (at[index] - at[0]) - (time_passed[index] - time_passed[0]) - 0.001 * (dropped[index] - dropped[0])
        for index in range(len(looks))
    ]
    worst = max(float(one["worst_lateness"].removesuffix(" ms")) for one in found)
    say(
        f"{at[-1] - at[0]:.0f} s with commands at {sent.strip()} Hz, 3 stopped readers and 100 passing nodes"
        f": {dropped[-1]} steps dropped, worst lateness {worst:.1f} ms, "
        f"beyond that at most {1e3 * max(behind):.1f} ms behind"
    )
    assert at[-1] - at[0] >= 45.0
    # Neither behind what is counted, nor ahead of real time.
    assert max(behind) <= 0.2
    assert min(behind) >= -0.2
    assert run(["resimulate", str(run_directory(graph.directory))]) == 0


def test_twenty_disks_that_fill_account_for_every_message(graph: Graph, say: SAY) -> None:
    sizes = random.Random(20)  # noqa: S311
    most = 0
    for index in range(20):
        path = graph.directory / f"run_{index}"
        limit = str(sizes.randint(20_000, 400_000))
        process = graph.command(
            "sim",
            "--manoeuvre",
            "chirp",
            "--duration",
            "5",
            "--output",
            str(path),
            under=["prlimit", f"--fsize={limit}"],
        )
        status, _, errors = outcome(process)
        assert status == 1, errors
        lost = int(re.findall(r"(\d+) messages not recorded", errors)[-1])
        log = McapLog(path)
        kept = [message.topic for message in log.messages()].count("/truck/imu")
        missing = 17 * (501 - kept)
        # Besides the outputs the speed, and the steering, which a chirp changes at every step.
        assert missing <= lost <= 17 * 501 + 2 + 5001, (limit, errors)
        most = max(most, lost - missing)
    say(
        f"20 full disks: every output is in the file or counted; of those counted up to {most} are there, too"
    )
