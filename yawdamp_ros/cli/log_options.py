"""Options of the commands that read a steering log."""

import argparse
import sys
from pathlib import Path

from yawdamp_ros.cli.errors import UsageError
from yawdamp_ros.logs import SteeringLog, is_recording, read_steering_csv, read_steering_mcap

RATIOS = (1e-3, 1e3)
"""Least and largest steering ratio, as for the node."""


def add_log_options(parser: argparse.ArgumentParser) -> None:
    """Add what says how a steering log is to be read."""
    group = parser.add_argument_group("steering log (CSV, MCAP file or rosbag2 directory)")
    group.add_argument(
        "--topic", help="of the steering in a recording; default: the one that fits, or is named so"
    )
    group.add_argument("--joint", help="that steers, where the topic has joint states; default: steering")
    group.add_argument("--column", metavar="NAME", help="of a CSV; default: the one with 'steer' in it")
    group.add_argument(
        "--degrees", action="store_true", help="it holds degrees (a column's name ending in _deg says so)"
    )
    group.add_argument(
        "--steering-ratio",
        type=float,
        metavar="R",
        help="hand-wheel over road-wheel angle; default: 1, the log is of the road wheel",
    )
    group.add_argument("--start-offset", type=float, metavar="S", help="leave out its beginning")


def log_options(options: argparse.Namespace) -> list[str]:
    """Those of these options that were given."""
    names = ("topic", "joint", "column", "degrees", "steering_ratio", "start_offset")
    return [name for name in names if getattr(options, name) not in {None, False}]


def chosen_log(path: str, options: argparse.Namespace, duration: float | None) -> SteeringLog:
    """Log of a path in road-wheel angles, cut as the options say.

    Raises
    ------
    UsageError, LogError
        If an option or the log cannot be used.
    """
    ratio = 1.0 if options.steering_ratio is None else options.steering_ratio
    if not RATIOS[0] <= ratio <= RATIOS[1]:
        message = f"--steering-ratio: {ratio}: expected a number from {RATIOS[0]:g} to {RATIOS[1]:g}"
        raise UsageError(message)
    log = _read(Path(path), options)
    if log.warning:
        print(f"warning: {log.warning}", file=sys.stderr)
    return log.divided(ratio).window(options.start_offset or 0.0, duration)


def _read(path: Path, options: argparse.Namespace) -> SteeringLog:
    recording = is_recording(path)
    for option in ("column",) if recording else ("topic", "joint"):
        if getattr(options, option) is not None:
            message = f"--{option}: {path} is {'a recording' if recording else 'a CSV'} and has none"
            raise UsageError(message)
    if recording:
        joint = options.joint or "steering"
        return read_steering_mcap(path, options.topic, joint=joint, degrees=options.degrees)
    return read_steering_csv(path, options.column, degrees=options.degrees)
