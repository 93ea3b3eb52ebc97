"""The curves of one run, or of several compared, as a figure."""

from collections.abc import Sequence
from typing import Any

from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from yawdamp_ros.pictures.figure import add_legend, new_figure, style
from yawdamp_ros.pictures.run_panels import Panel, bands, run_panels
from yawdamp_ros.stepping import Response

SHADE = "#f3e3dc"
"""Colour of the time beyond the linear range."""
MARK = "#a02020"
"""Colour of the vehicle's events."""
NOTE: dict[str, Any] = {
    "rotation": 90,
    "fontsize": 6,
    "color": MARK,
    "ha": "right",
    "va": "top",
    "parse_math": False,
}
DASHES = ((0.0, ()), (0.0, (5, 2)), (0.0, (1, 1.5)), (0.0, (6, 2, 1, 2)), (0.0, (10, 3)), (0.0, (1, 4)))
"""Dashes, one pattern for each run, in points drawn and left blank."""


def runs_figure(runs: Sequence[tuple[str, Response]]) -> Figure:
    """Draw the panels of runs; colours tell units apart, dashes runs.

    Parameters
    ----------
    runs : sequence of (str, Response)
        As for `run_panels`.

    Returns
    -------
    Figure

    Raises
    ------
    PictureError
        If there are more runs, or more units, than a picture can distinguish.
    """
    panels = run_panels(runs)
    rows = (len(panels) + 1) // 2
    figure = new_figure(10.5, 2.7 * rows + 0.7)
    for number, panel in enumerate(panels, 1):
        axes = figure.add_subplot(rows, 2, number)
        for curve in panel.curves:
            axes.plot(
                curve.x,
                curve.y,
                color=curve.colour,
                linestyle=DASHES[curve.run],
                linewidth=1.2,
                drawstyle="steps-post" if panel.held else "default",
            )
        for low, high in bands(panel):
            axes.axhspan(low, high, color=SHADE, linewidth=0.0, zorder=0.0)
        for time, what in panel.marks:
            axes.axvline(time, color=MARK, linewidth=0.8, linestyle=":")
            if number == 1:
                axes.annotate(what, (time, 0.98), xycoords=("data", "axes fraction"), **NOTE)
        style(axes, panel.x_label, panel.y_label, panel.title)
    _add_legend(figure, [name for name, _ in runs], panels)
    return figure


def _add_legend(figure: Figure, names: Sequence[str], panels: Sequence[Panel]) -> None:
    # The label of the first panel says what it shows.
    colours = {curve.name: curve.colour for panel in panels[1:] for curve in panel.curves}
    handles = [Line2D([], [], color=colour, label=name) for name, colour in colours.items()]
    if len(names) > 1:
        handles += [
            Line2D([], [], color="#404040", linestyle=dashes, label=name)
            for name, dashes in zip(names, DASHES, strict=False)
        ]
    elif names:
        # Names are text, not formulas, whatever characters they contain.
        figure.suptitle(names[0], fontsize="medium", parse_math=False)
    add_legend(figure, min(len(handles), 6), handles)
