"""Messages serialised once and then filled with numbers: much faster than serialising each."""

import struct
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
from rclpy.serialization import serialize_message

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.stepping.time_grid import SECOND

ENCAPSULATION = 4
"""Bytes before the body of a message in CDR; fields are aligned from the body on."""
ALIGNMENT = 8


class Blank(NamedTuple):
    """A message to be filled in.

    Attributes
    ----------
    message : object
        Whatever is not filled in, it keeps. Its header, if it has one, comes first.
    columns : dict of str to int
        Path of each double to be filled in, as in ``twist.linear.x`` or ``position.0``, and the column of the
        values that it is filled with.
    """

    message: Any
    columns: Mapping[str, int]


class Templates:
    """Messages of one instant, laid end to end, so that all their numbers are written at once.

    Parameters
    ----------
    blanks : sequence of Blank
        Blanks whose doubles are overwritten.
    """

    def __init__(self, blanks: Sequence[Blank]) -> None:
        self._spans: list[tuple[int, int]] = []
        places: list[int] = []
        columns: list[int] = []
        stamps: list[int] = []
        row = b""
        for blank in blanks:
            # A body starts at a multiple of the alignment, so that every double does.
            row += bytes(-(len(row) + ENCAPSULATION) % ALIGNMENT)
            data, found = _serialised(blank)
            begin = len(row)
            row += data
            self._spans.append((begin, len(row)))
            places += [(begin + place) // 8 for place in found]
            columns += blank.columns.values()
            if hasattr(blank.message, "header"):
                stamps.append((begin + ENCAPSULATION) // 4)
        row += bytes(-len(row) % ALIGNMENT)
        self._row = np.frombuffer(row, dtype=np.uint8)
        self._places, self._columns = np.array(places), np.array(columns)
        self._stamps = np.array(stamps)

    def filled(self, values: FloatArray, stamps: Sequence[int]) -> list[list[bytes]]:
        """Messages of m instants in CDR, in the order of the blanks.

        Parameters
        ----------
        values : ndarray, shape (m, columns)
        stamps : sequence of int
            Stamps of the message headers [ns].
        """
        rows = np.empty((len(stamps), len(self._row)), dtype=np.uint8)
        rows[:] = self._row
        rows.view("<f8")[:, self._places] = values[:, self._columns]
        seconds, nanoseconds = zip(*(divmod(stamp, SECOND) for stamp in stamps), strict=True)
        words: npt.NDArray[np.uint32] = rows.view("<u4")
        words[:, self._stamps] = np.array(seconds, dtype=np.uint32)[:, np.newaxis]
        words[:, self._stamps + 1] = np.array(nanoseconds, dtype=np.uint32)[:, np.newaxis]
        return [[data[begin:end] for begin, end in self._spans] for data in map(bytes, rows)]


def _serialised(blank: Blank) -> tuple[bytes, list[int]]:
    """Message in CDR, and the place of each double to be filled in."""
    # Numbers that occur nowhere else show where their fields are.
    marks = [1e300 + 1e290 * index for index in range(len(blank.columns))]
    for path, mark in zip(blank.columns, marks, strict=True):
        _set(blank.message, path, mark)
    data: bytes = serialize_message(blank.message)
    return data, [data.index(struct.pack("<d", mark)) for mark in marks]


def _set(message: Any, path: str, value: float) -> None:  # noqa: ANN401 - generated classes share no base
    *parents, last = path.split(".")
    for parent in parents:
        message = getattr(message, parent)
    if last.isdigit():
        message[int(last)] = value
    else:
        setattr(message, last, value)
