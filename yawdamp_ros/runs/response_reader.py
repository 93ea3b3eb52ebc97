"""Runs read back from the CSV files that `simulate` writes."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields
from pathlib import Path

import numpy as np

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.logs import LogError
from yawdamp_ros.logs.csv_file import csv_reader
from yawdamp_ros.runs import outputs
from yawdamp_ros.runs.response_csv import ground_columns
from yawdamp_ros.stepping import Response

LARGEST_VALUE = 1e30
"""Largest value of any quantity of a run; a larger one could not be drawn."""


def read_response_csv(path: Path) -> Response:
    """Read a run.

    Parameters
    ----------
    path : Path
        Columns ``time``, ``steering_angle``, for every unit ``<unit>/yaw``, ``<unit>/yaw_rate`` and
        ``<unit>/lateral_acceleration``, and ``articulation_1`` onwards, in any order; SI units. Those of the
        other outputs of one number are read where they are there.

    Returns
    -------
    Response
        Response of the file; x and y are NaN if the file holds no paths.

    Raises
    ------
    LogError
        If the file cannot be read or is no run; the message names the column or the line.

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
    >>> read_response_csv(Path("run.csv")).unit_names
    ('truck', 'trailer')
    """
    with csv_reader(path) as rows:
        return _parse(rows, path)


def _parse(rows: Iterator[list[str]], path: Path) -> Response:
    header = [name.strip() for name in next(rows, [])]
    units = tuple(name.removesuffix("/yaw") for name in header if name.endswith("/yaw"))
    if not units:
        raise LogError(path, "no column <unit>/yaw; expected a run as simulate --output FILE.csv writes it")
    needed = {field.name for field in fields(Response)}
    # A single unit has no articulation: no column, and an array of none.
    known = {
        output.name: names
        for output in outputs.OUTPUTS
        if output.unit and ((names := output.names(units)) or output.name in needed)
    }
    expected = ["time", *(name for key in known if key in needed for name in known[key])]
    places = {name: place for place, name in enumerate(header)}
    if len(places) < len(header):
        twice = next(name for place, name in enumerate(header) if places[name] != place)
        raise LogError(path, f"column {twice}: twice; expected every column once")
    for name in expected:
        if name not in places:
            raise LogError(path, f"no column {name}; it has {', '.join(header)}")
    table = np.array([_numbers(row, header, number, path) for number, row in enumerate(rows, 2) if row])
    if not len(table):
        raise LogError(path, "no rows below the column names; expected at least one sample")
    found = {
        key: table[:, [places[name] for name in names]]
        for key, names in known.items()
        if places.keys() >= set(names)
    }
    ground = _ground(table, places, units)
    return Response(
        unit_names=units,
        time=table[:, places["time"]],
        steering_angle=found["steering_angle"][:, 0],
        yaw=found["yaw"],
        yaw_rate=found["yaw_rate"],
        lateral_acceleration=found["lateral_acceleration"],
        articulation=found["articulation"],
        x=ground[:, ::2],
        y=ground[:, 1::2],
        extra={key: values for key, values in found.items() if key not in needed},
    )


def _ground(table: FloatArray, places: Mapping[str, int], units: Sequence[str]) -> FloatArray:
    """Columns x and y of every unit; NaN if the file holds no paths."""
    names = ground_columns(units)[1:]
    if not places.keys() >= set(names):
        return np.full((len(table), len(names)), np.nan)
    return np.asarray(table[:, [places[name] for name in names]], dtype=np.float64)


def _numbers(row: list[str], header: list[str], line: int, path: Path) -> list[float]:
    if len(row) != len(header):
        raise LogError(path, f"line {line}: {len(row)} values; expected {len(header)}")
    numbers = []
    for name, text in zip(header, row, strict=True):
        try:
            number = float(text)
        except ValueError as error:
            raise LogError(path, f"line {line}: {name}: {text!r}: expected a number") from error
        if not math.isfinite(number):
            raise LogError(path, f"line {line}: {name}: {text}: expected a finite number")
        if abs(number) > LARGEST_VALUE:
            raise LogError(path, f"line {line}: {name}: {text}: expected a number within {LARGEST_VALUE:g}")
        numbers.append(number)
    return numbers
