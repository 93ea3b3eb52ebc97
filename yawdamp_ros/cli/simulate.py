"""`simulate`: a run offline, as fast as it goes."""

import argparse
import sys
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING

from yawdamp_ros.analysis import growth
from yawdamp_ros.analysis.peaks import Peaks
from yawdamp_ros.cli.console import progress_bar
from yawdamp_ros.cli.errors import UsageError
from yawdamp_ros.cli.log_options import add_log_options, chosen_log, log_options
from yawdamp_ros.cli.options import (
    Parser,
    add_manoeuvre_options,
    add_vehicle_options,
    chosen_manoeuvre,
    chosen_model,
    chosen_name,
    manoeuvre_settings,
)
from yawdamp_ros.cli.peaks_table import print_peaks
from yawdamp_ros.cli.ros import require_ros
from yawdamp_ros.logs import ResponseCsv, default_run_directory, make_run_directory
from yawdamp_ros.nodes.stop_request import StopRequest
from yawdamp_ros.stepping import Stepper, TimeGrid
from yawdamp_ros.stepping.response import Steering, sample_run
from yawdamp_ros.vehicle import VehicleSource, vehicle_text

if TYPE_CHECKING:
    from yawdamp_ros.nodes.recording import RunRecorder

DEFAULT_DURATION = 15.0
RUN_SAMPLE_PERIOD = 0.01


def main(arguments: Sequence[str]) -> int:
    """Simulate a manoeuvre or a log, write the run, print its peaks."""
    options = _parser().parse_args(arguments)
    model = chosen_model(options)
    steering, duration = _steering(options)
    if not 0.0 <= duration < float("inf"):
        message = f"--duration: {duration}: expected a time in s, 0 or more"
        raise UsageError(message)
    if growing := growth(model):
        print(f"warning: {growing}", file=sys.stderr)
    output = Path(options.output or default_run_directory(model.vehicle.name))
    to_csv = output.suffix == ".csv"
    period = options.sample_period
    if period is None:
        period = options.step_size if to_csv else RUN_SAMPLE_PERIOD
    grid = TimeGrid.of(options.step_size, period)
    stepper = Stepper(model, grid.step_size)
    samples = sample_run(stepper, grid, steering, duration)
    peaks = Peaks(len(model.vehicle.units))
    with StopRequest() as stop:
        if to_csv:
            sink: ResponseCsv | RunRecorder = ResponseCsv(output, model.vehicle.unit_names, grid)
        else:
            require_ros()
            output = make_run_directory(output, numbered=not options.output)
            sink = _run_recorder(output, stepper, grid, options)
        with closing(sink) as writer, progress_bar() as bar:
            task = bar.add_task("simulating", total=duration)
            for sample in samples:
                writer.write(sample)
                peaks.update(sample)
                bar.update(task, completed=grid.seconds(stepper.step))
                if stop.requested:
                    # Raised inside, so that what was simulated is kept in a finished file.
                    raise KeyboardInterrupt
    print_peaks(model, peaks)
    print(f"{'csv' if to_csv else 'run'}: {output}")
    return 0


def _steering(options: argparse.Namespace) -> tuple[Steering, float]:
    """Steering as a function of time, and how long it is to be followed in s."""
    if options.log is not None:
        given = [*(["manoeuvre"] if options.manoeuvre else []), *manoeuvre_settings(options)]
        if given:
            message = f"--{given[0].replace('_', '-')}: expected either a manoeuvre or --log"
            raise UsageError(message)
        if options.output is not None and Path(options.output).resolve() == Path(options.log).resolve():
            message = f"--output: {options.output}: that is the log"
            raise UsageError(message)
        log = chosen_log(options.log, options, options.duration)
        return log, log.duration if options.duration is None else options.duration
    if unused := log_options(options):
        message = f"--{unused[0].replace('_', '-')}: there is no --log that it could be of"
        raise UsageError(message)
    if options.manoeuvre is None:
        message = "no steering; expected --manoeuvre NAME or --log FILE"
        raise UsageError(message)
    return chosen_manoeuvre(options), DEFAULT_DURATION if options.duration is None else options.duration


def _run_recorder(
    directory: Path, stepper: Stepper, grid: TimeGrid, options: argparse.Namespace
) -> "RunRecorder":
    from yawdamp_ros.nodes.recording import RunRecorder  # noqa: PLC0415 - a CSV needs no ROS

    return RunRecorder(
        directory,
        stepper,
        grid,
        parameters=vars(options),
        vehicle=VehicleSource(vehicle_text(chosen_name(options)), tuple(options.set)),
    )


def _parser() -> Parser:
    parser = Parser(
        "simulate",
        "Simulate a manoeuvre or a steering log offline, as fast as it goes.",
        "python -m yawdamp_ros simulate --manoeuvre lane_change --output run.csv\n"
        "  python -m yawdamp_ros simulate --log drive.csv --steering-ratio 16.88",
    )
    add_vehicle_options(parser)
    add_manoeuvre_options(parser)
    add_log_options(parser)
    parser.add_argument("--log", metavar="FILE", help="steering log, in place of a manoeuvre")
    run = parser.add_argument_group("run")
    run.add_argument("--duration", type=float, metavar="S", help="default: 15, or to the end of the log")
    run.add_argument("--step-size", type=float, default=0.001, metavar="S", help="default: 0.001")
    run.add_argument(
        "--sample-period", type=float, metavar="S", help="default: the step for CSV, 0.01 for a run directory"
    )
    run.add_argument(
        "--output",
        metavar="PATH",
        help="a name ending in .csv, else a directory; default: runs/<stamp>_<vehicle>",
    )
    return parser
