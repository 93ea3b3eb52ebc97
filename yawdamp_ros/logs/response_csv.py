"""Runs as CSV files: one row a sample, SI units, full double precision."""

import csv
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from yawdamp_ros.logs.errors import LogError
from yawdamp_ros.stepping import Sample, TimeGrid

UNIT_COLUMNS = ("yaw", "yaw_rate", "lateral_acceleration")


def response_columns(unit_names: Sequence[str]) -> list[str]:
    """Column names of a run of these units."""
    joints = range(1, len(unit_names))
    return [
        "time",
        "steering_angle",
        *(f"{name}/{quantity}" for name in unit_names for quantity in UNIT_COLUMNS),
        *(f"articulation_{joint}" for joint in joints),
    ]


class ResponseCsv:
    """A CSV file that takes samples.

    Parameters
    ----------
    path : Path
        Written anew.
    unit_names : sequence of str
    grid : TimeGrid

    Raises
    ------
    LogError
        If the file cannot be written, here and at every write.
    """

    def __init__(self, path: Path, unit_names: Sequence[str], grid: TimeGrid) -> None:
        self._path = path
        self._grid = grid
        try:
            self._file = path.open("w", encoding="utf-8", newline="")
        except OSError as error:
            raise LogError(path, f"cannot be written: {error.strerror}") from error
        self._writer = csv.writer(self._file, lineterminator="\n")
        self._writer.writerow(response_columns(unit_names))

    def write(self, sample: Sample) -> None:
        """Append a sample of one or more instants."""
        instants = np.size(sample.step)
        units = np.stack([getattr(sample, quantity) for quantity in UNIT_COLUMNS], axis=-1)
        parts = (self._grid.seconds(sample.step), sample.steering_angle, units, sample.articulation)
        rows = np.hstack([np.reshape(part, (instants, np.size(part) // instants)) for part in parts])
        try:
            # repr of a float is the shortest text that reads back as the same double.
            self._writer.writerows(map(repr, row) for row in rows.tolist())
        except OSError as error:
            raise LogError(self._path, f"cannot be written: {error.strerror}") from error

    def close(self) -> None:
        """Finish the file."""
        try:
            self._file.close()
        except OSError as error:
            raise LogError(self._path, f"cannot be written: {error.strerror}") from error
