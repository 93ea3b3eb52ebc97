"""Friction of the road over the distance along it."""

import csv
import math
from bisect import bisect_right
from collections.abc import Iterator
from io import StringIO
from pathlib import Path
from typing import NamedTuple

from yawdamp_ros.errors import one_line
from yawdamp_ros.files import read_text
from yawdamp_ros.simulation.errors import SimulationError
from yawdamp_ros.simulation.inputs import input_of

COLUMNS = ["distance", "friction"]
LONGEST = 10_000_000
"""Maximum length of a file in characters."""


class FrictionRoute(NamedTuple):
    """Patches of a road, each from a distance on until the next.

    Attributes
    ----------
    distances : tuple of float
        Distance of the lead unit from the start along its path, increasing [m].
    frictions : tuple of float

    Examples
    --------
    >>> from pathlib import Path
    >>> _ = Path("ice.csv").write_text(f"distance,friction{chr(10)}50,0.2{chr(10)}80,0.8")
    >>> route = FrictionRoute.read(Path("ice.csv"))
    >>> route.at(10.0), route.at(50.0), route.at(90.0)
    (None, 0.2, 0.8)
    """

    distances: tuple[float, ...]
    frictions: tuple[float, ...]

    @classmethod
    def read(cls, path: Path) -> "FrictionRoute":
        """Read a CSV file with the columns ``distance`` in m and ``friction``.

        Parameters
        ----------
        path : Path

        Returns
        -------
        FrictionRoute

        Raises
        ------
        SimulationError
            If the file cannot be read or is no such file; the message names the line and the value.
        """
        try:
            rows = list(_rows(read_text(path, LONGEST)))
        except OSError as error:
            raise _error(path, f"cannot be read: {error.strerror}") from error
        except UnicodeDecodeError as error:
            raise _error(path, "not UTF-8 text; expected a CSV file") from error
        except (csv.Error, ValueError) as error:
            raise _error(path, str(error)) from error
        return cls(*map(tuple, zip(*rows, strict=True)))

    def at(self, distance: float) -> float | None:
        """Friction at a distance [m]; None before the first patch."""
        place = bisect_right(self.distances, distance)
        return self.frictions[place - 1] if place else None


def _rows(text: str) -> Iterator[tuple[float, float]]:
    """Distance and friction of every row.

    Raises
    ------
    ValueError
        If a row is not valid; the message names it.
    """
    reader = csv.reader(StringIO(text.removeprefix("\ufeff")))
    header = [name.strip() for name in next(reader, [])]
    if sorted(header) != COLUMNS:
        message = f"line 1: columns {', '.join(header) or 'none'}: expected distance and friction"
        raise ValueError(message)
    kind, last = input_of("friction"), -math.inf
    assert kind is not None  # noqa: S101 - it is in the table
    for row in filter(None, reader):
        if len(row) != len(header):
            message = f"line {reader.line_num}: {len(row)} values: expected {len(header)}"
            raise ValueError(message)
        where = f"line {reader.line_num}: "
        values = {name: _number(where + name, value) for name, value in zip(header, row, strict=True)}
        distance, friction = values["distance"], values["friction"]
        if distance <= last:
            message = f"{where}distance: {distance:g}: expected more than {last:g}, that of the row before"
            raise ValueError(message)
        if not kind.low <= friction <= kind.high:
            message = f"{where}friction: {friction:g}: expected a number from {kind.low:g} to {kind.high:g}"
            raise ValueError(message)
        last = distance
        yield distance, friction
    if last == -math.inf:
        message = "no rows below the column names; expected at least one patch"
        raise ValueError(message)


def _number(where: str, text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        message = f"{where}: {text!r}: expected a finite number"
        raise ValueError(message)
    return number


def _error(path: Path, problem: str) -> SimulationError:
    return SimulationError(one_line(f"friction_file: {path}: {problem}"))
