"""Options of the commands that read a steering log."""

import argparse
import math
from pathlib import Path

from yawdamp_ros.cli.errors import UsageError
from yawdamp_ros.logs import SteeringLog, read_steering_csv


def add_log_options(parser: argparse.ArgumentParser) -> None:
    """Add what says how a steering log is to be read."""
    group = parser.add_argument_group("steering log (CSV with named columns)")
    group.add_argument(
        "--column", metavar="NAME", help="steering column; default: the one with 'steer' in it"
    )
    group.add_argument(
        "--degrees", action="store_true", help="it holds degrees (a name ending in _deg says so itself)"
    )
    group.add_argument(
        "--steering-ratio",
        type=float,
        default=1.0,
        metavar="R",
        help="hand-wheel over road-wheel angle; default: 1, the log is of the road wheel",
    )
    group.add_argument("--start-offset", type=float, default=0.0, metavar="S", help="leave out its beginning")


def chosen_log(path: str, options: argparse.Namespace, duration: float | None) -> SteeringLog:
    """Log of a path in road-wheel angles, cut as the options say.

    Raises
    ------
    UsageError, LogError
        If an option or the log cannot be used.
    """
    if not (math.isfinite(options.steering_ratio) and options.steering_ratio > 0.0):
        message = f"--steering-ratio: {options.steering_ratio}: expected a number above 0"
        raise UsageError(message)
    log = read_steering_csv(Path(path), options.column, degrees=options.degrees)
    return log.divided(options.steering_ratio).window(options.start_offset, duration)
