"""Sweeps as CSV files; a row that broke off is dropped when the sweep goes on."""

import itertools
import os
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from yawdamp_ros.analysis.points import Points
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.files import regular
from yawdamp_ros.logs.sweep_file import another, describe, unusable

LONGEST_VALUE = 25
"""Characters of a number and its separator."""
ROWS_AT_ONCE = 10_000
"""Number of rows read at once."""


class SweepCsv:
    """A CSV file that takes the answers of a sweep, in order.

    Parameters
    ----------
    path : Path
        File with the beginning of the same sweep, which is continued, or a new file.
    definition : mapping
        Definition of the sweep, of types that JSON can hold.
    points : Points
        Points of the sweep, k of d coordinates each.
    columns : sequence of str
        Names of the coordinates of a point, then of the answers.

    Attributes
    ----------
    answers : ndarray, shape (m, a)
        Answers of the first m points, read from the file.

    Raises
    ------
    LogError
        If the file is of another sweep, or cannot be read or written.
    """

    def __init__(
        self, path: Path, definition: Mapping[str, object], points: Points, columns: Sequence[str]
    ) -> None:
        self._path = path
        self._points = points
        # Keys that vary together are one column, whose name holds commas.
        header = ",".join(f'"{name}"' if "," in name else name for name in columns) + "\n"
        self._header = header.encode()
        self._width = len(columns)
        self.answers = np.empty((0, self._width - points[:1].shape[1]))
        try:
            known = describe(path, definition) and self._read()
            self._file = path.open("a" if known else "w", encoding="utf-8", newline="")
            if not known:
                self._file.write(header)
        except (OSError, UnicodeDecodeError) as error:
            raise unusable(path, error) from error
        self._written = len(self.answers)

    def write(self, answers: FloatArray) -> None:
        """Append the answers of the next points, shape (chunk, a), and let them reach the file."""
        points = self._points[self._written : self._written + len(answers)]
        try:
            # repr of a float is the shortest text that reads back as the same double.
            self._file.writelines(
                ",".join(map(repr, row)) + "\n" for row in np.hstack([points, answers]).tolist()
            )
            self._file.flush()
        except OSError as error:
            raise unusable(self._path, error) from error
        self._written += len(answers)

    def close(self) -> None:
        """Finish the file."""
        try:
            self._file.close()
        except OSError as error:
            raise unusable(self._path, error) from error

    def _read(self) -> bool:
        """Take the answers from the file, less a last row that broke off; False without a header."""
        with regular(self._path).open("r+b") as file:
            header = file.readline(len(self._header))
            if header != self._header:
                if not self._header.startswith(header) or file.read(1):
                    raise another(self._path)
                return False
            end, found, longest = len(header), [self.answers], LONGEST_VALUE * self._width
            while rows := list(
                itertools.takewhile(
                    lambda row: row.endswith(b"\n"),
                    itertools.islice(iter(lambda: file.readline(longest), b""), ROWS_AT_ONCE),
                )
            ):
                found.append(self._answers(rows, sum(map(len, found))))
                end += sum(map(len, rows))
            left = file.seek(0, os.SEEK_END) - end
            if left >= longest:  # an incomplete row is never as long
                raise another(self._path)
            if left:
                file.truncate(end)
        self.answers = np.concatenate(found)
        return True

    def _answers(self, rows: Sequence[bytes], start: int) -> FloatArray:
        """Answers in rows of the file, which are of the points from a start on."""
        points = self._points[start : start + len(rows)]
        try:
            values = np.array([[*map(float, row.split(b","))] for row in rows], dtype=np.float64)
            values = values.reshape(len(rows), self._width)
        except ValueError as error:
            raise another(self._path) from error
        if not np.array_equal(values[:, : points.shape[1]], points):
            raise another(self._path)
        return values[:, points.shape[1] :]
