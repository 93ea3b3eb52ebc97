"""`sweep`: a measure over ranges of parameters."""

import argparse
from collections.abc import Sequence
from contextlib import ExitStack, closing
from dataclasses import asdict
from pathlib import Path
from typing import NamedTuple

import numpy as np

from yawdamp_ros.analysis import Variation, find_boundaries, parse_variation
from yawdamp_ros.analysis.boundaries import Boundary
from yawdamp_ros.analysis.points import Draws, Grid, Points
from yawdamp_ros.analysis.stability_map import boundary_segments
from yawdamp_ros.analysis.study import STABILITY, STUDIED, Study, evaluate_all
from yawdamp_ros.cli import sweep_report
from yawdamp_ros.cli.console import progress_bar
from yawdamp_ros.cli.draws import check_draws, parse_span, refuse
from yawdamp_ros.cli.errors import UsageError
from yawdamp_ros.cli.executors import mapping
from yawdamp_ros.cli.extras import require
from yawdamp_ros.cli.options import (
    DEFAULT_MODEL,
    Parser,
    add_format_option,
    add_vehicle_options,
    chosen_name,
    chosen_vehicle,
    overrides,
)
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.logs.sweep_csv import SweepCsv
from yawdamp_ros.logs.sweep_file import SweepFile
from yawdamp_ros.nodes.stop_request import StopRequest
from yawdamp_ros.simulation import MODELS
from yawdamp_ros.vehicle import vehicle_text

MOST_AXES = 2
PARQUET = ".parquet"


class Plan(NamedTuple):
    """Return the sweep of a command line."""

    study: Study
    points: Points
    definition: dict[str, object]
    axes: tuple[Variation, ...]


def main(argv: Sequence[str]) -> int:
    """Run the command."""
    options = _parser().parse_args(argv)
    _check(options)
    plan = _plan(options)
    columns = [",".join(keys) for keys in plan.study.keys] + list(plan.study.columns)
    answers = _run(plan, columns, options)
    swept = sweep_report.Sweep(plan.study, plan.axes, plan.points, answers, tuple(columns))
    boundaries = _boundaries(plan, answers) if len(plan.axes) == 1 else ()
    segments = (
        boundary_segments(plan.study, *(np.array(axis.values) for axis in plan.axes))
        if len(plan.axes) == MOST_AXES
        else np.empty((0, 2, 2))
    )
    if options.plot:
        # Imported here: matplotlib takes longer to load than most sweeps take to run.
        from yawdamp_ros.pictures import save  # noqa: PLC0415
        from yawdamp_ros.pictures.sweeps import curve_figure, histogram_figure, map_figure  # noqa: PLC0415

        column, name = answers[:, -1], plan.study.columns[-1]
        if not plan.axes:
            figure = histogram_figure(column, name)
        elif len(plan.axes) == 1:
            figure = curve_figure(plan.axes[0], column, name, boundaries)
        else:
            figure = map_figure(plan.axes, column, name, segments)
        save(figure, options.plot)
    if options.format == "json":
        sweep_report.print_json(swept, boundaries, segments)
    else:
        sweep_report.print_text(swept, boundaries, segments)
    return 0


