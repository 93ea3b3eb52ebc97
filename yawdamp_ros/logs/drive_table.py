"""Channels of a table: columns found by their names, or named."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from yawdamp_ros.drives import UNITS, Channel, quantity_of
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.logs.channel_names import Wish, listed, named, unit_in
from yawdamp_ros.logs.errors import LogError

LARGEST_VALUE = 1e12
"""Largest value of any channel; a larger one is no measurement."""


class Column(NamedTuple):
    """Use of a column.

    Attributes
    ----------
    name : str
    scale : float
    """

    name: str
    scale: float


def measured_columns(
    header: Sequence[str], wishes: Sequence[Wish], taken: Sequence[str], source: object
) -> dict[str, Column]:
    """Column of every channel but the steering.

    Parameters
    ----------
    header : sequence of str
    wishes : sequence of Wish
    taken : sequence of str
        Columns that hold something else.
    source : object
        Name of the file in error messages.

    Raises
    ------
    LogError
        If a requested column is missing.
    """
    columns: dict[str, Column] = {}
    for name in header:
        told = None if name in taken else named(name)
        if told is not None:
            columns.setdefault(told.channel, Column(name, UNITS[told.unit][1]))
    for wish in wishes:
        if wish.place not in header:
            raise LogError(source, f"{wish.place}: no such column; expected one of {listed(header)}")
        unit = wish.unit or unit_in(wish.place, quantity_of(wish.channel))
        columns[wish.channel] = Column(wish.place, wish.sign * UNITS[unit][1])
    return columns


def channels_of(
    columns: Mapping[str, Column], times: FloatArray, values: Mapping[str, FloatArray]
) -> tuple[dict[str, Channel], tuple[str, ...]]:
    """Channels of columns, without cells that are not numbers, and notes on the omissions.

    Parameters
    ----------
    columns : mapping of str to Column
        Columns by channel.
    times : ndarray, shape (m,)
        Times [s].
    values : mapping of str to ndarray, shape (m,)
        Values by column; NaN where a value is missing.
    """
    channels, notes = {}, []
    for name, column in columns.items():
        given = values[column.name]
        good = np.isfinite(given) & (np.abs(given) <= LARGEST_VALUE)
        if missing := int(len(given) - np.count_nonzero(good)):
            notes.append(f"{name}: {missing} of {len(given)} values of {column.name} are no numbers")
        if good.any():
            source = f"column {column.name}"
            if column.scale != 1.0:
                source += f" times {column.scale:.6g}"
            channels[name] = Channel(name, source, times[good], column.scale * given[good])
    return channels, tuple(notes)
