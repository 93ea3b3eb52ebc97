"""The curves of one run, or of several compared."""

from collections.abc import Callable, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.pictures.errors import PictureError
from yawdamp_ros.pictures.figure import COLOURS, new_figure, style
from yawdamp_ros.stepping import Response

DASHES = ((0.0, ()), (0.0, (5, 2)), (0.0, (1, 1.5)), (0.0, (6, 2, 1, 2)), (0.0, (10, 3)), (0.0, (1, 4)))
"""One a run, in points drawn and left blank; more could not be told apart."""


def runs_figure(runs: Sequence[tuple[str, Response]]) -> Figure:
    """Draw steer angle, yaw, yaw rate, lateral acceleration, articulation and, where known, the paths.

    Colours tell units apart, dashes runs.

    Parameters
    ----------
    runs : sequence of (str, Response)
        Each with the name it is called by; a response whose x and y are not finite gets no path.

    Returns
    -------
    Figure

    Raises
    ------
    PictureError
        If there are more runs, or more units, than can be told apart.
    """
    units = tuple(dict.fromkeys(unit for _, response in runs for unit in response.unit_names))
    joints = max(response.articulation.shape[1] for _, response in runs)
    _check_count("runs", len(runs), len(DASHES))
    _check_count("units", len(units), len(COLOURS))

    panels: list[Callable[[Axes], None]] = [
        lambda axes: _draw_steering(axes, runs),
        lambda axes: _draw_units(axes, runs, units, lambda run: run.yaw, "yaw, rad"),
        lambda axes: _draw_units(axes, runs, units, lambda run: run.yaw_rate, "yaw rate, rad/s"),
        lambda axes: _draw_units(
            axes, runs, units, lambda run: run.lateral_acceleration, "lateral acceleration, m/s$^2$"
        ),
    ]
    if joints:
        panels.append(lambda axes: _draw_articulation(axes, runs))
    if any(np.isfinite(response.x).all() for _, response in runs):
        panels.append(lambda axes: _draw_paths(axes, runs, units))

    rows = (len(panels) + 1) // 2
    figure = new_figure(10.5, 2.7 * rows + 0.7)
    for number, panel in enumerate(panels, 1):
        panel(figure.add_subplot(rows, 2, number))
    _add_legend(figure, [name for name, _ in runs], units, joints)
    return figure


def _draw_steering(axes: Axes, runs: Sequence[tuple[str, Response]]) -> None:
    for (_, response), dashes in zip(runs, DASHES, strict=False):
        axes.step(
            response.time,
            response.steering_angle,
            where="post",
            color="black",
            linestyle=dashes,
            linewidth=1.2,
        )
    style(axes, "time, s", "steer angle, rad")


def _draw_units(
    axes: Axes,
    runs: Sequence[tuple[str, Response]],
    units: Sequence[str],
    quantity: Callable[[Response], FloatArray],
    label: str,
) -> None:
    for (_, response), dashes in zip(runs, DASHES, strict=False):
        for name, values in zip(response.unit_names, quantity(response).T, strict=True):
            colour = COLOURS[units.index(name)]
            axes.plot(response.time, values, color=colour, linestyle=dashes, linewidth=1.2)
    style(axes, "time, s", label)


def _draw_articulation(axes: Axes, runs: Sequence[tuple[str, Response]]) -> None:
    for (_, response), dashes in zip(runs, DASHES, strict=False):
        for joint, values in enumerate(response.articulation.T):
            # Backwards from black, away from the colours of the units.
            axes.plot(response.time, values, color=_joint_colour(joint), linestyle=dashes, linewidth=1.2)
    style(axes, "time, s", "articulation, rad")


def _draw_paths(axes: Axes, runs: Sequence[tuple[str, Response]], units: Sequence[str]) -> None:
    for (_, response), dashes in zip(runs, DASHES, strict=False):
        if np.isfinite(response.x).all():
            for index, name in enumerate(response.unit_names):
                colour = COLOURS[units.index(name)]
                axes.plot(
                    response.x[:, index], response.y[:, index], color=colour, linestyle=dashes, linewidth=1.2
                )
    style(axes, "x, m", "y (left), m", "paths of the centres of gravity, scales unequal")


def _add_legend(figure: Figure, names: Sequence[str], units: Sequence[str], joints: int) -> None:
    handles = [Line2D([], [], color=colour, label=unit) for unit, colour in zip(units, COLOURS, strict=False)]
    handles += [
        Line2D([], [], color=_joint_colour(joint), label=f"articulation {joint + 1}")
        for joint in range(joints)
    ]
    if len(names) > 1:
        handles += [
            Line2D([], [], color="#404040", linestyle=dashes, label=name)
            for name, dashes in zip(names, DASHES, strict=False)
        ]
    elif names:
        # Names are no formulas, whatever signs are in them.
        figure.suptitle(names[0], fontsize="medium", parse_math=False)
    legend = figure.legend(
        handles=handles, loc="outside lower center", ncols=min(len(handles), 6), fontsize="small"
    )
    for text in legend.get_texts():
        text.set_parse_math(False)


def _joint_colour(joint: int) -> str:
    return COLOURS[-1 - joint % len(COLOURS)]


def _check_count(what: str, count: int, most: int) -> None:
    if count > most:
        message = f"{count} {what} in one picture; expected at most {most}, or they look alike"
        raise PictureError(message)
