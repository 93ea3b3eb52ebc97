"""Sweeps as CSV files that an interrupted sweep goes on from.

Beside the file lies another, its name with ``.json`` added, that says what the sweep is: vehicle file,
changes, model, keys, points and measure. A sweep goes on from a file only where all of that is the same and
the points in the rows are its own; rows are written in the order of the points, so that those missing are
the last ones. A row that broke off is dropped.
"""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.files import read_text
from yawdamp_ros.logs.errors import LogError

LARGEST_DESCRIPTION = 1 << 22
"""Characters of what says which sweep a file holds, a vehicle file among it."""

LONGEST_VALUE = 25
"""Characters of a number and what follows it."""


class SweepCsv:
    """A CSV file that takes the answers of a sweep, in order.

    Parameters
    ----------
    path : Path
        Gone on from where it holds the beginning of the same sweep, else written anew.
    definition : mapping
        All that makes the sweep what it is, of what JSON can hold.
    points : ndarray, shape (k, d)
    columns : sequence of str
        Names of the coordinates of a point, then of the answers.

    Attributes
    ----------
    answers : ndarray, shape (m, a)
        Read from the file: of the first m points.

    Raises
    ------
    LogError
        If the file is of another sweep, or cannot be read or written.
    """

    def __init__(
        self, path: Path, definition: Mapping[str, object], points: FloatArray, columns: Sequence[str]
    ) -> None:
        self._path = path
        self._points = points
        self._columns = list(columns)
        described = json.dumps(definition, indent=2) + "\n"
        description = path.with_name(f"{path.name}.json")
        try:
            if path.exists():
                self._check(description, described)
                self.answers = self._read()
                self._file = path.open("a", encoding="utf-8", newline="")
            else:
                description.write_text(described, encoding="utf-8")
                self.answers = np.empty((0, len(columns) - points.shape[1]))
                self._file = path.open("w", encoding="utf-8", newline="")
                self._file.write(self._header())
        except (OSError, UnicodeDecodeError) as error:
            raise self._unusable(error) from error
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
            raise self._unusable(error) from error
        self._written += len(answers)

    def close(self) -> None:
        """Finish the file."""
        try:
            self._file.close()
        except OSError as error:
            raise self._unusable(error) from error

    def _check(self, description: Path, described: str) -> None:
        if not description.exists() or read_text(description, LARGEST_DESCRIPTION) != described:
            raise self._other()

    def _read(self) -> FloatArray:
        """Answers in the file, which loses a last row that broke off."""
        text = read_text(self._path, LONGEST_VALUE * (1 + self._points.shape[0]) * len(self._header()))
        whole = text[: text.rfind("\n") + 1]
        header, *rows = whole.split("\n")[:-1] or [""]
        if not whole:
            if not self._header().startswith(text):
                raise self._other()
            self._path.write_text(self._header(), encoding="utf-8")
            return np.empty((0, len(self._columns) - self._points.shape[1]))
        try:
            values = np.array([list(map(float, row.split(","))) for row in rows], dtype=np.float64)
            values = values.reshape(len(rows), len(self._columns))
        except ValueError as error:
            raise self._other() from error
        split = self._points.shape[1]
        if header + "\n" != self._header() or not np.array_equal(
            values[:, :split], self._points[: len(values)]
        ):
            raise self._other()
        if len(whole) < len(text):
            self._path.write_text(whole, encoding="utf-8")
        return values[:, split:]

    def _header(self) -> str:
        # Keys that vary together are one column, whose name holds commas.
        return ",".join(f'"{name}"' if "," in name else name for name in self._columns) + "\n"

    def _other(self) -> LogError:
        return LogError(
            self._path, "is there and is not of this sweep; expected a new name, or the same sweep"
        )

    def _unusable(self, error: OSError | UnicodeDecodeError) -> LogError:
        return LogError(self._path, f"cannot be used: {getattr(error, 'strerror', None) or error}")
