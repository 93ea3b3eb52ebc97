"""Joining the ROS graph and leaving it in good order."""

import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions

from yawdamp_ros.nodes.errors import NodeError
from yawdamp_ros.nodes.stop_request import StopRequest

SPIN_PERIOD = 0.1
"""Longest time in s that a stop request waits for the executor."""


@contextmanager
def ros_graph(ros_arguments: Sequence[str]) -> Iterator[None]:
    """Initialise rclpy with what follows ``--ros-args``, and shut it down whatever happens.

    Signals stay with `StopRequest`: a context that shuts down under a callback makes it raise.

    Raises
    ------
    NodeError
        If rclpy refuses the arguments or cannot start.
    """
    try:
        rclpy.init(args=list(ros_arguments), signal_handler_options=SignalHandlerOptions.NO)
    except Exception as error:  # rclpy raises its own types, RuntimeError and ValueError here
        raise NodeError(_first_line(error)) from error
    try:
        yield
    finally:
        rclpy.try_shutdown()


def spin(node: Node, stop: StopRequest, finished: Callable[[], bool], progress: Callable[[], None]) -> None:
    """Serve a node until it has finished or is asked to stop."""
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    try:
        while not (stop.requested or finished()):
            executor.spin_once(timeout_sec=SPIN_PERIOD)
            progress()
    finally:
        executor.shutdown()


@contextmanager
def spinning(node: Node) -> Iterator[None]:
    """Serve a node in a thread of its own, for as long as this thread has other work."""
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    thread = threading.Thread(target=executor.spin, name="executor")
    thread.start()
    try:
        yield
    finally:
        executor.shutdown()
        thread.join()


def _first_line(error: Exception) -> str:
    # rcl appends where in its sources it was.
    return (str(error).splitlines() or [type(error).__name__])[0].partition(", at /")[0]
