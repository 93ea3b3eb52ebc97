"""The drawing of docs/theory.md: a one-track combination in a left turn, with its names; not to scale."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from yawdamp_ros.pictures import new_figure, save
from yawdamp_ros.pictures.figure import COLOURS, GREY
from yawdamp_ros.vehicle import Axle, Unit

UNITS = (
    Unit("truck", 1.0, 1.0, (Axle(3.0, 1.0, steered=True), Axle(-3.0, 1.0)), None, -4.0),
    Unit("trailer_1", 1.0, 1.0, (Axle(-3.6, 1.0),), 5.0, -4.8),
    Unit("trailer_2", 1.0, 1.0, (Axle(-3.6, 1.0), Axle(-4.8, 1.0)), 5.0, None),
)
HEADINGS = (0.55, 0.30, 0.08)
"""Yaw of the units in rad; far more than small, so that it can be seen."""
STEER = 0.35
BLACK, MARK = "#202020", COLOURS[3]


def write_drawing(path: Path) -> None:
    """Write the drawing."""
    save(_drawing(), path)


def _drawing() -> Figure:
    figure = new_figure(9.6, 4.2)
    axes = figure.subplots()
    place = np.zeros(2)
    for index, (unit, heading) in enumerate(zip(UNITS, HEADINGS, strict=True)):
        ahead, left = _directions(heading)
        if unit.front_hitch is not None:
            place = place - unit.front_hitch * ahead
        ends = [position for position in (unit.front_hitch, unit.rear_hitch) if position is not None]
        ends += [axle.position for axle in unit.axles]
        _line(axes, place + max(ends) * ahead, place + min(ends) * ahead, COLOURS[index], 3.0)
        for axle in unit.axles:
            centre = place + axle.position * ahead
            _wheel(axes, centre, heading + (STEER if axle.steered else 0.0))
        axes.plot(*place, "o", color="white", markeredgecolor=COLOURS[index], markersize=9, zorder=4)
        _arrow(axes, place, place + 2.2 * left, COLOURS[index], f"$a_{{y,{index + 1}}}$")
        _heading(axes, place, heading, f"$\\psi_{index + 1}$")
        if unit.rear_hitch is not None:
            place = place + unit.rear_hitch * ahead
            # Where the next unit's front hitch is.
            axes.plot(*place, "o", color=BLACK, markersize=5, zorder=5)
            _articulation(axes, place, HEADINGS[index], HEADINGS[index + 1], index + 1)
    _steering(axes, UNITS[0].axles[0].position)
    origin = np.array([-22.0, -1.5])
    _arrow(axes, origin, origin + np.array([2.2, 0.0]), GREY, "x (forward)")
    _arrow(axes, origin, origin + np.array([0.0, 2.2]), GREY, "y (left)")
    axes.set_aspect("equal")
    axes.margins(0.03, 0.14)
    axes.set_axis_off()
    return figure


def _directions(heading: float) -> tuple[np.ndarray, np.ndarray]:
    ahead = np.array([np.cos(heading), np.sin(heading)])
    return ahead, np.array([-ahead[1], ahead[0]])


def _line(axes: Axes, start: np.ndarray, end: np.ndarray, colour: str, width: float) -> None:
    axes.plot([start[0], end[0]], [start[1], end[1]], color=colour, linewidth=width, solid_capstyle="round")


def _wheel(axes: Axes, centre: np.ndarray, heading: float) -> None:
    ahead, _ = _directions(heading)
    _line(axes, centre - 0.4 * ahead, centre + 0.4 * ahead, BLACK, 6.0)


def _arrow(axes: Axes, start: np.ndarray, end: np.ndarray, colour: str, label: str) -> None:
    style = {"arrowstyle": "-|>", "color": colour, "linewidth": 1.4, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", tuple(end), tuple(start), arrowprops=style)
    axes.annotate(label, tuple(end), xytext=(4, 2), textcoords="offset points", color=colour)


def _heading(axes: Axes, place: np.ndarray, heading: float, label: str) -> None:
    """Mark a yaw angle, from the x axis up to the unit."""
    radius = 1.9
    _dashed(axes, place, place + np.array([2.3, 0.0]))
    _dashed(axes, place, place + 2.3 * _directions(heading)[0])
    angles = np.linspace(0.0, heading, 20)
    axes.plot(
        place[0] + radius * np.cos(angles), place[1] + radius * np.sin(angles), color=GREY, linewidth=1.0
    )
    axes.annotate(label, (place[0] + radius, place[1] - 0.1), va="top", color=BLACK)


def _articulation(axes: Axes, place: np.ndarray, towing: float, towed: float, joint: int) -> None:
    """Mark an articulation angle behind a hitch, between the two units' centre lines."""
    radius = 1.6
    _dashed(axes, place, place - 2.0 * _directions(towing)[0])
    angles = np.pi + np.linspace(towed, towing, 20)
    axes.plot(
        place[0] + radius * np.cos(angles), place[1] + radius * np.sin(angles), color=MARK, linewidth=1.4
    )
    middle = place - 1.9 * _directions(towing)[0] - np.array([0.0, 1.2])
    axes.annotate(
        f"$\\theta_{joint} = \\psi_{joint} - \\psi_{joint + 1}$",
        tuple(middle),
        color=MARK,
        ha="center",
        va="top",
    )


def _steering(axes: Axes, position: float) -> None:
    ahead, _ = _directions(HEADINGS[0])
    wheel, _ = _directions(HEADINGS[0] + STEER)
    centre = position * ahead
    _dashed(axes, centre, centre + 4.6 * wheel)
    _dashed(axes, centre, centre + 4.6 * ahead)
    angles = np.linspace(HEADINGS[0], HEADINGS[0] + STEER, 20)
    axes.plot(centre[0] + 4.0 * np.cos(angles), centre[1] + 4.0 * np.sin(angles), color=MARK, linewidth=1.4)
    label = centre + 4.3 * _directions(HEADINGS[0] + 0.6 * STEER)[0]
    axes.annotate(r"$\delta$", tuple(label), color=MARK)


def _dashed(axes: Axes, start: np.ndarray, end: np.ndarray) -> None:
    axes.plot([start[0], end[0]], [start[1], end[1]], color=GREY, linewidth=0.8, linestyle="--", zorder=1)
