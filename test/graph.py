"""A real ROS graph: this process on one side, the project's commands on the other."""

import itertools
import os
import signal
import subprocess
import sys
import threading
import time
from collections import defaultdict
from collections.abc import Callable, Sequence
from contextlib import suppress
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from rcl_interfaces.srv import GetParameters, SetParameters, SetParametersAtomically
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.parameter import Parameter, parameter_value_to_python
from rclpy.serialization import deserialize_message
from std_msgs.msg import Float64

PATIENCE = 30.0
"""Seconds after which a process is taken to hang; nothing is expected to come near it."""
SETTLING = 0.3
"""Seconds from one side's finding the other to the reverse: what is sent before is lost."""
_WORKER_DOMAIN = int(os.environ["ROS_DOMAIN_ID"])
_DOMAINS = itertools.cycle(range(_WORKER_DOMAIN - 19, _WORKER_DOMAIN))
"""ROS domains below this worker's: a graph hears neither another one nor a node that has none."""


SLEEPER = """
import rclpy
from sensor_msgs.msg import Imu, JointState
rclpy.init()
node = rclpy.create_node("sleeper")
node.create_subscription(Imu, "truck/imu", lambda _: None, 10)
node.create_subscription(JointState, "joint_states", lambda _: print("heard", flush=True), 10)
rclpy.spin(node)
"""
"""A program that reads outputs and says so once it does, to be stopped by SIGSTOP."""


def until(condition: Callable[[], bool], what: str) -> None:
    """Wait for a condition; fail, naming it, if it does not come."""
    deadline = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < deadline, f"waited in vain for {what}"
        time.sleep(0.01)


