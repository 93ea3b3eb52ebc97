"""Steering logs in CSV files with named columns."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from yawdamp_ros.errors import one_line
from yawdamp_ros.logs.csv_file import csv_reader
from yawdamp_ros.logs.errors import LogError
from yawdamp_ros.logs.steering_log import LARGEST_ANGLE, SteeringLog
from yawdamp_ros.logs.time_units import SECONDS, time_unit

if TYPE_CHECKING:
    import _csv

TIME_COLUMNS = ("time", "time_s", "t", "timestamp", "time_ms", "time_us", "time_ns")
"""Names of the time column, in order of preference."""

ENOUGH = 1000
"""Number of samples that determine the unit of the times."""


def read_steering_csv(
    path: Path, column: str | None = None, *, degrees: bool = False, until: float = math.inf
) -> SteeringLog:
    """Read a steering log from a CSV file.

    Parameters
    ----------
    path : Path
        UTF-8, with a line of column names; one of them is in `TIME_COLUMNS`.
    column : str, optional
        Steering column; unless given, the one whose name contains ``steer``.
    degrees : bool
        Whether it holds degrees; a column whose name ends in ``_deg`` always does.
    until : float
        Time from the first sample on past which nothing is read [s].

    Returns
    -------
    SteeringLog
        Log with its first sample at 0 s. The name of the column or the size tells times in ms, us or ns,
        and its warning says so.

    Raises
    ------
    LogError
        If the file cannot be read, lacks a column, or holds a value that is none; the message names
        the line.

    Examples
    --------
    >>> from pathlib import Path
    >>> from yawdamp_ros.logs import read_steering_csv
    >>> read_steering_csv(Path("docs/recorded_drive.csv")).times[:2]
    [0.0, 0.04]
    """
    with csv_reader(path) as rows:
        return _parse(rows, path, column, degrees=degrees, until=until)


def _parse(
    reader: "_csv.Reader", path: Path, column: str | None, *, degrees: bool, until: float
) -> SteeringLog:
    header = [name.strip() for name in next(reader, [])]
    if not header:
        raise LogError(path, "empty; expected a line of column names")
    time_column = next((name for name in TIME_COLUMNS if name in header), None)
    if time_column is None:
        raise LogError(
            path, f"no time column; expected one of {', '.join(TIME_COLUMNS)} among {_listed(header)}"
        )
    angle_column = steering_column(header, column, path)
    at_time, at_angle = header.index(time_column), header.index(angle_column)
    scale = math.pi / 180.0 if degrees or angle_column.endswith("_deg") else 1.0
    times: list[float] = []
    angles: list[float] = []
    last = math.inf
    for row in reader:
        if not row:
            continue
        where = f"line {reader.line_num}"
        time = _number(row, at_time, time_column, where, path)
        if times and time < times[-1]:
            raise LogError(path, f"{where}: {time_column}: {time}: expected a time not before {times[-1]}")
        if len(times) == ENOUGH:
            last = times[0] + until * time_unit(time_column, times).per_second
        if time > last:
            break
        times.append(time)
        angle = scale * _number(row, at_angle, angle_column, where, path)
        if abs(angle) > LARGEST_ANGLE:
            raise LogError(
                path,
                f"{where}: {angle_column}: {row[at_angle]}: expected an angle within {LARGEST_ANGLE:g} rad",
            )
        angles.append(angle)
    if not times:
        raise LogError(path, "no samples after the line of column names")
    unit = time_unit(time_column, times[:ENOUGH])
    said = f"{path}: {time_column} is taken to be in {unit.name}" if unit is not SECONDS else ""
    return SteeringLog(
        str(path), [(time - times[0]) / unit.per_second for time in times], angles, warning=one_line(said)
    )


def steering_column(header: Sequence[str], column: str | None, path: Path) -> str:
    """Return the requested column, else the one named after steering.

    Raises
    ------
    LogError
        If there is no such column, or several are named so.
    """
    if column is not None:
        if column not in header:
            raise LogError(path, f"{column}: no such column; expected one of {_listed(header)}")
        return column
    candidates = [name for name in header if "steer" in name.lower()]
    if len(candidates) != 1:
        found = "several steering columns" if candidates else "no steering column"
        raise LogError(path, f"{found}; name one with --column: {_listed(candidates or header)}")
    return candidates[0]


def _number(row: Sequence[str], index: int, column: str, where: str, path: Path) -> float:
    if index >= len(row):
        raise LogError(path, f"{where}: {column}: missing, the line has {len(row)} values")
    try:
        value = float(row[index])
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise LogError(path, f"{where}: {column}: {row[index]!r}: expected a finite number")
    return value


def _listed(names: Sequence[str], limit: int = 12) -> str:
    shown = ", ".join(name[:40] for name in names[:limit])
    return shown if len(names) <= limit else f"{shown}, ..."
