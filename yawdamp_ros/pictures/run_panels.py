"""Panels of a picture of runs, for every renderer."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.dynamics.linear_range import LINEAR_ARTICULATION, LINEAR_LATERAL_ACCELERATION
from yawdamp_ros.pictures.errors import PictureError
from yawdamp_ros.pictures.figure import COLOURS
from yawdamp_ros.runs import outputs
from yawdamp_ros.runs.outputs import Of, Output, quantity
from yawdamp_ros.stepping import Response

LINEAR_UP_TO = {"lateral_acceleration": LINEAR_LATERAL_ACCELERATION, "articulation": LINEAR_ARTICULATION}
"""Magnitude of a quantity past which a truck leaves the linear range."""
MOST_RUNS = 6
"""Largest number of runs that a picture can distinguish."""


class Curve(NamedTuple):
    """One quantity of one unit or joint of one run.

    Attributes
    ----------
    name : str
        Name of the unit or the joint.
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
    linear_up_to : float or None
        Magnitude past which a truck leaves the linear range; beyond, the panel is shaded.
    marks : tuple of (float, str)
        Instants to be marked [s], each with what happened.
    """

    x_label: str
    y_label: str
    title: str
    curves: list[Curve]
    held: bool = False
    linear_up_to: float | None = None
    marks: tuple[tuple[float, str], ...] = ()


def marks_of(responses: Sequence[Response]) -> tuple[tuple[float, str], ...]:
    """Time [s] and name of the first event of each kind and unit."""
    found: dict[tuple[int, str, str], float] = {}
    for run, response in enumerate(responses):
        for event, time in zip(response.events, response.event_times, strict=True):
            found.setdefault((run, event.name, event.where.partition(",")[0]), time)
    return tuple((time, f"{name.replace('_', ' ')} of {where}") for (_, name, where), time in found.items())


def bands(panel: Panel) -> list[tuple[float, float]]:
    """Ranges of a panel's values that lie beyond the linear range."""
    if panel.linear_up_to is None:
        return []
    values = np.concatenate([curve.y for curve in panel.curves])
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    found = []
    if high > panel.linear_up_to:
        found.append((panel.linear_up_to, high))
    if low < -panel.linear_up_to:
        found.append((low, -panel.linear_up_to))
    return found


def run_panels(runs: Sequence[tuple[str, Response]]) -> list[Panel]:
    """Return a panel for every output of one number in a run, and for its paths.

    Parameters
    ----------
    runs : sequence of (str, Response)
        Runs, each with its name; a response whose x and y are not finite gets no path.

    Returns
    -------
    list of Panel
        Colours tell units apart.

    Raises
    ------
    PictureError
        If there are more runs, or more units, than a picture can distinguish.
    """
    responses = [response for _, response in runs]
    units = tuple(dict.fromkeys(unit for response in responses for unit in response.unit_names))
    _check_count("runs", len(runs), MOST_RUNS)
    _check_count("units", len(units), len(COLOURS))
    colours = dict(zip(units, COLOURS, strict=False))

    def curves(output: Output) -> list[Curve]:
        return [
            Curve(name, run, colour, response.time, values)
            for run, response in enumerate(responses)
            if has(response, output)
            for name, colour, values in zip(
                *_named(output, response.unit_names, colours), _columns(response, output), strict=False
            )
        ]

    paths = [
        Curve(unit, run, colours[unit], x, y)
        for run, response in enumerate(responses)
        for unit, x, y in zip(response.unit_names, response.x.T, response.y.T, strict=True)
        if np.isfinite(x).all() and np.isfinite(y).all()
    ]
    marks = marks_of(responses)
    linear = any("roll" not in response.extra for response in responses)  # no linear model rolls
    panels = [
        Panel(
            "time, s",
            f"{output.description}, {output.unit.replace('^2', '²')}",
            "",
            curves(output),
            output.held,
            LINEAR_UP_TO.get(output.name) if linear else None,
            marks,
        )
        for output in outputs.OUTPUTS
        if output.unit and output.of is not Of.WHEEL  # more curves than a panel can tell apart
    ]
    panels.append(Panel("x, m", "y (left), m", "paths of the centres of gravity, scales unequal", paths))
    return [panel for panel in panels if panel.curves]


def has(response: Response, output: Output) -> bool:
    """Return whether a response holds an output."""
    return output.name in response.extra or hasattr(response, output.name)


def _label(output: Output) -> str:
    return f"{output.description}, {output.unit.replace('^2', '²')}"


def _columns(response: Response, output: Output) -> FloatArray:
    """Values of an output, one row a unit or joint."""
    return quantity(response, output.name).reshape(len(response.time), -1).T


def _named(
    output: Output, unit_names: Sequence[str], colours: Mapping[str, str]
) -> tuple[Sequence[str], Sequence[str]]:
    """Names and colours of the curves of an output."""
    if output.of is Of.UNIT:
        return unit_names, [colours[unit] for unit in unit_names]
    if output.of is Of.JOINT:
        joints = range(len(unit_names) - 1)
        # From black backwards, to stay away from the colours of the units.
        names = [f"{output.description} {joint + 1}" for joint in joints]
        return names, [COLOURS[-1 - joint % len(COLOURS)] for joint in joints]
    return [output.description], [COLOURS[-1]]


def _check_count(what: str, count: int, most: int) -> None:
    if count > most:
        message = f"{count} {what} in one picture; expected at most {most}, or they look alike"
        raise PictureError(message)
