"""Points of a sweep, made part by part: a million of them take no more memory than a thousand."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from yawdamp_ros.dynamics.kinematics import FloatArray


class Points(Protocol):
    """Points of d coordinates: an array, or an object that makes parts of one on request."""

    def __len__(self) -> int:
        """Return the number of points."""

    def __getitem__(self, part: slice, /) -> FloatArray:
        """Points of a slice, shape (k, d)."""


@dataclass(frozen=True)
class Grid:
    """Every combination of the values of some axes, the last varying fastest.

    Attributes
    ----------
    axes : sequence of sequence of float

    Examples
    --------
    >>> Grid([[1.0, 2.0], [3.0, 4.0]])[1:3].tolist()
    [[1.0, 4.0], [2.0, 3.0]]
    """

    axes: Sequence[Sequence[float]]

    def __len__(self) -> int:
        return math.prod(map(len, self.axes))

    def __getitem__(self, part: slice, /) -> FloatArray:
        places = np.unravel_index(np.arange(len(self))[part], [*map(len, self.axes)])
        return np.column_stack(
            [np.asarray(axis, float)[place] for axis, place in zip(self.axes, places, strict=True)]
        )


@dataclass(frozen=True)
class Draws:
    """Points drawn evenly and independently from ranges, the same for the same seed.

    Attributes
    ----------
    spans : sequence of (float, float)
        Range of each coordinate.
    count, seed : int

    Examples
    --------
    >>> drawn = Draws([(0.0, 1.0), (5.0, 6.0)], 1000, seed=3)
    >>> drawn[10:20].shape, (drawn[10:20] == drawn[:][10:20]).all()
    ((10, 2), np.True_)
    """

    spans: Sequence[tuple[float, float]]
    count: int
    seed: int

    def __len__(self) -> int:
        return self.count

    def __getitem__(self, part: slice, /) -> FloatArray:
        start, stop, _ = part.indices(self.count)
        source = np.random.PCG64(self.seed)
        source.advance(start * len(self.spans))  # one number for each coordinate
        lows, highs = np.array(self.spans).T
        return np.random.Generator(source).uniform(lows, highs, (max(stop - start, 0), len(self.spans)))
