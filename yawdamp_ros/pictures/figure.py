"""One style for every picture, and reproducible files."""

import warnings
from collections.abc import Sequence
from pathlib import Path

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.legend import Legend
from matplotlib.lines import Line2D

from yawdamp_ros.pictures.errors import PictureError

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
"""Okabe and Ito's palette, distinguishable with any colour vision."""

STABLE, UNSTABLE = COLOURS[0], COLOURS[1]
GREY = "#808080"

LEGEND_MARGIN = 0.02
"""Fraction of the figure's height between legend and axes."""

KINDS = (".png", ".svg")


def new_figure(width: float, height: float) -> Figure:
    """Return an empty figure, laid out so that labels do not overlap.

    Parameters
    ----------
    width, height : float
        Size [in].

    Returns
    -------
    matplotlib.figure.Figure

    Examples
    --------
    >>> from yawdamp_ros.pictures import new_figure
    >>> new_figure(4.0, 3.0).get_size_inches().tolist()
    [4.0, 3.0]
    """
    return Figure(figsize=(width, height), layout="constrained")


def style(axes: Axes, x_label: str, y_label: str, title: str = "") -> None:
    """Label axes and give them the common style."""
    axes.set_xlabel(x_label)
    axes.set_ylabel(y_label)
    axes.set_title(title, fontsize="medium")
    axes.grid(visible=True, color="#e0e0e0", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)


def add_legend(figure: Figure, columns: int, handles: Sequence[Line2D] | None = None) -> Legend:
    """Add a legend below all axes, of all curves or of given handles.

    Matplotlib places legends outside the axes from 3.7 on; this way works before, too.
    """
    given = {} if handles is None else {"handles": handles}
    legend = figure.legend(loc="lower center", ncols=columns, fontsize="small", **given)
    for text in legend.get_texts():
        text.set_parse_math(False)  # names are text, not formulas, also when measured
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph")  # as in `save`
        height = legend.get_window_extent().height / figure.bbox.height + LEGEND_MARGIN
    engine = figure.get_layout_engine()
    if isinstance(engine, ConstrainedLayoutEngine):
        engine.set(rect=(0.0, height, 1.0, 1.0 - height))
    return legend


def save(figure: Figure, path: str | Path, dpi: float = 120.0) -> None:
    """Write a figure as PNG or SVG, by the file's name.

    The bytes depend on the figure and the versions of the libraries only: no date, no random names.

    Parameters
    ----------
    figure : Figure
    path : str or Path
    dpi : float
        Dots per inch of a PNG.

    Raises
    ------
    PictureError
        If the name ends in neither .png nor .svg, or the file cannot be written.

    Examples
    --------
    >>> from pathlib import Path
    >>> from yawdamp_ros.pictures import new_figure, save
    >>> save(new_figure(4.0, 3.0), "picture.png")
    >>> Path("picture.png").read_bytes()[1:4]
    b'PNG'
    """
    kind = Path(path).suffix.lower()
    if kind not in KINDS:
        message = f"{path}: expected a name ending in {' or '.join(KINDS)}"
        raise PictureError(message)
    try:
        with mpl.rc_context({"svg.hashsalt": "yawdamp_ros"}), warnings.catch_warnings():
            # A name may hold characters that no font has; they become boxes.
            warnings.filterwarnings("ignore", message="Glyph")
            if kind == ".svg":
                figure.savefig(path, format="svg", metadata={"Date": None, "Creator": None})
            else:
                _save_png(figure, path, dpi)
    except OSError as error:
        message = f"{path}: cannot be written: {error.strerror}"
        raise PictureError(message) from error


def _save_png(figure: Figure, path: str | Path, dpi: float) -> None:
    """Write a PNG by one drawing: `Figure.savefig` draws twice, first for the layout alone."""
    before = figure.get_dpi()
    figure.set_dpi(dpi)
    try:
        FigureCanvasAgg(figure).print_png(path, metadata={"Software": None})  # type: ignore[no-untyped-call]
    finally:
        figure.set_dpi(before)
