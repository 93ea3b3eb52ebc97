"""`resimulate`: a recorded run, run again."""

import argparse
import json
import sys
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from yawdamp_ros.cli.console import progress_bar
from yawdamp_ros.cli.errors import UsageError
from yawdamp_ros.cli.options import Parser, add_format_option, add_vehicle_options, chosen_model
from yawdamp_ros.cli.ros import require_ros
from yawdamp_ros.errors import YawdampError
from yawdamp_ros.logs import LogError, is_recording
from yawdamp_ros.runs import read_response_csv

VEHICLE_OPTIONS = ("vehicle", "speed", "model")


@dataclass(frozen=True)
class Difference:
    """The first value that is not what it was."""

    where: str
    field: str
    time: float
    recorded: str
    repeated: str


@dataclass(frozen=True)
class Answer:
    """What came of running a run again, alike for recordings and CSV files."""

    agrees: bool
    bit_identical: bool
    promise: str
    reason: str
    duration: float
    samples: int
    values: int
    difference: Difference | None
    warning: str = ""


def main(arguments: Sequence[str]) -> int:
    """Run again what a run recorded, compare, and say what came of it."""
    options = _parser().parse_args(arguments)
    path = Path(options.run)
    answer = _of_recording(path, options) if is_recording(path) else _of_csv(path, options)
    if answer.warning:
        print(f"warning: {answer.warning}", file=sys.stderr)
    if options.format == "json":
        print(json.dumps(asdict(answer), indent=2))
    else:
        _print(path, answer)
    return 0 if answer.agrees else 1


def _of_recording(path: Path, options: argparse.Namespace) -> Answer:
    for option in (*VEHICLE_OPTIONS, "set"):
        if getattr(options, option):
            message = f"--{option}: {path} is a recording and holds its own"
            raise UsageError(message)
    require_ros()
    from yawdamp_ros.runs.resimulation import Resimulation  # noqa: PLC0415 - needs ROS's messages

    run = Resimulation(path)
    with progress_bar() as bar:
        task = bar.add_task("comparing", total=None)
        for time in run.compare():
            bar.update(task, completed=time)
    if run.promised:
        reason = f"it was recorded on this kind of machine with this build: {run.build}"
    else:
        reason = f"it was recorded with {run.recorded_build}; this is {run.build}"
    found = run.difference
    return Answer(
        agrees=run.agrees,
        bit_identical=run.bit_identical,
        promise="bit-identical" if run.promised else "1e-9 of the motion",
        reason=reason,
        duration=run.duration,
        samples=run.samples,
        values=run.values,
        difference=found and Difference(found.topic, found.field, found.time, found.recorded, found.repeated),
        warning=run.warning,
    )


def _of_csv(path: Path, options: argparse.Namespace) -> Answer:
    from yawdamp_ros.runs.csv_resimulation import (  # noqa: PLC0415 - not needed by recordings
        QUANTITIES,
        TOLERANCE,
        first_parting,
        repeat,
    )

    recorded, model = read_response_csv(path), chosen_model(options)
    try:
        repeated = repeat(recorded, model)
    except YawdampError as error:
        raise LogError(path, str(error)) from error
    parting = first_parting(recorded, repeated, TOLERANCE)
    return Answer(
        agrees=parting is None,
        bit_identical=first_parting(recorded, repeated, 0.0) is None,
        promise="1e-9 of the motion",
        reason="a CSV file does not say where it was made",
        duration=float(recorded.time[-1]),
        samples=len(recorded.time),
        values=sum(getattr(recorded, quantity).size for quantity in QUANTITIES),
        difference=parting
        and Difference(
            f"column {parting.column + 1}",
            parting.quantity,
            parting.time,
            repr(parting.recorded),
            repr(parting.repeated),
        ),
    )


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
