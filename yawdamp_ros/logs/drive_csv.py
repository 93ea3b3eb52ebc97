"""Drives from CSV files with named columns."""

from itertools import islice
from pathlib import Path

import numpy as np

from yawdamp_ros.drives import Channel, Drive
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.logs.csv_file import csv_reader
from yawdamp_ros.logs.drive_options import DriveOptions
from yawdamp_ros.logs.drive_table import channels_of, measured_columns
from yawdamp_ros.logs.steering_csv import read_steering_csv, steering_column


def read_drive_csv(path: Path, options: DriveOptions) -> Drive:
    """Read a drive from a CSV file; its steering and its times are those of `read_steering_csv`.

    A cell of another column that is empty or not a number is left out, so that a file may hold what was
    measured less often than it was steered.

    Raises
    ------
    LogError
        If the file cannot be read, lacks a column, or holds steering that is none.
    """
    steering = read_steering_csv(path, options.column, degrees=options.degrees, until=options.until)
    times = np.array(steering.times)
    with csv_reader(path) as rows:
        header = [name.strip() for name in next(rows)]
        name = steering_column(header, options.column, path)
        columns = measured_columns(header, options.wishes, [name], path)
        kept = list(islice((row for row in rows if row), len(times)))
        values = _values(kept, {column.name: header.index(column.name) for column in columns.values()})
    channels, notes = channels_of(columns, times, values)
    angle = Channel("steering", f"column {name}", times, np.array(steering.angles))
    return Drive(str(path), {"steering": angle, **channels}, steering.start_time, notes, steering.warning)


def _values(kept: list[list[str]], places: dict[str, int]) -> dict[str, FloatArray]:
    return {
        name: np.array([_number(row[place]) if place < len(row) else np.nan for row in kept])
        for name, place in places.items()
    }


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return float("nan")
