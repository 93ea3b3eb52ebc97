"""Joining the ROS graph and leaving it in good order."""

import os
import threading
import time
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

import rclpy
from rclpy.duration import Duration
from rclpy.exceptions import ParameterException
from rclpy.executors import SingleThreadedExecutor
from rclpy.logging import LoggingSeverity, get_logger_level, set_logger_level
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.publisher import Publisher
from rclpy.signals import SignalHandlerOptions

from yawdamp_ros.nodes.errors import NodeError
from yawdamp_ros.nodes.parameter_files import check_parameter_file, parameter_files
from yawdamp_ros.nodes.stop_request import StopRequest

HIGHEST_DOMAIN = 232
"""Largest ROS_DOMAIN_ID; above it port numbers end."""

SPIN_PERIOD = 0.05
"""Longest single wait of the executor [s]."""

FAREWELL = 0.25
"""Longest wait for acknowledgement [s]. Data arrives in ms, but Fast DDS acknowledges only every 3 s."""


@contextmanager
def ros_graph(ros_arguments: Sequence[str]) -> Iterator[None]:
    """Initialise rclpy with the arguments after ``--ros-args``, and shut it down in any case.

    Signals stay with `StopRequest`: a context that shuts down under a callback makes it raise.

    Raises
    ------
    NodeError
        If rclpy refuses the arguments, a file among them or a parameter, or cannot start.
    """
    _check_domain(os.environ.get("ROS_DOMAIN_ID", ""))
    for path in parameter_files(ros_arguments):
        check_parameter_file(path)
    set_logger_level("rcl", LoggingSeverity.FATAL)  # a refusal raises, so that it is reported once
    try:
        rclpy.init(args=list(ros_arguments), signal_handler_options=SignalHandlerOptions.NO)
    except Exception as error:  # rclpy raises its own types, RuntimeError and ValueError here
        raise NodeError(_first_line(error)) from error
    finally:
        set_logger_level("rcl", LoggingSeverity.UNSET)
    # rclpy adds this warning if a node cannot be made; the error already says so.
    warnings.filterwarnings("ignore", "Failed to fini", RuntimeWarning)
    try:
        yield
    except ParameterException as error:  # parameters that every node has, lists of another type
        raise NodeError(_first_line(error)) from error
    except RuntimeError as error:
        if not _is_of_rclpy(error):
            raise
        raise NodeError(_first_line(error)) from error
    finally:
        rclpy.try_shutdown()


def _check_domain(given: str) -> None:
    """Refuse a domain without ports: Fast DDS would end the process."""
    if given and not (given.isascii() and given.isdigit() and int(given) <= HIGHEST_DOMAIN):
        message = f"ROS_DOMAIN_ID: {given!r}: expected a number from 0 to {HIGHEST_DOMAIN}"
        raise NodeError(message)


def join(name: str, overrides: Mapping[str, Any]) -> Node:
    """Put a node on the graph, with parameters that win over those of the command line's ``--ros-args``.

    The given parameters are declared, so that `declare_parameters` can find those that nobody else declares.
    """
    parameters = [Parameter(parameter, value=value) for parameter, value in overrides.items()]
    level = get_logger_level("")
    set_logger_level("", LoggingSeverity.FATAL)  # a bad parameter raises, so that it is reported once
    try:
        return Node(
            name, parameter_overrides=parameters, automatically_declare_parameters_from_overrides=True
        )
    finally:
        set_logger_level("", level)


def spin(node: Node, stop: StopRequest, finished: Callable[[], bool], progress: Callable[[], None]) -> bool:
    """Serve a node until it has finished or is asked to stop; return False if its ROS context went before."""
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    ended = threading.Event()
    waker = threading.Thread(target=_wake, args=(executor, ended), name="waker")
    waker.start()
    try:
        while not (stop.requested or finished()):
            executor.spin_once()  # a timeout would cost a timer at every wake-up
            progress()
    except Exception:  # rclpy raises its own types, by the node's place at the shutdown
        if node.context.ok():
            raise
        node.get_logger().error("the ROS context was shut down underneath the node")
        return False
    else:
        return True
    finally:
        ended.set()
        waker.join()
        executor.shutdown()


def wait_for_subscribers(publishers: Iterable[Publisher]) -> None:
    """Wait until subscribers have received all messages, before the node exits."""
    deadline = time.monotonic() + FAREWELL
    for publisher in publishers:
        publisher.wait_for_all_acked(Duration(seconds=max(deadline - time.monotonic(), 0.0)))


def _wake(executor: SingleThreadedExecutor, ended: threading.Event) -> None:
    """End the executor's waits again and again.

    Fast DDS built for an old glibc, as on PyPI, waits by the system's clock. If that clock jumps back during
    a wait, the wait lasts until something happens, or as long as the jump. Python waits by a steady clock.
    """
    while not ended.wait(SPIN_PERIOD):
        executor.wake()


@contextmanager
def spinning(node: Node) -> Iterator[None]:
    """Serve a node in a thread of its own while this thread has other work."""
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    ended = threading.Event()

    def serve() -> None:
        while not ended.is_set():
            executor.spin_once(SPIN_PERIOD)

    thread = threading.Thread(target=serve, name="executor")
    thread.start()
    try:
        yield
    finally:
        # A shutdown in mid-spin can destroy the guard before it ends the wait.
        ended.set()
        executor.wake()
        thread.join()
        executor.shutdown()


def _is_of_rclpy(error: RuntimeError) -> bool:
    """Return whether an error is rcl's, as for a node that it cannot make; rclpy exports no class for it."""
    return type(error).__module__.partition(".")[0] == "rclpy"


def _first_line(error: Exception) -> str:
    # rcl appends its source location.
    return (str(error).splitlines() or [type(error).__name__])[0].partition(", at /")[0]
