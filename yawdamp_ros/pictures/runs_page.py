"""The curves of runs as one HTML page with zoom and values."""

import html
from collections.abc import Sequence

from plotly.graph_objects import Figure, Scatter
from plotly.subplots import make_subplots

from yawdamp_ros.pictures.run_panels import bands, run_panels
from yawdamp_ros.stepping import Response

SHADE = "#f3e3dc"
BEYOND = "beyond the linear range"
MARK = "#a02020"
"""Colour of the vehicle's events."""
DASHES = ("solid", "dash", "dot", "dashdot", "longdash", "longdashdot")
"""Line styles, one for each run."""
MOST_SAMPLES = 20_000
"""Limit on the samples of a curve: a browser cannot draw more at once."""
PANEL_HEIGHT = 280
"""Height of a panel in pixels."""

PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<style>
body {{ margin: 0 auto; max-width: 80rem; font-family: sans-serif }}
h1, p {{ margin: 1rem; font-size: 1rem }}
</style>
</head>
<body>
<h1>{title}</h1>
{note}{plot}
</body>
</html>
"""


def runs_page(runs: Sequence[tuple[str, Response]]) -> str:
    """Draw the panels of runs on a page that needs nothing else.

    The curves of a long run are thinned out evenly; the page says so.

    Parameters
    ----------
    runs : sequence of (str, Response)
        As for `run_panels`.

    Returns
    -------
    str

    Raises
    ------
    PictureError
        If there are more runs, or more units, than a picture can distinguish.
    """
    panels = run_panels(runs)
    names = [html.escape(name) for name, _ in runs]
    strides = [-(-len(response.time) // MOST_SAMPLES) for _, response in runs]
    figure = make_subplots(rows=len(panels), cols=1, subplot_titles=[panel.title for panel in panels])
    listed = set()
    for row, panel in enumerate(panels, 1):
        for curve in panel.curves:
            name = curve.name if len(runs) == 1 else f"{curve.name}, {names[curve.run]}"
            figure.add_trace(
                Scatter(
                    x=curve.x[:: strides[curve.run]],
                    y=curve.y[:: strides[curve.run]],
                    name=name,
                    legendgroup=name,
                    showlegend=name not in listed,
                    line={
                        "color": curve.colour,
                        "dash": DASHES[curve.run],
                        "width": 1.5,
                        "shape": "hv" if panel.held else "linear",
                        "simplify": False,
                    },
                ),
                row=row,
                col=1,
            )
            listed.add(name)
        for low, high in bands(panel):
            figure.add_hrect(
                y0=low, y1=high, fillcolor=SHADE, layer="below", line_width=0, row=row, col=1, name=BEYOND
            )
        for time, what in panel.marks:
            label = {"annotation_text": what, "annotation_textangle": -90} if row == 1 else {}
            figure.add_vline(x=time, line={"color": MARK, "dash": "dot", "width": 1}, row=row, col=1, **label)
        # All panels over time zoom together.
        zoomed = "x" if row > 1 and panel.x_label == panels[0].x_label else None
        figure.update_xaxes(title_text=panel.x_label, matches=zoomed, row=row, col=1)
        figure.update_yaxes(title_text=panel.y_label, row=row, col=1)
    _lay_out(figure, len(panels))
    plot = figure.to_html(
        full_html=False,
        include_plotlyjs=True,
        include_mathjax=False,
        div_id="runs",
        # Runs are private: no button uploads one.
        config={"displaylogo": False, "responsive": True, "showSendToCloud": False, "plotlyServerURL": ""},
    )
    thinned = [
        f"{name}: one sample in {stride} is shown"
        for name, stride in zip(names, strides, strict=True)
        if stride > 1
    ]
    note = f"<p>{'; '.join(thinned)}</p>\n" if thinned else ""
    return PAGE.format(title=", ".join(names), note=note, plot=plot)


def _lay_out(figure: Figure, panels: int) -> None:
    figure.update_layout(
        template="plotly_white",
        height=PANEL_HEIGHT * panels,
        hovermode="x unified",
        legend={"orientation": "h", "yanchor": "bottom", "y": 1.01, "x": 0.0},
        margin={"l": 70, "r": 45, "t": 60, "b": 50},
        modebar={"orientation": "v"},
    )
