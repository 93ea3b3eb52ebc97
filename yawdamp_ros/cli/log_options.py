"""Options of the commands that read a recorded drive."""

import argparse
import math
import sys
from collections.abc import Callable
from pathlib import Path

from yawdamp_ros.cli.errors import UsageError
from yawdamp_ros.drives import Drive, is_input
from yawdamp_ros.errors import one_line
from yawdamp_ros.logs import SteeringLog
from yawdamp_ros.logs.drive_formats import format_of, load_drive

RATIOS = (1e-3, 1e3)
"""Least and largest steering ratio, as for the node."""


def add_log_options(parser: argparse.ArgumentParser) -> None:
    """Add the options for reading a recorded drive."""
    group = parser.add_argument_group("drive (CSV, MCAP file, rosbag2 directory or MATLAB .mat)")
    group.add_argument(
        "--topic", help="of the steering in a recording; default: the one that fits, or is named so"
    )
    group.add_argument("--joint", help="that steers, where the topic has joint states; default: steering")
    group.add_argument(
        "--column", metavar="NAME", help="of the steering; default: the one with 'steer' in it"
    )
    group.add_argument(
        "--degrees", action="store_true", help="it holds degrees (a column's name ending in _deg says so)"
    )
    group.add_argument(
        "--channel",
        action="append",
        default=[],
        metavar="NAME=PLACE[:UNIT]",
        help="take a channel from a column, or a topic and field, as in speed=/can/speed.data:km/h or "
        "truck/yaw_rate=-gyro:deg/s (a minus flips the sign); may be repeated",
    )
    group.add_argument(
        "--steering-ratio",
        type=float,
        metavar="R",
        help="hand-wheel over road-wheel angle; default: 1, the log is of the road wheel",
    )
    group.add_argument("--start-offset", type=float, metavar="S", help="leave out its beginning")


def log_options(options: argparse.Namespace) -> list[str]:
    """Return the given ones of these options."""
    names = ("topic", "joint", "column", "degrees", "channel", "steering_ratio", "start_offset")
    return [name for name in names if getattr(options, name)]


def steering_ratio(options: argparse.Namespace) -> float:
    """Commanded angle over road-wheel angle, as the options say.

    Raises
    ------
    UsageError
        If it cannot be one.
    """
    ratio = 1.0 if options.steering_ratio is None else float(options.steering_ratio)
    if not RATIOS[0] <= ratio <= RATIOS[1]:
        message = f"--steering-ratio: {ratio}: expected a number from {RATIOS[0]:g} to {RATIOS[1]:g}"
        raise UsageError(message)
    return ratio


def chosen_drive(path: str, options: argparse.Namespace, duration: float | None) -> Drive:
    """Drive of a path with all its channels, steering in road-wheel angles, cut as the options say.

    Raises
    ------
    UsageError, LogError
        If an option or the log cannot be used.
    """
    return _read(path, options, duration, measured=True).steered_by(steering_ratio(options))


def chosen_log(
    path: str,
    options: argparse.Namespace,
    duration: float | None,
    followed: Callable[[str], bool],
) -> SteeringLog:
    """Steering and other inputs of a drive of a path as they were commanded, cut as the options say.

    Channels of the log that are not followed are named on standard error.

    Raises
    ------
    UsageError, LogError
        If an option or the log cannot be used.
    """
    steering_ratio(options)
    drive = _read(path, options, duration, measured=False)
    steering = drive["steering"]
    others = [f"{name} ({each.source})" for name, each in drive.channels.items() if not followed(name)]
    if others:
        print(one_line(f"note: {drive.source}: not followed: {', '.join(others)}"), file=sys.stderr)
    return SteeringLog(
        drive.source,
        steering.times.tolist(),
        steering.values.tolist(),
        drive.start_time,
        drive.warning,
        {
            name: (each.times.tolist(), each.values.tolist())
            for name, each in drive.channels.items()
            if name != "steering" and is_input(name)
        },
    )


def input_line(log: SteeringLog, name: str) -> str:
    """Describe the speed or the acceleration of a log."""
    values, unit = log.inputs[name][1], "m/s" if name == "speed" else "m/s²"
    return f"{len(values)} {name}s of {min(values):.2f} to {max(values):.2f} {unit}"


def _read(path: str, options: argparse.Namespace, duration: float | None, *, measured: bool) -> Drive:
    recording = format_of(Path(path)).has_topics
    for option in ("column",) if recording else ("topic", "joint"):
        if getattr(options, option) is not None:
            message = f"--{option}: {path} is {'a recording' if recording else 'a table'} and has none"
            raise UsageError(message)
    drive = load_drive(
        path,
        column=options.column,
        topic=options.topic,
        joint=options.joint or "steering",
        degrees=options.degrees,
        channels=options.channel,
        measured=measured,
        until=math.inf if duration is None else (options.start_offset or 0.0) + duration,
    )
    if drive.warning:
        print(f"warning: {drive.warning}", file=sys.stderr)
    return drive.window(options.start_offset or 0.0, duration)