class Graph:
    """A node of this process on a domain of its own, and the commands it starts there."""

    def __init__(self, directory: Path) -> None:
        self.directory = directory
        self.received: dict[str, list[bytes]] = defaultdict(list)
        self.lost: dict[str, int] = defaultdict(int)
        """Messages by topic that DDS says it lost: a reader without a processor for 0.3 s loses some."""
        self._types: dict[str, type] = {}
        self._clients: dict[str, Any] = {}
        self._processes: list[subprocess.Popen[str]] = []
        self._waited_for = 0
        self._domain = next(_DOMAINS)
        self.environment = {
            **os.environ,
            "ROS_DOMAIN_ID": str(self._domain),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        }
        os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
        self._context = rclpy.Context()
        self._context.init(domain_id=self._domain)
        self.node = rclpy.create_node("observer", context=self._context)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self.node)
        self._thread = threading.Thread(target=self._spin, daemon=True)
        self._thread.start()

    def command(self, *arguments: str, under: Sequence[str] = ()) -> subprocess.Popen[str]:
        """Start a command of the project, or one that executes it; its output is kept for `outcome`."""
        process = subprocess.Popen(
            [*under, sys.executable, "-m", "yawdamp_ros", *arguments],
            cwd=self.directory,
            env=self.environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        self._processes.append(process)
        return process

    def script(self, text: str) -> subprocess.Popen[str]:
        """Start a node of another kind, as a Python program; the caller ends it."""
        return subprocess.Popen(
            [sys.executable, "-c", text], env=self.environment, stdout=subprocess.PIPE, text=True
        )

    def listen(self, topics: dict[str, type]) -> None:
        """Keep every message of some topics, as it came."""
        for topic, kind in topics.items():
            self._types[topic] = kind

            def lose(status: Any, topic: str = topic) -> None:  # noqa: ANN401 - a generated status
                self.lost[topic] = status.total_count

            self.node.create_subscription(
                kind,
                topic,
                self.received[topic].append,
                1000,
                event_callbacks=SubscriptionEventCallbacks(message_lost=lose),
                raw=True,
            )

    def messages(self, topic: str) -> list[Any]:
        """Messages of a topic so far; all there are, once the commands have ended."""
        if all(process.poll() is not None for process in self._processes):
            self._have_what_is_on_its_way(len(self._processes))
        return [deserialize_message(data, self._types[topic]) for data in self.received[topic]]

    def publisher(self, kind: type, topic: str) -> Any:  # noqa: ANN401 - rclpy's Publisher
        """A publisher that somebody listens to."""
        publisher = self.node.create_publisher(kind, topic, 10)
        until(lambda: publisher.get_subscription_count() > 0, f"a subscriber of {topic}")
        time.sleep(SETTLING)
        return publisher

    def steering_publisher(self, topic: str = "/steering") -> Any:  # noqa: ANN401
        """A publisher of steering commands that somebody listens to."""
        return self.publisher(Float64, topic)

    def statuses(self) -> Callable[[str], Any]:
        """The newest diagnostics, part by part; an empty status before the first."""
        newest: dict[str, Any] = {}

        def keep(array: DiagnosticArray) -> None:
            newest.update({status.name.partition(": ")[2]: status for status in array.status})

        self.node.create_subscription(DiagnosticArray, "/diagnostics", keep, 10)
        until(lambda: bool(newest), "diagnostics")
        return lambda part: newest[part]

    def installed(self, package: str) -> bool:
        """Whether a package's Python modules can be imported."""
        return find_spec(package) is not None

    def publishers(self, topic: str) -> int:
        """How many publishers a topic has."""
        return int(self.node.count_publishers(topic))

    def call(self, service: str, kind: Any, request: Any) -> Any:  # noqa: ANN401 - generated messages
        """Call a service and return its answer."""
        if service not in self._clients:
            self._clients[service] = self.node.create_client(kind, service)
            until(self._clients[service].service_is_ready, service)
            time.sleep(SETTLING)
        future = self._clients[service].call_async(request)
        until(future.done, f"an answer of {service}")
        return future.result()

    def set_parameter(self, node: str, name: str, value: float) -> Any:  # noqa: ANN401 - a generated message
        """Set a parameter of a node and return what it says."""
        request = SetParameters.Request(parameters=[Parameter(name, value=value).to_parameter_msg()])
        return self.call(f"{node}/set_parameters", SetParameters, request).results[0]

    def set_parameters_atomically(self, node: str, values: dict[str, Any]) -> Any:  # noqa: ANN401
        """Set parameters of a node together and return what it says."""
        parameters = [Parameter(name, value=value).to_parameter_msg() for name, value in values.items()]
        request = SetParametersAtomically.Request(parameters=parameters)
        return self.call(f"{node}/set_parameters_atomically", SetParametersAtomically, request).result

    def parameter(self, node: str, name: str) -> Any:  # noqa: ANN401
        """Value of a parameter of a node."""
        request = GetParameters.Request(names=[name])
        (value,) = self.call(f"{node}/get_parameters", GetParameters, request).values
        return parameter_value_to_python(value)

    def close(self) -> None:
        """Leave the graph; nothing that was started stays behind."""
        for process in self._processes:
            if process.poll() is None:
                process.kill()
            process.communicate()
        self._executor.shutdown()
        self._context.try_shutdown()
        self._thread.join()
        self.node.destroy_node()

    def _have_what_is_on_its_way(self, of: int) -> None:
        before = -1
        while self._waited_for < of and (count := sum(map(len, self.received.values()))) > before:
            before = count
            time.sleep(SETTLING)
        self._waited_for = of

    def _spin(self) -> None:
        with suppress(ExternalShutdownException):
            self._executor.spin()


def outcome(process: subprocess.Popen[str]) -> tuple[int, str, str]:
    """Exit status, standard output and standard error of a command, once it has ended."""
    output, errors = process.communicate(timeout=PATIENCE)
    return process.returncode, output, errors


def stop(process: subprocess.Popen[str], number: int = signal.SIGINT) -> tuple[int, str, str]:
    """Send a signal to a command and return its `outcome`."""
    process.send_signal(number)
    return outcome(process)


def has_handler(process: subprocess.Popen[str], number: int) -> bool:
    """Whether a process has installed a handler of its own for a signal."""
    for line in Path(f"/proc/{process.pid}/status").read_text().splitlines():
        if line.startswith("SigCgt:"):
            return bool(int(line.split()[1], 16) >> (number - 1) & 1)
    return False


def values(status: Any) -> dict[str, str]:  # noqa: ANN401 - a generated message
    """Values of a diagnostic status by key."""
    return {value.key: value.value for value in status.values}


def state(status: Any, key: str = "state") -> str:  # noqa: ANN401 - a generated message
    """State of a diagnostic status, or another of its keys; empty before the first."""
    return values(status).get(key, "")


def stamps(messages: Sequence[Any]) -> list[int]:
    """Stamps of messages in ns."""
    return [message.header.stamp.sec * 10**9 + message.header.stamp.nanosec for message in messages]
