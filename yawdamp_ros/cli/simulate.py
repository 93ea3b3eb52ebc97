"""`simulate`: a run offline, as fast as it goes."""

import argparse
import json
import sys
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from yawdamp_ros.analysis import growth
from yawdamp_ros.analysis.peaks import Peaks
from yawdamp_ros.cli.console import progress_bar
from yawdamp_ros.cli.errors import UsageError
from yawdamp_ros.cli.log_options import add_log_options, chosen_log, input_line, log_options, steering_ratio
from yawdamp_ros.cli.options import (
    DEFAULT_MODEL,
    Parser,
    add_format_option,
    add_manoeuvre_options,
    add_run_settings,
    add_start_options,
    add_vehicle_options,
    chosen_name,
    chosen_vehicle,
    manoeuvre_settings,
    run_settings,
    start_settings,
)
from yawdamp_ros.cli.peaks_table import peaks_record, print_events, print_peaks
from yawdamp_ros.cli.ros import require_ros
from yawdamp_ros.drives import is_input, speeds_by_acceleration
from yawdamp_ros.errors import one_line
from yawdamp_ros.logs import SteeringLog
from yawdamp_ros.logs.room import check_room
from yawdamp_ros.nodes.stop_request import StopRequest
from yawdamp_ros.runs import ResponseCsv, default_run_directory, make_run_directory
from yawdamp_ros.simulation import (
    MODELS,
    Commands,
    Limits,
    LinearRange,
    Run,
    SimParameters,
    Sink,
    make_motion,
)
from yawdamp_ros.simulation.commands import Signal
from yawdamp_ros.simulation.inputs import LONGITUDINAL
from yawdamp_ros.stepping import Motion, Sample, TimeGrid, Verdict
from yawdamp_ros.vehicle import Vehicle, vehicle_source

if TYPE_CHECKING:
    from rich.progress import Progress

    from yawdamp_ros.runs.encoder import Encoder

DEFAULT_DURATION = 15.0
RUN_SAMPLE_PERIOD = 0.01
DAY = 86400.0
"""Longest log that is simulated in full without an explicit duration [s]."""


def main(arguments: Sequence[str]) -> int:
    """Simulate a manoeuvre or a log, write the run, print its peaks; 1 if a limit stopped it."""
    options = _parser().parse_args(arguments)
    vehicle = chosen_vehicle(options)
    log, settings = _settings(options, vehicle)
    grid = TimeGrid.of(settings.step_size, _sample_period(options))
    motion = make_motion(vehicle, settings.model, settings.first_speed, grid.step_size, settings.first_pose)
    commands = Commands(settings, grid, motion, *_played(log, options, motion))
    if growing := growth(motion.linearise()):
        print(f"warning: {growing}", file=sys.stderr)
    output = Path(options.output or default_run_directory(vehicle.name))
    wheels = 2 * sum(len(unit.axles) for unit in vehicle.units) if "load" in motion.quantity_names else 0
    check_room(output, grid.samples_in(settings.duration) + 1, len(vehicle.units), wheels)
    peaks = Peaks(len(vehicle.units))
    linear_range = LinearRange(vehicle.unit_names, Limits.warning(settings))
    encoder: Encoder | None = None
    with StopRequest() as stop:
        if _to_csv(options):
            sink: Sink = ResponseCsv(output, motion, grid)
        else:
            require_ros()
            output = make_run_directory(output, numbered=not options.output)
            sink = encoder = _encoder(output, motion, grid, settings, options)
        with progress_bar() as bar:
            sinks = [sink, peaks, linear_range, _ProgressSink(bar, grid, settings.duration)]
            with closing(Run(motion, grid, commands, sinks, Limits.of(settings))) as run:
                _carry_out(run, grid.samples_in(settings.duration), commands.samples_at_once, stop)
                if run.unwritten and encoder is not None:
                    encoder.tell(run.unwritten)
    if options.format == "json":
        record = peaks_record(motion.linearise(), peaks, linear_range.first, grid)
        stopped = None if run.stopped is None else run.stopped._asdict()
        events = [event._asdict() | {"time": grid.seconds(event.step)} for event in run.events]
        outcome = {"events": events, "stopped": stopped, "output": str(output)}
        print(json.dumps(record | outcome, indent=2))
        return 1 if run.stopped else 0
    print_peaks(motion.linearise(), peaks, linear_range.sentence)
    print_events(run.events, grid)
    if clamped := commands.steering_input.counts[Verdict.CLAMPED]:
        print(f"{clamped} commands clamped to {settings.max_steering_angle:g} rad")
    if run.stopped is not None:
        print(f"stopped at {run.time:g} s: {run.stopped.reason}")
    print(f"{'csv' if _to_csv(options) else 'run'}: {output}")
    return 1 if run.stopped else 0


def _played(
    log: SteeringLog | None, options: argparse.Namespace, motion: Motion
) -> tuple[Signal | None, dict[str, Signal]]:
    """Steering of a log and the other inputs to follow, by name; report ignored inputs."""
    if log is None:
        return None, {}
    source = options.longitudinal_source or "speed"
    inputs = dict(log.inputs)
    integrates = source == "speed" and "speed" not in inputs and "acceleration" not in motion.input_names
    if "acceleration" in inputs and integrates:
        times, values = inputs.pop("acceleration")
        inputs["speed"] = times, speeds_by_acceleration(times, values, motion.speed).tolist()
        print(f"following the log's acceleration, from {motion.speed:g} m/s on")
    elif "speed" in inputs and source == "speed" and options.speed is None:
        print(f"following the log: {input_line(log, 'speed')}")
    left = [name for name in LONGITUDINAL if name in inputs and name != source]
    left += [name for name in inputs if name not in {*LONGITUDINAL, *motion.input_names}]
    if "speed" in log.inputs and source == "speed" and options.speed is not None:
        print(f"--speed counts; the log's own is not followed: {input_line(log, 'speed')}")
        del inputs["speed"]
    if left:
        print(one_line(f"note: {log.source}: not followed: {', '.join(left)}"), file=sys.stderr)
    return (log.times, log.angles), {name: each for name, each in inputs.items() if name not in left}


