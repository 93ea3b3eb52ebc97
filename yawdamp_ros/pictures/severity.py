"""Stability over severity: eigenvalues, and the handling diagram of every unit."""

import numpy as np
from matplotlib.figure import Figure

from yawdamp_ros.analysis.severity import FASTEST_MODE, Severity
from yawdamp_ros.pictures.figure import COLOURS, UNSTABLE, new_figure, style
from yawdamp_ros.vehicle import STANDARD_GRAVITY


def severity_figure(found: Severity) -> Figure:
    """Draw the eigenvalues of ever harder turns, and beside them the handling diagram.

    Parameters
    ----------
    found : Severity

    Returns
    -------
    Figure
    """
    figure = new_figure(10.0, 4.8)
    plane, handling = figure.subplots(1, 2, width_ratios=(1.2, 1.0))
    turns = found.values / STANDARD_GRAVITY
    rising = "braking, g" if found.straight else "lateral acceleration, g"
    eigenvalues = np.where(np.abs(found.eigenvalues) < FASTEST_MODE, found.eigenvalues, np.nan)
    shades = np.repeat(turns, eigenvalues.shape[1])
    points = plane.scatter(eigenvalues.real.ravel(), eigenvalues.imag.ravel(), c=shades, cmap="viridis", s=12)
    right = max(plane.get_xlim()[1], 0.5)
    plane.set_xlim(left=-15.0, right=right)
    plane.axvspan(0.0, right, color=UNSTABLE, alpha=0.08, linewidth=0)
    plane.axvline(0.0, color=UNSTABLE, linewidth=1.0)
    style(plane, "real part, 1/s", "imaginary part, rad/s", "eigenvalues; unstable right of 0")
    figure.colorbar(points, ax=plane, label=rising)
    for unit, name in enumerate(found.vehicle.unit_names):
        label = f"{name}: steer beyond Ackermann" if unit == 0 else f"{name}: slip at its axles"
        handling.plot(
            np.degrees(found.handling[:, unit]), turns, color=COLOURS[unit % len(COLOURS)], label=label
        )
    style(handling, "angle, degrees", rising, "handling diagram")
    handling.legend(fontsize="small", loc="best")
    return figure
