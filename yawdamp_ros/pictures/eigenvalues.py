"""Eigenvalues in the complex plane."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from yawdamp_ros.analysis import Locus
from yawdamp_ros.pictures.figure import UNSTABLE, add_legend, new_figure, style


def locus_figure(locus: Locus, parameter: str) -> Figure:
    """Draw the eigenvalues over a parameter, and their largest real part beside it.

    Parameters
    ----------
    locus : Locus
    parameter : str
        Name of the varied parameter, for the labels.

    Returns
    -------
    Figure
    """
    figure = new_figure(10.0, 4.8)
    plane, margin = figure.subplots(1, 2, width_ratios=(1.3, 1.0))
    shades = np.repeat(locus.values, locus.eigenvalues.shape[1])
    points = plane.scatter(
        locus.eigenvalues.real.ravel(), locus.eigenvalues.imag.ravel(), c=shades, cmap="viridis", s=12
    )
    start = locus.eigenvalues[0]
    plane.plot(start.real, start.imag, "x", color="black", markersize=7, label=f"at {locus.values[0]:.6g}")
    right = max(plane.get_xlim()[1], 0.0)
    plane.set_xlim(right=right)
    plane.axvspan(0.0, right, color=UNSTABLE, alpha=0.08, linewidth=0)
    plane.axvline(0.0, color=UNSTABLE, linewidth=1.0)
    style(plane, "real part, 1/s", "imaginary part, rad/s", "eigenvalues; unstable right of 0")
    figure.colorbar(points, ax=plane)

    largest = locus.eigenvalues[:, -1].real
    margin.plot(locus.values, largest, color="black", linewidth=1.4, label="largest real part")
    top = max(margin.get_ylim()[1], 0.0)
    margin.set_ylim(top=top)
    margin.axhspan(0.0, top, color=UNSTABLE, alpha=0.08, linewidth=0)
    margin.axhline(0.0, color=UNSTABLE, linewidth=1.0)
    for boundary in locus.boundaries:
        label = f"boundary at {boundary.value:.6g}"
        margin.axvline(boundary.value, color=UNSTABLE, linewidth=1.0, linestyle="--", label=label)
    style(margin, parameter, "largest real part, 1/s", "unstable above 0")
    margin.xaxis.label.set_fontsize("small")
    margin.xaxis.set_major_locator(MaxNLocator(5))
    add_legend(figure, 4)
    return figure
