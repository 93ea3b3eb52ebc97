"""A vehicle to scale, from the side and from above."""

from itertools import pairwise

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Rectangle

from yawdamp_ros.pictures.figure import COLOURS, GREY, new_figure
from yawdamp_ros.pictures.placement import Placed, placed
from yawdamp_ros.vehicle import STANDARD_GRAVITY, Axle, Vehicle, supports

TYRE_RADIUS = 0.5
"""Radius of every tyre [m], which vehicle files do not give; smaller under a low vehicle."""
TYRE_WIDTH = 0.3
FLOOR = 0.9
"""Height of a body's floor [m]; that of the wheels' centres for a low vehicle."""
INCHES_PER_METRE = 0.55
SMALL = 7.5


def vehicle_figure(vehicle: Vehicle) -> Figure:
    """Draw a vehicle to scale, from the side and from above.

    Axles stand with their wheels at their track, labelled with their load; hitches, and centres of gravity
    with their height, hollow where that is assumed. Missing values are drawn as the nonlinear
    model assumes it.

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    Figure
    """
    units = placed(vehicle)
    front, rear = max(each.front for each in units), min(each.rear for each in units)
    tallest = max(each.unit.height or 0.0 for each in units)
    widest = max(each.unit.width or 0.0 for each in units)
    size = (max(INCHES_PER_METRE * (front - rear + 2.0), 6.0), INCHES_PER_METRE * (tallest + widest) + 2.6)
    figure = new_figure(*size)
    side, above = figure.subplots(2, 1, sharex=True, height_ratios=(tallest + 1.6, widest + 2.0))
    radius = min(TYRE_RADIUS, 0.22 * tallest)
    _draw_side(side, units, radius)
    _draw_above(above, units, radius)
    mass = sum(each.unit.mass for each in units) / 1000.0
    figure.suptitle(f"{vehicle.name}, {mass:.1f} t", fontsize="medium")
    for axes, bottom, top in ((side, -0.9, tallest + 0.7), (above, -0.5 * widest - 1.2, 0.5 * widest + 0.8)):
        axes.set_aspect("equal")
        axes.set_xlim(rear - 1.0, front + 1.0)
        axes.set_ylim(bottom, top)
        axes.spines[["top", "right", "left"]].set_visible(False)
        axes.set_yticks([])
    side.spines["bottom"].set_visible(False)
    side.tick_params(axis="x", length=0.0)
    above.set_xlabel(
        "m from the lead unit's centre of gravity, forward positive; axle loads in t\n"
        "dot: centre of gravity, hollow where its height is assumed; triangle: hitch",
        fontsize="small",
    )
    return figure


def _draw_side(axes: Axes, units: list[Placed], radius: float) -> None:
    axes.axhline(0.0, color=GREY, linewidth=0.8, zorder=0)
    for index, each in enumerate(units):
        colour = COLOURS[index % len(COLOURS)]
        behind = units[index + 1] if index + 1 < len(units) else None
        _draw_body(axes, each, behind, colour, radius)
        for axle in each.unit.axles:
            centre = each.x + axle.position
            axes.add_patch(Circle((centre, radius), radius, facecolor="#404040", zorder=3))
            axes.add_patch(Circle((centre, radius), 0.5 * radius, facecolor="#d0d0d0", zorder=3))
            axes.text(centre, -0.15, _load(axle), ha="center", va="top", fontsize=SMALL)
        height = each.unit.cg_height or 0.0
        _mark_centre(axes, each.x, height, hollow=each.assumed_height)
        label = f"{height:.2f} m" + " assumed" * each.assumed_height
        axes.annotate(label, (each.x, height), (4, 4), textcoords="offset points", fontsize=SMALL, zorder=6)
    for towing, _ in pairwise(units):
        place = towing.x + (towing.unit.rear_hitch or 0.0), towing.unit.hitch_height or 0.0
        axes.plot(*place, "v", color="black", markersize=5, zorder=5)


def _draw_body(axes: Axes, each: Placed, behind: Placed | None, colour: str, radius: float) -> None:
    """Profile of a body: high up to the next body, and low below it, as a fifth wheel needs."""
    floor, height = FLOOR if radius == TYRE_RADIUS else radius, each.unit.height or 0.0
    covered = each.rear
    if behind is not None and each.unit.hitch_roll_stiffness:
        covered = min(max(behind.front, each.rear), each.front)
        top = max(each.unit.hitch_height or 0.0, floor + 0.1)
        _box(axes, each.rear, covered - each.rear, floor, top - floor, colour)
    if covered < each.front:
        _box(axes, covered, each.front - covered, floor, max(height - floor, 0.1), colour)
    middle, top = 0.5 * (covered + each.front), max(height, floor + 0.1)
    if each.front - covered < 1.0:
        middle = 0.5 * (each.rear + each.front)
    axes.text(
        middle,
        top + 0.1,
        f"{each.unit.name}, {each.unit.mass / 1000.0:.1f} t",
        ha="center",
        va="bottom",
        fontsize=SMALL,
        color=colour,
        zorder=6,
    )


def _draw_above(axes: Axes, units: list[Placed], radius: float) -> None:
    for index, each in enumerate(units):
        colour = COLOURS[index % len(COLOURS)]
        width = each.unit.width or 0.0
        _box(axes, each.rear, each.front - each.rear, -0.5 * width, width, colour)
        for axle in each.unit.axles:
            centre, half = each.x + axle.position, 0.5 * (axle.track_width or 0.0)
            axes.plot([centre, centre], [-half, half], color="#404040", linewidth=1.2, zorder=3)
            for side in (-half, half):
                corner = centre - radius, side - 0.5 * TYRE_WIDTH
                axes.add_patch(Rectangle(corner, 2.0 * radius, TYRE_WIDTH, facecolor="#404040", zorder=3))
        _mark_centre(axes, each.x, 0.0, hollow=False)
        _draw_wheelbase(axes, each, -0.5 * width - 0.3 - 0.45 * (index % 2), colour)
    for towing, _ in pairwise(units):
        axes.plot(towing.x + (towing.unit.rear_hitch or 0.0), 0.0, "v", color="black", markersize=5, zorder=5)


def _draw_wheelbase(axes: Axes, each: Placed, y: float, colour: str) -> None:
    held = supports(each.unit)
    if held.front == held.rear:
        return
    ends = each.x + held.front, each.x + held.rear
    arrow = {"arrowstyle": "<->", "color": colour, "linewidth": 0.9, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", (ends[0], y), (ends[1], y), arrowprops=arrow)
    axes.text(
        0.5 * sum(ends),
        y,
        f"{held.front - held.rear:.2f} m",
        ha="center",
        va="center",
        fontsize=SMALL,
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.8},
    )


def _box(axes: Axes, x: float, length: float, y: float, height: float, colour: str) -> None:  # noqa: PLR0913, PLR0917
    axes.add_patch(Rectangle((x, y), length, height, facecolor=colour, alpha=0.18, zorder=1))
    axes.add_patch(Rectangle((x, y), length, height, fill=False, edgecolor=colour, zorder=2))


def _mark_centre(axes: Axes, x: float, y: float, *, hollow: bool) -> None:
    axes.plot(
        x, y, "o", color="black", markerfacecolor="white" if hollow else "black", markersize=6, zorder=5
    )


def _load(axle: Axle) -> str:
    return f"{(axle.static_load or 0.0) / STANDARD_GRAVITY / 1000.0:.1f}"
