"""Vehicles drawn at random: the options --random, --range, --seed and --jobs."""

import argparse
import math
from collections.abc import Mapping

from yawdamp_ros.cli.errors import UsageError


def parse_span(text: str) -> tuple[tuple[str, ...], tuple[float, float]]:
    """Read KEY=A:B, where KEY may be several with commas."""
    key, separator, span = text.partition("=")
    try:
        low, high = map(float, span.split(":"))
    except ValueError:
        separator = ""
    if not (separator and key and math.isfinite(high - low) and low < high):
        message = f"--range: {text}: expected KEY=A:B, A below B, as in units.2.mass=5000:30000"
        raise UsageError(message)
    return tuple(key.split(",")), (low, high)


def check_draws(options: argparse.Namespace) -> None:
    """Refuse --random, --range, --seed and --jobs that mean nothing."""
    drawn = options.random is not None
    keys = [key for text in options.range for key in parse_span(text)[0]]
    refuse(
        {
            "--range: it goes with --random": options.range and not drawn,
            "--random: expected at least one --range KEY=A:B": drawn and not options.range,
            f"--random: {options.random}: expected a whole number, 1 or more": drawn and options.random < 1,
            "--seed: it goes with --random": options.seed is not None and not drawn,
            f"--seed: {options.seed}: expected a whole number, 0 or more": (options.seed or 0) < 0,
            f"--jobs: {options.jobs}: expected a whole number, 1 or more": options.jobs is not None
            and options.jobs < 1,
            f"--range: {' and '.join(keys)}: expected every key once": len(set(keys)) < len(keys),
        }
    )


def refuse(wrong: Mapping[str, object]) -> None:
    """Raise the first message that applies."""
    for message, is_so in wrong.items():
        if is_so:
            raise UsageError(message)
