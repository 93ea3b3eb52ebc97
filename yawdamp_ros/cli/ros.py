"""Command lines of nodes: their own options, then ``--ros-args``."""

import argparse
from collections.abc import Sequence

from yawdamp_ros.cli.errors import UsageError

ROS_ARGUMENTS = "--ros-args"


def parse_before_ros(
    parser: argparse.ArgumentParser, arguments: Sequence[str]
) -> tuple[argparse.Namespace, list[str]]:
    """Parse a node's own options; arguments after ``--ros-args`` are for rclpy."""
    given = list(arguments)
    cut = given.index(ROS_ARGUMENTS) if ROS_ARGUMENTS in given else len(given)
    return parser.parse_args(given[:cut]), given[cut:]


def require_ros() -> None:
    """Name in one line the package to install if rclpy cannot be imported.

    Raises
    ------
    UsageError
    """
    try:
        import rclpy  # noqa: F401, PLC0415 - the import is the question
    except ImportError as error:
        message = f"needs ROS 2: source a Jazzy, or pip install 'yawdamp_ros[ros]' ({error})"
        raise UsageError(message) from error