def _carry_out(run: Run, samples: int, at_once: int, stop: StopRequest) -> None:
    run.start()
    for begin in range(0, samples, at_once):
        if run.stopped is not None:
            return
        run.advance(min(at_once, samples - begin))
        if stop.requested:
            # Raised while the sinks are open, so that the simulated part is kept in a finished file.
            raise KeyboardInterrupt


class _ProgressSink:
    """Shows the progress of a run with a known end."""

    def __init__(self, bar: "Progress", grid: TimeGrid, duration: float) -> None:
        self._bar, self._grid = bar, grid
        self._task = bar.add_task("simulating", total=duration)

    def write(self, sample: Sample) -> None:
        """Take a sample of one or more instants."""
        self._bar.update(self._task, completed=self._grid.seconds(int(np.max(sample.step))))

    def close(self) -> None:
        """Do nothing: the bar closes itself."""


def _settings(options: argparse.Namespace, vehicle: Vehicle) -> tuple[SteeringLog | None, SimParameters]:
    """The log, if there is one, and the settings of the run."""
    log = _log(options)
    duration = options.duration
    if duration is None:
        duration = DEFAULT_DURATION if log is None else log.duration
    if not 0.0 <= duration < float("inf"):
        message = f"--duration: {duration}: expected a time in s, 0 or more"
        raise UsageError(message)
    period = _sample_period(options)
    given: dict[str, Any] = manoeuvre_settings(options) | run_settings(options) | start_settings(options)
    settings = SimParameters(
        vehicle=chosen_name(options),
        vehicle_overrides=options.set or [""],
        model=options.model or DEFAULT_MODEL,
        speed=vehicle.speed,
        step_size=options.step_size,
        publish_rate=1.0 / period if period else 0.0,
        real_time_factor=0.0,
        steering_ratio=steering_ratio(options),
        manoeuvre=options.manoeuvre or "none",
        duration=duration,
        record=not _to_csv(options),
        record_directory=options.output or "",
        **given,
    )
    if settings.longitudinal_source == "steering":
        message = (
            "--longitudinal-source: steering: of messages on a graph alone; expected speed or acceleration"
        )
        raise UsageError(message)
    if problem := settings.start_problem() or settings.model_problem():
        raise UsageError("--" + problem.replace("_", "-", 1))
    return log, settings


def _log(options: argparse.Namespace) -> SteeringLog | None:
    if options.log is not None:
        given = [*(["manoeuvre"] if options.manoeuvre else []), *manoeuvre_settings(options)]
        if given:
            message = f"--{given[0].replace('_', '-')}: expected either a manoeuvre or --log"
            raise UsageError(message)
        if options.output is not None and Path(options.output).resolve() == Path(options.log).resolve():
            message = f"--output: {options.output}: that is the log"
            raise UsageError(message)
        steering_ratio(options)
        log = chosen_log(options.log, options, options.duration, is_input)
        if options.duration is None and log.duration > DAY:
            message = f"{options.log}: lasts {log.duration:g} s, more than a day: say --duration"
            raise UsageError(message)
        return log
    if unused := log_options(options):
        message = f"--{unused[0].replace('_', '-')}: there is no --log that it could be of"
        raise UsageError(message)
    if options.manoeuvre is None:
        message = "no steering; expected --manoeuvre NAME or --log FILE"
        raise UsageError(message)
    return None


def _to_csv(options: argparse.Namespace) -> bool:
    return Path(options.output or "").suffix == ".csv"


def _sample_period(options: argparse.Namespace) -> float:
    if options.sample_period is not None:
        return float(options.sample_period)
    return float(options.step_size) if _to_csv(options) else RUN_SAMPLE_PERIOD


def _encoder(
    directory: Path, motion: Motion, grid: TimeGrid, settings: SimParameters, options: argparse.Namespace
) -> "Encoder":
    from yawdamp_ros.runs.encoder import Encoder  # noqa: PLC0415 - a CSV needs no ROS
    from yawdamp_ros.runs.recipe import Recipe, RunFile  # noqa: PLC0415

    encoder = Encoder(motion, settings, grid, start_time=0)
    source = vehicle_source(chosen_name(options), options.set)
    recipe = Recipe(
        motion,
        grid,
        settings,
        source,
        stamps=encoder.stamps,
        types=encoder.types,
        frames=encoder.frames,
        sensors=encoder.sensors,
    )
    encoder.sinks.append(RunFile(recipe.open(directory, settings)))
    return encoder


def _parser() -> Parser:
    parser = Parser(
        "simulate",
        "Simulate a manoeuvre or a steering log offline, as fast as it goes.",
        "yawdamp simulate --manoeuvre lane_change --output run.csv\n"
        "  yawdamp simulate --log drive.csv --steering-ratio 16.88",
    )
    add_vehicle_options(parser, MODELS)
    add_manoeuvre_options(parser)
    add_log_options(parser)
    add_run_settings(parser)
    add_start_options(parser)
    add_format_option(parser)
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
