"""Sweeps as directories of Parquet files, which pandas, Dask and others read as one table.

A Parquet file cannot be appended to, so that rows come in parts; an existing part is complete.
"""

import time
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import pyarrow as pa
from pyarrow import parquet

from yawdamp_ros.analysis.points import Points
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.logs.sweep_file import another, describe, unusable

ROWS = 10_000
"""Rows of a part."""
PATIENCE = 60.0
"""Seconds after which a part is written however few rows there are."""


class SweepParquet:
    """A directory of Parquet files that takes the answers of a sweep, in order.

    Parameters
    ----------
    path : Path
        Directory with the beginning of the same sweep, which is continued, or a new directory.
    definition, points, columns
        As for `SweepCsv`.

    Attributes
    ----------
    answers : ndarray, shape (m, a)
        Answers of the first m points, read from the parts.

    Raises
    ------
    LogError
        If the directory is of another sweep, or cannot be read or written.
    """

    def __init__(
        self, path: Path, definition: Mapping[str, object], points: Points, columns: Sequence[str]
    ) -> None:
        self._path, self._points, self._columns = path, points, list(columns)
        self._parts = 0
        self.answers = np.empty((0, len(self._columns) - points[:1].shape[1]))
        try:
            if describe(path, definition):
                self._read()
            path.mkdir(exist_ok=True)
        except (OSError, UnicodeDecodeError) as error:
            raise unusable(path, error) from error
        self._written = len(self.answers)
        self._held: list[FloatArray] = []
        self._since = time.monotonic()

    def write(self, answers: FloatArray) -> None:
        """Take the answers of the next points, shape (chunk, a)."""
        self._held.append(answers)
        if sum(map(len, self._held)) >= ROWS or time.monotonic() - self._since >= PATIENCE:
            self.close()

    def close(self) -> None:
        """Write the answers that are not yet in a part."""
        if not self._held:
            return
        answers = np.concatenate(self._held)
        points = self._points[self._written : self._written + len(answers)]
        table = pa.table(dict(zip(self._columns, [*points.T, *answers.T], strict=True)))
        try:
            # Readers pass over names that begin with a dot.
            unfinished = self._path / ".part"
            parquet.write_table(table, unfinished)
            unfinished.replace(self._part(self._parts))
        except OSError as error:
            raise unusable(self._path, error) from error
        self._parts += 1
        self._written += len(answers)
        self._held, self._since = [], time.monotonic()

    def _part(self, index: int) -> Path:
        return self._path / f"part-{index:06}.parquet"

    def _read(self) -> None:
        found, start = [self.answers], 0
        while (part := self._part(self._parts)).exists():
            try:
                table = parquet.read_table(part)
            except pa.ArrowException as error:
                raise another(self._path) from error
            if table.column_names != self._columns:
                raise another(self._path)
            values = np.column_stack([column.to_numpy() for column in table.columns])
            points = self._points[start : start + len(values)]
            if not np.array_equal(values[:, : points.shape[1]], points):
                raise another(self._path)
            found.append(values[:, points.shape[1] :])
            start += len(values)
            self._parts += 1
        self.answers = np.concatenate(found)
