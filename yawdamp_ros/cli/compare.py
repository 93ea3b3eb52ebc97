"""`compare`: simulated against measured."""

import argparse
import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path

import numpy as np

from yawdamp_ros.cli.drive_report import (
    COMPARISON_COLUMNS,
    comparison_record,
    comparison_rows,
    excitation_lines,
    label,
    r_squared_range,
    told,
    vehicle_line,
)
from yawdamp_ros.cli.errors import UsageError
from yawdamp_ros.cli.log_options import add_log_options, chosen_drive
from yawdamp_ros.cli.options import (
    DEFAULT_MODEL,
    Parser,
    add_format_option,
    add_vehicle_options,
    chosen_vehicle,
)
from yawdamp_ros.cli.table import print_table
from yawdamp_ros.drives import Drive, compare, excitation, inputs_of, matches
from yawdamp_ros.drives.comparison import BANDS
from yawdamp_ros.drives.identification import predictor_of
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.logs.drive_formats import load_drive
from yawdamp_ros.simulation import MODELS
from yawdamp_ros.vehicle import Vehicle


def main(arguments: Sequence[str]) -> int:
    """Compare a drive with a model, or with a run."""
    options = _parser().parse_args(arguments)
    drive = chosen_drive(options.log, options, options.duration)
    vehicle = chosen_vehicle(options)
    if options.speed is not None:
        drive = drive.without("speed", "acceleration")
    matched, notes = matches(drive, vehicle.unit_names)
    times, outputs = _simulated(options, drive, vehicle)
    found = compare(matched, times, outputs)
    excited = excitation(drive, vehicle.speed)
    notes = [*drive.notes, *notes]
    against = f"the run {options.run}" if options.run else f"{vehicle.name}, {_model(options)} model"
    title = f"{Path(options.log).name} against {against}"
    if options.html:
        # Imported here: the table appears before the library for pages has loaded.
        from yawdamp_ros.pictures.drive_page import DriveReport, PageTable, drive_page  # noqa: PLC0415
        from yawdamp_ros.pictures.page import save_page  # noqa: PLC0415

        table = PageTable("Agreement", COMPARISON_COLUMNS, comparison_rows(found))
        page = DriveReport(
            title,
            f"the run {options.run}" if options.run else vehicle_line(vehicle, _model(options)),
            f"R2 of simulated against measured: {r_squared_range(found)}",
            None,
            vehicle,
            [table],
            [" ".join(excitation_lines(excited)), *notes],
            told(drive),
            [("Curves", found)],
        )
        save_page(drive_page(page), options.html)
    if options.format == "json":
        record = {
            "drive": options.log,
            "against": against,
            "taken": told(drive),
            "notes": notes,
            "excitation": asdict(excited),
            "channels": [comparison_record(each) for each in found],
        }
        print(json.dumps(record, indent=2))
        return 0
    print("\n".join(["Taken from the drive:", *(f"  {line}" for line in told(drive))]))
    print("\n".join(f"note: {note}" for note in notes) + "\n" * bool(notes), end="")
    print_table(title, COMPARISON_COLUMNS, comparison_rows(found))
    print_table(
        "Coherence by frequency, Hz",
        ("channel", *(f"{low:g}-{high:g}" for low, high in BANDS)),
        [(label(each.output), *(_share(each.in_band(low, high)) for low, high in BANDS)) for each in found],
    )
    print("\n".join(excitation_lines(excited)))
    return 0


def _share(value: float) -> str:
    return "none" if math.isnan(value) else f"{value:.2f}"


def _model(options: argparse.Namespace) -> str:
    return options.model or DEFAULT_MODEL


def _simulated(
    options: argparse.Namespace, drive: Drive, vehicle: Vehicle
) -> tuple[FloatArray, Mapping[str, FloatArray]]:
    if not options.run:
        inputs = inputs_of(drive, vehicle.speed)
        return inputs.times, predictor_of(_model(options))(vehicle, inputs)
    run = load_drive(options.run)
    both = bool(drive.start_time and run.start_time)
    # Recordings of one clock are laid over each other by their stamps; other files by their starts.
    shift = (run.start_time - drive.start_time) / 1e9 if both else 0.0
    if shift > drive.duration or shift < -run.duration:
        message = f"--run: {options.run} begins {shift:g} s after the drive; expected a run of the same time"
        raise UsageError(message)
    twins = {match.output: match.channel for match in matches(run, vehicle.unit_names)[0]}
    if not twins:
        message = f"--run: {options.run} holds no motion of {', '.join(vehicle.unit_names)}"
        raise UsageError(message)
    times = np.unique(np.concatenate([channel.times for channel in twins.values()]))
    return times + shift, {name: channel.interpolated(times) for name, channel in twins.items()}


def _parser() -> Parser:
    parser = Parser(
        "compare",
        "Simulated against measured, channel by channel: bias, gain, lag, RMS error, R2, coherence by\n"
        "frequency; how much the drive asked of the vehicle, and what the sensors' noise leaves to explain.\n"
        "The model follows the drive's speed. With --run, a recorded run takes the model's place.",
        "yawdamp compare drive.csv --vehicle truck_trailer --steering-ratio 20\n"
        "  yawdamp compare bag --run bag --channel truck/yaw_rate=/imu/data",
    )
    parser.add_argument("log", metavar="LOG", help="CSV, MCAP file, rosbag2 directory or .mat file")
    parser.add_argument("--run", metavar="RUN", help="of the node or of simulate, in place of a simulation")
    parser.add_argument("--duration", type=float, metavar="S", help="of the log; default: to its end")
    parser.add_argument("--html", metavar="FILE", help="also write a page with the curves over each other")
    add_format_option(parser)
    add_vehicle_options(parser, MODELS)
    add_log_options(parser)
    return parser
