"""Long checks of recorded runs: `make soak`. Each says what it saw."""

import json
import math
import random
import re
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from rosbags.highlevel import AnyReader
from sensor_msgs.msg import Imu

from graph import Graph, has_handler, stamps, until
from yawdamp_ros.logs import McapLog, MessageDecoder

pytestmark = pytest.mark.timeout(3600)

MAKE_SIM = ("sim", "--vehicle", "interlink", "--manoeuvre", "lane_change", "--duration", "15")
SAY = Callable[[str], None]


def verdict(run: Path) -> dict[str, object]:
    command = [sys.executable, "-m", "yawdamp_ros", "resimulate", str(run), "--format", "json"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode in {0, 1}, done.stderr
    found: dict[str, object] = json.loads(done.stdout)
    return found


def test_twenty_runs_under_load_are_bit_identical(graph: Graph, say: SAY) -> None:
    work = "import time\nend = time.monotonic() + 300\nwhile time.monotonic() < end: pass"
    load = [subprocess.Popen([sys.executable, "-c", work]) for _ in range(2)]
    try:
        runs = []
        for batch in range(5):
            names = [f"run_{4 * batch + index}" for index in range(4)]
            processes = [graph.command(*MAKE_SIM, "--output", name) for name in names]
            for process in processes:
                _, errors = process.communicate(timeout=120)
                assert process.returncode == 0, errors
            runs += [graph.directory / name for name in names]
    finally:
        for process in load:
            process.kill()
            process.wait()
    found = [verdict(run) for run in runs]
    identical = sum(bool(one["agrees"] and one["bit_identical"]) for one in found)
    say(f"{identical} of {len(runs)} runs under load bit-identical, {found[0]['values']} values each")
    assert identical == len(runs) == 20


def test_fifty_kills_lose_at_most_a_second_each(graph: Graph, say: SAY) -> None:
    moments = random.Random(50)  # noqa: S311 - any moments will do, the same ones each time
    graph.listen({"/truck/imu": Imu})
    losses = []
    for index in range(50):
        graph.received["/truck/imu"].clear()
        run = graph.directory / f"run_{index}"
        process = graph.command("sim", "--manoeuvre", "chirp", "--output", str(run))
        until(lambda process=process: has_handler(process, 1), "the start")
        time.sleep(moments.uniform(0.3, 4.0))
        process.kill()
        process.communicate()
        time.sleep(0.1)
        seen = stamps(graph.messages("/truck/imu"))
        if not seen:  # killed before anything was published
            continue
        log, decode = McapLog(run), MessageDecoder()
        kept = [decode(message).header.stamp for message in log.messages() if message.topic == "/truck/imu"]
        last_kept = kept[-1].sec * 10**9 + kept[-1].nanosec if kept else seen[0]
        losses.append((seen[-1] - last_kept) / 1e9)
        if kept:
            assert verdict(run)["bit_identical"]
    say(f"{len(losses)} of 50 kills in mid-run: at most {max(losses):.2f} s of samples lost, every file read")
    assert len(losses) > 25
    assert max(losses) <= 1.0


def test_an_hour_of_steering_writes_a_run_in_which_every_message_decodes(tmp_path: Path, say: SAY) -> None:
    log = tmp_path / "hour.csv"
    rows = (f"{index / 100},{0.03 * math.sin(index / 70):.9f}" for index in range(360_001))
    log.write_text("time,steering_angle\n" + "\n".join(rows))
    run = tmp_path / "run"
    began = time.monotonic()
    command = [sys.executable, "-m", "yawdamp_ros", "simulate", "--log", str(log), "--output", str(run)]
    subprocess.run(command, check=True, capture_output=True)
    took = time.monotonic() - began
    with AnyReader([run]) as reader:
        count = 0
        for connection, _, data in reader.messages():
            reader.deserialize(data, connection.msgtype)
            count += 1
        assert count == reader.message_count
    say(f"an hour in {took:.0f} s, {count} messages, every one decodes")
    # 16 outputs, the frames, the steering; then the speed and the fixed frames once.
    assert count == 360_001 * 18 + 2


def test_a_ten_minute_log_does_not_drift(graph: Graph, say: SAY) -> None:
    log = graph.directory / "log.csv"
    rows = (f"{index / 100},{0.03 * math.sin(index / 70):.9f}" for index in range(60_001))
    log.write_text("time,steering_angle\n" + "\n".join(rows))
    node = graph.command("sim", "--no-record")
    replay = graph.command("replay", str(log))
    output, errors = replay.communicate(timeout=700)
    assert replay.returncode == 0, errors
    node.terminate()
    node.communicate()
    last = output.splitlines()[-1]
    say(last)
    (after,) = re.findall(r"the last sample ([\d.]+) ms after its time", last)
    # A drift of a hundredth of a percent would be 60 ms after ten minutes.
    assert float(after) <= 20.0


def test_time_keeps_up_for_a_minute_on_busy_cores_or_says_what_it_lost(graph: Graph, say: SAY) -> None:
    work = "import time\nend = time.monotonic() + 100\nwhile time.monotonic() < end: pass"
    load = [subprocess.Popen([sys.executable, "-c", work]) for _ in range(2)]
    process = graph.command("sim", "--no-record")
    looks: list[tuple[float, float, int]] = []

    def look(array: DiagnosticArray) -> None:
        values = {value.key: value.value for value in array.status[0].values}
        stamp = array.header.stamp.sec + array.header.stamp.nanosec / 1e9
        simulated = float(values["simulated_time"].removesuffix(" s"))
        looks.append((stamp, simulated, int(values["steps_dropped"])))

    graph.node.create_subscription(DiagnosticArray, "/diagnostics", look, 10)
    try:
        deadline = time.monotonic() + 90.0
        while len(looks) < 61 and time.monotonic() < deadline:
            time.sleep(0.1)
    finally:
        for busy in load:
            busy.kill()
            busy.wait()
    process.terminate()
    process.communicate()
    first = looks[0]
    # Simulated time and what was dropped make up the time that went by, but for the sample under way.
    behind = [
        (stamp - first[0]) - (simulated - first[1]) - 0.001 * (dropped - first[2])
        for stamp, simulated, dropped in looks[1:]
    ]
    say(
        f"{len(looks) - 1} s on busy cores: {looks[-1][2]} steps dropped; "
        f"beyond them {1e3 * min(behind):.1f} to {1e3 * max(behind):.1f} ms behind, one sample being 10 ms"
    )
    # Nothing is lost for good without being counted: more than 0.1 s would have been dropped.
    assert looks[-1][0] - looks[0][0] >= 55.0
    assert len(looks) > 55
    assert sum(abs(value) <= 0.011 for value in behind) > len(behind) // 2
    assert max(behind) <= 0.2
