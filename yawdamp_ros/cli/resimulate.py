"""`resimulate`: a recorded run, run again."""

import argparse
import json
import sys
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

from yawdamp_ros.cli.console import progress_bar
from yawdamp_ros.cli.errors import UsageError
from yawdamp_ros.cli.options import Parser, add_format_option, add_vehicle_options, chosen_model
from yawdamp_ros.cli.ros import require_ros
from yawdamp_ros.logs import is_recording
from yawdamp_ros.runs.repetition import Answer, repeat_csv, repeat_recording

VEHICLE_OPTIONS = ("vehicle", "speed", "model", "set")


def main(arguments: Sequence[str]) -> int:
    """Repeat a recorded run, compare, and report the result."""
    options = _parser().parse_args(arguments)
    path = Path(options.run)
    answer = _answer(path, options)
    if answer.warning:
        print(f"warning: {answer.warning}", file=sys.stderr)
    if options.format == "json":
        print(json.dumps(asdict(answer), indent=2))
    else:
        _print(path, answer)
    return 0 if answer.agrees else 1


def _answer(path: Path, options: argparse.Namespace) -> Answer:
    if not is_recording(path):
        return repeat_csv(path, chosen_model(options))
    for option in VEHICLE_OPTIONS:
        if getattr(options, option):
            message = f"--{option}: {path} is a recording and holds its own"
            raise UsageError(message)
    require_ros()
    with progress_bar() as bar:
        task = bar.add_task("comparing", total=None)
        return repeat_recording(path, lambda time: bar.update(task, completed=time))


def _print(path: Path, answer: Answer) -> None:
    print(f"{path}: {answer.samples} samples, {answer.values} values over {answer.duration:g} s")
    print(f"promised is {answer.promise}, for {answer.reason}")
    if answer.difference is not None:
        found = answer.difference
        print(
            f"DIFFERENT first at {found.time:.9g} s, {found.where} {found.field}: "
            f"recorded {found.recorded}, again {found.repeated}"
        )
    elif answer.agrees:
        print(f"every value {'is bit-identical' if answer.bit_identical else 'agrees'}")
    else:
        print("it holds no sample")


def _parser() -> Parser:
    parser = Parser(
        "resimulate",
        "Run a recorded run again from what it contains, compare every value of every output, and say\n"
        "whether they are bit-identical. A CSV file, of every step, needs to be told its vehicle.\n"
        "Exit status 1 if a value is not what was promised.",
        "yawdamp resimulate runs/20261121-120000_interlink",
    )
    parser.add_argument("run", metavar="RUN", help="run directory, its MCAP file, or CSV file")
    add_format_option(parser)
    add_vehicle_options(parser)
    return parser
