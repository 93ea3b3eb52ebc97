"""Swept surface of the bodies of a run, to scale."""

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.pictures.errors import PictureError
from yawdamp_ros.pictures.figure import COLOURS, new_figure, style
from yawdamp_ros.stepping import Response
from yawdamp_ros.vehicle import Unit, Vehicle, complete
from yawdamp_ros.vehicle.shape import extent

EVERY = 0.1
"""Way between outlines of the swept surface [m]."""
SHOWN = 7
"""Instants at which bodies are drawn."""
SURFACE = "#e2e4e8"


def swept_figure(name: str, response: Response, vehicle: Vehicle) -> Figure:
    """Draw the surface that all bodies sweep, with the paths of the outer front tyres and of the last axle.

    Parameters
    ----------
    name : str
        Name of the run.
    response : Response
        Response with x and y.
    vehicle : Vehicle
        Vehicle of the run; missing widths and overhangs are assumed.

    Returns
    -------
    Figure

    Raises
    ------
    PictureError
        If the run holds no paths, or is of other units.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> from yawdamp_ros.simulation import simulate
    >>> vehicle = load_vehicle("interlink")
    >>> run = simulate(vehicle, lambda _: 0.01, 3.0, sample_period=0.02)
    >>> swept_figure("run", run, vehicle).axes[0].get_title()
    'run: swept by interlink'
    """
    if response.unit_names != vehicle.unit_names:
        message = f"{name}: units {', '.join(response.unit_names)}: {vehicle.name} has others"
        raise PictureError(message)
    if not np.isfinite(response.x).all():
        message = f"{name}: it holds no paths"
        raise PictureError(message)
    units = complete(vehicle).units
    way = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(response.x[:, 0]), np.diff(response.y[:, 0])))])
    stations = np.arange(0.0, way[-1], EVERY)
    chosen = np.unique(np.searchsorted(way, stations))
    outlines = [_outline(unit, response, index) for index, unit in enumerate(units)]
    figure = new_figure(9.0, 7.0)
    axes = figure.add_subplot()
    for outline in outlines:
        axes.add_collection(PolyCollection(list(outline[chosen]), facecolor=SURFACE, edgecolor=SURFACE))
    drawn = np.searchsorted(way, np.linspace(0.0, way[-1], SHOWN)).clip(max=len(way) - 1)
    for index, outline in enumerate(outlines):
        for place in drawn:
            axes.add_patch(
                Polygon(
                    outline[place], facecolor="none", edgecolor=COLOURS[index % len(COLOURS)], linewidth=0.8
                )
            )
    front = max((axle for axle in units[0].axles if axle.steered), key=lambda axle: axle.position)
    wall = 0.5 * ((front.track_width or 0.0) + (front.tyre_width or 0.0))
    for side, label in ((wall, "outer walls of the front tyres"), (-wall, None)):
        axes.plot(*_point(response, 0, front.position, side), color=COLOURS[0], linewidth=1.2, label=label)
    last = min(axle.position for axle in units[-1].axles)
    axes.plot(
        *_point(response, len(units) - 1, last, 0.0),
        color="black",
        linewidth=1.0,
        linestyle="--",
        label="last axle",
    )
    axes.set_aspect("equal")
    axes.autoscale_view()
    style(axes, "x [m]", "y [m]", f"{name}: swept by {vehicle.name}")
    axes.legend(frameon=False, fontsize="small", loc="best")
    return figure


def _outline(unit: Unit, response: Response, index: int) -> FloatArray:
    """Corners of a body at every sample, shape (m, 4, 2)."""
    tail, nose = extent(unit)
    front, rear = nose + (unit.front_overhang or 0.0), tail - (unit.rear_overhang or 0.0)
    half = 0.5 * (unit.width or 0.0)
    corners = [(front, half), (front, -half), (rear, -half), (rear, half)]
    return np.stack([np.column_stack(_point(response, index, *corner)) for corner in corners], axis=1)


def _point(response: Response, unit: int, forward: float, left: float) -> tuple[FloatArray, FloatArray]:
    """Path of a point of a unit."""
    turned = complex(forward, left) * np.exp(1j * response.yaw[:, unit])
    return response.x[:, unit] + turned.real, response.y[:, unit] + turned.imag
