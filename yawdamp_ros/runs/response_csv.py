"""Runs as CSV files: one row a sample, SI units, full double precision."""

import csv
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from yawdamp_ros.logs import LogError
from yawdamp_ros.runs.outputs import available, columns
from yawdamp_ros.stepping import Motion, Sample, TimeGrid


def ground_columns(unit_names: Sequence[str]) -> list[str]:
    """Last columns of a run: speed of the lead unit, and position of every unit."""
    return ["speed", *(f"{unit}/{axis}" for unit in unit_names for axis in ("x", "y"))]


class ResponseCsv:
    """A CSV file that accepts samples.

    Parameters
    ----------
    path : Path
        File to write; an existing one is overwritten.
    motion : Motion
        Motion that the samples come from.
    grid : TimeGrid

    Raises
    ------
    LogError
        If the file cannot be written, here and at every write.

    Examples
    --------
    >>> from pathlib import Path
    >>> from yawdamp_ros import load_vehicle
    >>> from yawdamp_ros.runs import ResponseCsv, read_response_csv
    >>> from yawdamp_ros.simulation import make_motion
    >>> from yawdamp_ros.stepping import TimeGrid
    >>> motion = make_motion(load_vehicle("truck_trailer"), "consistent", speed=20.0, step_size=0.001)
    >>> file = ResponseCsv(Path("run.csv"), motion, TimeGrid.of(0.001, 0.01))
    >>> file.write(motion.run([0.02] * 1000, steps_per_sample=10))
    >>> file.close()
    >>> read_response_csv(Path("run.csv")).time.size
    100
    """

    def __init__(self, path: Path, motion: Motion, grid: TimeGrid) -> None:
        self._path = path
        self._grid = grid
        vehicle = motion.vehicle
        axles = [len(unit.axles) for unit in vehicle.units]
        self._columns = columns(available(motion.quantity_names), vehicle.unit_names, axles)
        try:
            self._file = path.open("w", encoding="utf-8", newline="")
        except OSError as error:
            raise LogError(path, f"cannot be written: {error.strerror}") from error
        self._writer = csv.writer(self._file, lineterminator="\n")
        ground = ground_columns(vehicle.unit_names)
        self._writer.writerow(["time", *(name for name, _, _ in self._columns), *ground])

    def write(self, sample: Sample) -> None:
        """Append a sample of one or more instants."""
        instants = np.size(sample.step)
        values = {output.name: output.values(sample) for _, output, _ in self._columns}
        path = np.stack([sample.x, sample.y], axis=-1).reshape(instants, -1)
        speed = sample.velocity[..., 0].real.reshape(instants, 1)
        known = 1 + len(self._columns)
        rows = np.empty((instants, known + 1 + path.shape[1]))
        rows[:, known:] = np.hstack([speed, path])
        rows[:, 0] = self._grid.seconds(sample.step)
        for place, (_, output, index) in enumerate(self._columns, 1):
            rows[:, place] = np.reshape(values[output.name], (instants, -1))[:, index]
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
