"""The simulator node beside a bare one: processor time, rate, latency, start."""

import math
import random
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import psutil
import rclpy
from rclpy.executors import SingleThreadedExecutor
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64

BARE = [sys.executable, str(Path(__file__).with_name("bare_node.py"))]
SIM = [sys.executable, "-m", "yawdamp_ros", "sim"]
RATES = [round(200.0 * 1.05**power) * 1.0 for power in range(72)]
"""In Hz, 200 to 6400."""
RATE_SECONDS = 10
WARM_UP = 0.5
"""Steer angle in rad that is not among those measured."""
SETTLING = 2.0
"""Seconds until a node that has started is as it will be."""


@contextmanager
def running(command: Sequence[str], directory: Path) -> Iterator[subprocess.Popen[str]]:
    """A node, ended by SIGINT, and killed where its middleware hangs at the end."""
    process = subprocess.Popen(  # noqa: S603 - this package's own commands
        command, cwd=directory, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    try:
        yield process
    finally:
        if process.poll() is None:
            process.send_signal(signal.SIGINT)
        try:
            process.wait(timeout=30)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


class Peer:
    """A node of this process, spinning in a thread."""

    def __init__(self) -> None:
        rclpy.init()
        self.node = rclpy.create_node("peer")
        self._executor = SingleThreadedExecutor()
        self._executor.add_node(self.node)
        threading.Thread(target=self._executor.spin, daemon=True).start()

    @contextmanager
    def steering(self, rate: float) -> Iterator[None]:
        """Steering that arrives at a rate in Hz."""
        publisher = self.node.create_publisher(Float64, "steering", 10)
        clock = time.monotonic
        timer = self.node.create_timer(
            1.0 / rate, lambda: publisher.publish(Float64(data=0.02 * (clock() % 1.0)))
        )
        try:
            yield
        finally:
            self.node.destroy_timer(timer)
            self.node.destroy_publisher(publisher)


def processor_time(peer: Peer, command: Sequence[str], directory: Path, seconds: float = 10.0) -> float:
    """Share of a core that a node takes while steering arrives at 100 Hz."""
    with running(command, directory) as process, peer.steering(100.0):
        time.sleep(SETTLING)
        probe = psutil.Process(process.pid)
        before, begin = probe.cpu_times(), time.monotonic()
        time.sleep(seconds)
        after, end = probe.cpu_times(), time.monotonic()
    return (after.user + after.system - before.user - before.system) / (end - begin)


def bare_keeps_up(rate: float, directory: Path) -> bool:
    """Return whether the bare node fires at every period over ten seconds."""
    with running([*BARE, str(rate)], directory) as process:
        time.sleep(SETTLING + RATE_SECONDS)
    output, _ = process.communicate()
    return output.strip() == "0"


def sim_keeps_up(rate: float, directory: Path) -> bool:
    """Return whether the simulator drops no step over ten seconds."""
    options = ["--publish-rate", str(rate), "--step-size", str(1.0 / rate), "--duration", str(RATE_SECONDS)]
    command = [*SIM, "--no-record", *options]
    done = subprocess.run(command, cwd=directory, capture_output=True, text=True, check=True)  # noqa: S603
    return "steps dropped" not in done.stdout


def highest_rate(keeps_up: Callable[[float, Path], bool], directory: Path) -> float:
    """Highest rate in Hz, of some that are 5 % apart, that a node keeps up with.

    It may try twice: a tenth of a second that the machine takes for itself is not the node's limit.
    """
    low, high = 0, len(RATES)
    while high - low > 1:
        middle = (low + high) // 2
        if any(keeps_up(RATES[middle], directory) for _ in range(2)):
            low = middle
        else:
            high = middle
    return RATES[low]


def latencies(peer: Peer, directory: Path, commands: int = 1000) -> list[float]:
    """Time in s from a steering message to the first output that shows it, at 100 Hz."""
    moments = random.Random(0)  # noqa: S311 - any moments will do
    arrived: dict[float, float] = {}

    def keep(message: JointState) -> None:
        arrived.setdefault(message.position[0], time.perf_counter())

    subscription = peer.node.create_subscription(JointState, "joint_states", keep, 10)
    publisher = peer.node.create_publisher(Float64, "steering", 10)
    sent: dict[float, float] = {}
    with running(SIM, directory):
        deadline = time.monotonic() + 30.0
        while WARM_UP not in arrived:  # neither side knows when the other has found it
            if time.monotonic() > deadline:
                message = "no output shows any command"
                raise TimeoutError(message)
            publisher.publish(Float64(data=WARM_UP))
            time.sleep(0.05)
        time.sleep(SETTLING)
        for index in range(commands):
            angle = 0.01 + 1e-5 * index
            sent[angle] = time.perf_counter()
            publisher.publish(Float64(data=angle))
            time.sleep(moments.uniform(0.03, 0.06))
    peer.node.destroy_subscription(subscription)
    peer.node.destroy_publisher(publisher)
    # A command that no output showed was waited for in vain.
    return [arrived.get(angle, math.inf) - begin for angle, begin in sent.items()]


def starts(peer: Peer, directory: Path, pairs: int = 50) -> tuple[list[float], list[float]]:
    """Times in s from the command to the first message, of the simulator and of the bare node.

    Fast DDS may lose the answer to what a node announces itself with (its pull request 6204), and the next
    comes after up to 3 s. In a fixed order and rhythm that would hit one of the two more than the other.
    """
    moments = random.Random(0)  # noqa: S311 - any moments will do
    first = threading.Event()
    # One for all of them: what comes and goes is announced to whoever comes later, too.
    subscription = peer.node.create_subscription(JointState, "joint_states", lambda _: first.set(), 10)
    took: tuple[list[float], list[float]] = [], []
    for index in moments.sample((0, 1), k=2 * pairs, counts=(pairs, pairs)):
        time.sleep(moments.uniform(0.2, 0.7))
        first.clear()
        begin = time.perf_counter()
        with running((SIM, [*BARE, "100"])[index], directory):
            if not first.wait(timeout=30):
                message = f"no message of the {('simulator', 'bare node')[index]}"
                raise TimeoutError(message)
            took[index].append(time.perf_counter() - begin)
    peer.node.destroy_subscription(subscription)
    return took


def memory(directory: Path) -> tuple[float, float]:
    """Resident memory in MB of a node that records at 1 kHz, after one minute and after ten."""
    with running([*SIM, "--publish-rate", "1000"], directory) as process:
        probe, found = psutil.Process(process.pid), []
        for seconds in (60.0, 540.0):
            time.sleep(seconds)
            found.append(probe.memory_info().rss / 1e6)
    return found[0], found[1]
