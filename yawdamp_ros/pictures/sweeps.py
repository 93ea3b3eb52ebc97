"""Curves, maps and histograms of sweeps, the boundary of stability drawn in."""

from collections.abc import Sequence

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from yawdamp_ros.analysis import Boundary, Variation
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.pictures.figure import GREY, STABLE, UNSTABLE, new_figure, style


def curve_figure(axis: Variation, values: FloatArray, name: str, boundaries: Sequence[Boundary]) -> Figure:
    """Draw a measure over one parameter.

    Parameters
    ----------
    axis : Variation
    values : ndarray, shape (k,)
    name : str
        Name of the drawn quantity.
    boundaries : sequence of Boundary

    Returns
    -------
    Figure
    """
    figure = new_figure(7.0, 4.4)
    axes = figure.subplots()
    axes.plot(axis.values, values, color=STABLE, linewidth=1.4, label=name)
    for boundary in boundaries:
        label = f"boundary of stability at {boundary.value:.6g}"
        axes.axvline(boundary.value, color=UNSTABLE, linewidth=1.2, linestyle="--", label=label)
    style(axes, axis.label, name)
    axes.legend(fontsize="small")
    return figure


def map_figure(axes: tuple[Variation, ...], values: FloatArray, name: str, segments: FloatArray) -> Figure:
    """Draw a measure over two parameters, grey where it has no value.

    Parameters
    ----------
    axes : tuple of Variation
        Two.
    values : ndarray, shape (a b,)
        Values, the second parameter varying fastest.
    name : str
        Name of the drawn quantity.
    segments : ndarray, shape (s, 2, 2)
        Segments of the boundary of stability.

    Returns
    -------
    Figure
    """
    first, second = axes
    figure = new_figure(7.4, 5.4)
    plane = figure.subplots()
    plane.set_facecolor(GREY)
    table = np.ma.masked_invalid(values.reshape(len(first.values), len(second.values)))
    mesh = plane.pcolormesh(first.values, second.values, table.T, cmap="viridis", shading="nearest")
    plane.add_collection(LineCollection(list(segments), colors=UNSTABLE, linewidths=2.0))
    style(plane, first.label, second.label, "orange: the boundary of stability" if len(segments) else "")
    plane.grid(visible=False)
    figure.colorbar(mesh, ax=plane, label=name)
    return figure


def histogram_figure(values: FloatArray, name: str) -> Figure:
    """Draw how a measure is distributed.

    Parameters
    ----------
    values : ndarray, shape (k,)
        NaN where it has no value.
    name : str

    Returns
    -------
    Figure
    """
    figure = new_figure(7.0, 4.4)
    axes = figure.subplots()
    axes.hist(values[~np.isnan(values)], bins=60, color=STABLE)
    style(axes, name, "vehicles")
    return figure
