"""`resimulate`: a recorded run, run again."""

import argparse
import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from yawdamp_ros.cli.console import progress_bar
from yawdamp_ros.cli.options import Parser, add_format_option
from yawdamp_ros.cli.ros import require_ros

if TYPE_CHECKING:
    from yawdamp_ros.nodes.resimulation import Resimulation


def main(arguments: Sequence[str]) -> int:
    """Run again what a run recorded, compare, and say what came of it."""
    options = _parser().parse_args(arguments)
    require_ros()
    from yawdamp_ros.nodes.resimulation import Resimulation  # noqa: PLC0415 - needs ROS's messages

    run = Resimulation(Path(options.run))
    with progress_bar() as bar:
        task = bar.add_task("comparing", total=None)
        for time in run.compare():
            bar.update(task, completed=time)
    if run.warning:
        print(f"warning: {run.warning}", file=sys.stderr)
    if options.format == "json":
        print(json.dumps(_as_json(run), indent=2))
    else:
        _print(options, run)
    return 0 if run.agrees else 1


def _print(options: argparse.Namespace, run: "Resimulation") -> None:
    compared = f"{run.samples} samples, {run.messages} messages, {run.values} values over {run.duration:g} s"
    print(f"{options.run}: {compared}")
    if run.promised:
        print(f"recorded on this kind of machine and build, so bit-identity is promised: {run.build}")
    else:
        print("recorded on another machine or build, so 1e-12 relative is promised:")
        print(f"  recorded: {run.recorded_build}\n  here:     {run.build}")
    if run.difference is not None:
        found = run.difference
        print(
            f"DIFFERENT first at {found.time:.9g} s, {found.topic} {found.field}: "
            f"recorded {found.recorded}, again {found.repeated}"
        )
    elif run.samples:
        print(f"every value {'is bit-identical' if run.bit_identical else 'agrees'}")
    else:
        print("it holds no sample")


def _as_json(run: "Resimulation") -> dict[str, object]:
    return {
        "agrees": run.agrees,
        "bit_identical": run.bit_identical,
        "promise": "bit-identical" if run.promised else "1e-12 relative",
        "recorded_build": run.recorded_build,
        "build": run.build,
        "duration": run.duration,
        "samples": run.samples,
        "messages": run.messages,
        "values": run.values,
        "difference": None if run.difference is None else run.difference._asdict(),
        "warning": run.warning,
    }


def _parser() -> Parser:
    parser = Parser(
        "resimulate",
        "Run a recorded run again from what it contains, compare every value of every output, and say\n"
        "whether they are bit-identical. Exit status 1 if one is not.",
        "python -m yawdamp_ros resimulate runs/20261121-120000_interlink",
    )
    parser.add_argument("run", metavar="RUN", help="run directory or its MCAP file")
    add_format_option(parser)
    return parser