def _run(plan: Plan, columns: Sequence[str], options: argparse.Namespace) -> FloatArray:
    study, points = plan.study, plan.points
    study.check(points)
    answers = np.empty((len(points), len(study.columns)))
    with ExitStack() as opened:
        done, sink = 0, _sink(plan, columns, options.output)
        if sink:
            opened.enter_context(closing(sink))
            done = len(sink.answers)
            answers[:done] = sink.answers
        stop = opened.enter_context(StopRequest())
        bar = opened.enter_context(progress_bar("points"))
        task = bar.add_task("sweeping", total=len(points), completed=done)
        chunks = -(-(len(points) - done) // study.chunk)
        mapped = opened.enter_context(mapping(chunks, options.jobs, options.scheduler, threads=study.threads))
        for found in evaluate_all(study, points, mapped, done):
            answers[done : done + len(found)] = found
            done += len(found)
            if sink:
                sink.write(found)
            bar.advance(task, len(found))
            if stop.requested:
                raise KeyboardInterrupt
    return answers


def _sink(plan: Plan, columns: Sequence[str], output: str | None) -> SweepFile | None:
    if output is None:
        return None
    if output.lower().endswith(PARQUET):
        # Imported here: an optional library.
        from yawdamp_ros.logs.sweep_parquet import SweepParquet  # noqa: PLC0415

        return SweepParquet(Path(output), plan.definition, plan.points, columns)
    return SweepCsv(Path(output), plan.definition, plan.points, columns)


def _plan(options: argparse.Namespace) -> Plan:
    vehicle = chosen_name(options)
    axes = tuple(map(parse_variation, options.vary))
    spans = [parse_span(text) for text in options.range]
    keys = tuple(axis.keys for axis in axes) or tuple(keys for keys, _ in spans)
    if len({key for each in keys for key in each}) < sum(map(len, keys)):
        message = f"{' and '.join(','.join(each) for each in keys)}: expected every key once"
        raise UsageError(message)
    chosen_vehicle(options)  # warns of implausible values, whichever key varies
    study = Study(
        text=vehicle_text(vehicle),
        source=vehicle,
        overrides=tuple(overrides(options)),
        model=options.model or DEFAULT_MODEL,
        keys=keys,
        measure=options.measure,
    )
    if axes:
        points: Points = Grid([axis.values for axis in axes])
        drawn: dict[str, object] = {"vary": options.vary}
    else:
        points = Draws([span for _, span in spans], options.random, options.seed or 0)
        drawn = {"range": options.range, "random": options.random, "seed": options.seed or 0}
    return Plan(study, points, {**asdict(study), **drawn}, axes)


def _boundaries(plan: Plan, answers: FloatArray) -> tuple[Boundary, ...]:
    """Boundaries of stability along one axis, refined between the points."""

    def eigenvalue(value: float) -> complex:
        (eigenvalues,) = plan.study.eigenvalues(np.array([[value]]))
        rightmost = eigenvalues[np.argmax(eigenvalues.real)]
        return complex(rightmost.real, abs(rightmost.imag))

    scan = [
        (float(value), complex(real)) for (value,), real in zip(plan.points[:], answers[:, 0], strict=True)
    ]
    return find_boundaries(eigenvalue, scan)


def _check(options: argparse.Namespace) -> None:
    """Refuse options that do not go together before anything is computed."""
    drawn = options.random is not None
    wrong = {
        "expected either --vary KEY=A:B:N, once or twice, or --random N with --range KEY=A:B": bool(
            options.vary
        )
        == drawn,
        f"--vary: {len(options.vary)} times; expected once or twice": len(options.vary) > MOST_AXES,
        "--range: it goes with --random; --vary has its own range": options.vary and options.range,
        f"--output: {options.output}: expected a name ending in .csv or {PARQUET}": _named_otherwise(
            options.output, ".csv", PARQUET
        ),
        f"--plot: {options.plot}: expected a name ending in .png or .svg": _named_otherwise(
            options.plot, ".png", ".svg"
        ),
    }
    refuse(wrong)
    check_draws(options)
    if options.plot:
        require("matplotlib")
    if options.scheduler:
        require("distributed")
    if options.output and options.output.lower().endswith(PARQUET):
        require("pyarrow")


def _named_otherwise(path: str | None, *suffixes: str) -> bool:
    return path is not None and Path(path).suffix.lower() not in suffixes


def _parser() -> argparse.ArgumentParser:
    parser = Parser(
        "sweep",
        "A measure over ranges of one or two parameters, or of vehicles drawn at random from ranges, and\n"
        "stability beside it. Unless the speed is given or varied a measure is taken at its standard's.\n"
        "Exit status: 0, 2 for wrong use.",
        "yawdamp sweep --vary speed=10:40:31 --vary units.2.mass=5000:40000:36 --plot map.png\n"
        "  yawdamp sweep --random 100000 --range units.1.mass=4000:36000 --output drawn.csv",
    )
    add_vehicle_options(parser, MODELS)
    add_format_option(parser)
    group = parser.add_argument_group("what varies")
    group.add_argument(
        "--vary",
        action="append",
        default=[],
        metavar="KEY=A:B:N",
        help="N values from A to B; once: a curve, twice: a map; keys separated by commas vary together",
    )
    group.add_argument("--random", type=int, metavar="N", help="draw N vehicles, evenly from every --range")
    group.add_argument(
        "--range", action="append", default=[], metavar="KEY=A:B", help="range of a key; may be repeated"
    )
    group.add_argument("--seed", type=int, help="the same seed draws the same (default: 0)")
    group = parser.add_argument_group("what is computed")
    group.add_argument("--measure", choices=STUDIED, default=STABILITY, metavar="M", help=", ".join(STUDIED))
    group.add_argument(
        "--output",
        metavar="FILE",
        help="CSV file, or directory of Parquet files by a name ending in .parquet: a row a point, written "
        "as they come. Interrupted, the same command goes on from it: FILE.json says which sweep it "
        "holds, and that of another one is refused",
    )
    group.add_argument(
        "--plot", metavar="FILE", help="curve, map or histogram as PNG or SVG, by the file's name"
    )
    group = parser.add_argument_group("where")
    group.add_argument(
        "--jobs",
        type=int,
        metavar="N",
        help="processes, or threads of the nonlinear model (default: one a core)",
    )
    group.add_argument(
        "--scheduler", metavar="tcp://HOST:PORT", help="workers of a dask.distributed scheduler"
    )
    return parser
