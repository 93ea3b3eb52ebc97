"""The boundary of stability over two parameters, as a line through refined points."""

import numpy as np

from yawdamp_ros.analysis.study import Study
from yawdamp_ros.dynamics.kinematics import FloatArray

_HALVINGS = 50
"""Bisections of an edge of the grid; they leave 1e-15 of its length."""


def boundary_segments(study: Study, first: FloatArray, second: FloatArray) -> FloatArray:
    """Line on which the largest real part of the eigenvalues is 0.

    Bisection finds each place where stability changes along an edge of the grid, on all edges at once.
    Straight segments join the places on the edges of a cell. A boundary that enters and leaves a cell by the
    same edge is missed.

    Parameters
    ----------
    study : Study
        Study of two coordinates.
    first, second : ndarray, shape (a,) and (b,)
        Values of each coordinate on the grid, rising or falling.

    Returns
    -------
    ndarray, shape (s, 2, 2)
        Segments, the two ends of each, the coordinates of an end.
    """
    x, y = np.meshgrid(first, second, indexing="ij")
    corners = np.stack([x, y], axis=-1)
    unstable = _unstable(study, corners)
    along_first = _crossings(study, corners[:-1], corners[1:], unstable[:-1] != unstable[1:])
    along_second = _crossings(study, corners[:, :-1], corners[:, 1:], unstable[:, :-1] != unstable[:, 1:])
    # Edges of cell (i, j) in turn: below, right, above, left.
    edges = np.stack([along_first[:, :-1], along_second[1:], along_first[:, 1:], along_second[:-1]], axis=2)
    crossed = np.isfinite(edges[..., 0])
    simple = crossed.sum(axis=-1) == 2  # noqa: PLR2004 - in by one edge and out by another
    segments = [edges[simple][crossed[simple]].reshape(-1, 2, 2)]
    saddles = crossed.all(axis=-1)
    if saddles.any():
        middles = 0.25 * (corners[:-1, :-1] + corners[1:, :-1] + corners[:-1, 1:] + corners[1:, 1:])
        # If the middle is as stable as the lower left corner, the boundary does not cut that corner off.
        joined = _unstable(study, middles[saddles]) == unstable[:-1, :-1][saddles]
        order = np.where(joined[:, np.newaxis], [[0, 1, 2, 3]], [[3, 0, 1, 2]])
        ends = np.take_along_axis(edges[saddles], order[..., np.newaxis], axis=1)
        segments.append(ends.reshape(-1, 2, 2))
    return np.concatenate(segments)


def _crossings(study: Study, starts: FloatArray, ends: FloatArray, changes: FloatArray) -> FloatArray:
    """Place on every edge at which stability changes, NaN on those where it does not."""
    found = np.full(starts.shape, np.nan)
    if changes.any():
        low, high = starts[changes], ends[changes]
        at_low = _unstable(study, low)
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            as_low = (_unstable(study, middle) == at_low)[:, np.newaxis]
            low, high = np.where(as_low, middle, low), np.where(as_low, high, middle)
        found[changes] = 0.5 * (low + high)
    return found


def _unstable(study: Study, points: FloatArray) -> FloatArray:
    flat = points.reshape(-1, points.shape[-1])
    largest = study.eigenvalues(flat).real.max(axis=1)
    return np.asarray(largest > 0.0).reshape(points.shape[:-1])
