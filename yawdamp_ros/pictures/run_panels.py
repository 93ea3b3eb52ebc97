"""What a picture of runs shows, whatever draws it."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.pictures.errors import PictureError
from yawdamp_ros.pictures.figure import COLOURS
from yawdamp_ros.stepping import Response

MOST_RUNS = 6
"""More could not be told apart."""


class Curve(NamedTuple):
    """One quantity of one unit or joint of one run.

    Attributes
    ----------
    name : str
        Of the unit or the joint.
    run : int
        Index of the run.
    colour : str
    x, y : ndarray, shape (m,)
    """

    name: str
    run: int
    colour: str
    x: FloatArray
    y: FloatArray


class Panel(NamedTuple):
    """One pair of axes.

    Attributes
    ----------
    x_label, y_label, title : str
    curves : list of Curve
    held : bool
        Whether a value holds until the next.
    """

    x_label: str
    y_label: str
    title: str
    curves: list[Curve]
    held: bool = False


def run_panels(runs: Sequence[tuple[str, Response]]) -> list[Panel]:
    """Steer angle, yaw, yaw rate, lateral acceleration and, where there are any, articulation and paths.

    Parameters
    ----------
    runs : sequence of (str, Response)
        Each with the name it is called by; a response whose x and y are not finite gets no path.

    Returns
    -------
    list of Panel
        Colours tell units apart.

    Raises
    ------
    PictureError
        If there are more runs, or more units, than can be told apart.
    """
    responses = [response for _, response in runs]
    units = tuple(dict.fromkeys(unit for response in responses for unit in response.unit_names))
    _check_count("runs", len(runs), MOST_RUNS)
    _check_count("units", len(units), len(COLOURS))
    colours = dict(zip(units, COLOURS, strict=False))

    def of_units(x: Callable[[Response], FloatArray], y: Callable[[Response], FloatArray]) -> list[Curve]:
        return [
            Curve(unit, run, colours[unit], along, across)
            for run, response in enumerate(responses)
            for unit, along, across in zip(response.unit_names, x(response).T, y(response).T, strict=True)
        ]

    def time(response: Response) -> FloatArray:
        return np.broadcast_to(response.time[:, np.newaxis], response.yaw.shape)

    steering = [
        Curve("steer angle", run, COLOURS[-1], response.time, response.steering_angle)
        for run, response in enumerate(responses)
    ]
    articulation = [
        # Backwards from black, away from the colours of the units.
        Curve(f"articulation {joint + 1}", run, COLOURS[-1 - joint % len(COLOURS)], response.time, angles)
        for run, response in enumerate(responses)
        for joint, angles in enumerate(response.articulation.T)
    ]
    paths = of_units(lambda run: run.x, lambda run: run.y)
    panels = [
        Panel("time, s", "steer angle, rad", "", steering, held=True),
        Panel("time, s", "yaw, rad", "", of_units(time, lambda run: run.yaw)),
        Panel("time, s", "yaw rate, rad/s", "", of_units(time, lambda run: run.yaw_rate)),
        Panel(
            "time, s", "lateral acceleration, m/s²", "", of_units(time, lambda run: run.lateral_acceleration)
        ),
        Panel("time, s", "articulation, rad", "", articulation),
        Panel(
            "x, m",
            "y (left), m",
            "paths of the centres of gravity, scales unequal",
            [curve for curve in paths if np.isfinite(curve.x).all() and np.isfinite(curve.y).all()],
        ),
    ]
    return [panel for panel in panels if panel.curves]


def _check_count(what: str, count: int, most: int) -> None:
    if count > most:
        message = f"{count} {what} in one picture; expected at most {most}, or they look alike"
        raise PictureError(message)
