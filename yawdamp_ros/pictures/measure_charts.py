"""Charts behind the values of an assessment's measures, one for each manoeuvre."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from yawdamp_ros.analysis import AnalysisError, Assessment, Finding, low_speed_turn
from yawdamp_ros.analysis.swept_path import front_swing, rear_swing, stations
from yawdamp_ros.analysis.traction import SLIGHT_GRADE, acceleration_from_rest, force_balance
from yawdamp_ros.analysis.tractrix import Turn
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.vehicle import Vehicle

POINTS = 240
"""Most points of a drawn line."""
FASTEST = 110.0
"""Highest speed of the balance of forces [km/h]."""
GREY = 6
"""Colour of limits."""


class Line(NamedTuple):
    """One line of a chart.

    Attributes
    ----------
    name : str
    x, y : ndarray, shape (m,)
    colour : int
        Number of the colour.
    dash : str
        Dashes, as of SVG; empty for a solid line.
    """

    name: str
    x: FloatArray
    y: FloatArray
    colour: int
    dash: str = ""


class Chart(NamedTuple):
    """Chart of one manoeuvre: labels of both axes, lines, and what they are."""

    x_label: str
    y_label: str
    lines: Sequence[Line]
    caption: str


def measure_charts(assessment: Assessment) -> list[dict[str, object]]:
    """Charts of an assessment's measures that no other picture of the page shows.

    Parameters
    ----------
    assessment : Assessment

    Returns
    -------
    list of dict
        A chart of each manoeuvre for which a measure has a value.

    Examples
    --------
    >>> from yawdamp_ros.analysis import assess, load_scheme
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> vehicle, scheme = load_vehicle("interlink"), load_scheme("pbs", "tail_swing")
    >>> findings = assess(vehicle, scheme=scheme)
    >>> [each] = measure_charts(Assessment(vehicle, "consistent", scheme, None, findings))
    >>> each["title"]
    'Tail swing: 0.04 m'
    """
    valued = {each.measure.name: each for each in assessment.findings if each.value is not None}
    found: list[dict[str, object]] = []
    for names, made in _CHARTS.items():
        shown = [valued[name] for name in names if name in valued]
        if not shown:
            continue
        try:
            chart = made(assessment.vehicle, shown[0])
        except AnalysisError:
            continue
        found.append(
            {
                "measures": [each.measure.name for each in shown],
                "title": "; ".join(_title(each) for each in shown),
                "x_label": chart.x_label,
                "y_label": chart.y_label,
                "lines": [_listed(line) for line in [*chart.lines, *_limits(chart, shown)]],
                "caption": chart.caption,
            }
        )
    return found


def _title(finding: Finding) -> str:
    name = finding.measure.name.replace("_", " ").capitalize()
    return f"{name}: {finding.value:.2f} {finding.measure.unit}".strip()


def _limits(chart: Chart, shown: Sequence[Finding]) -> Iterator[Line]:
    """Limits of the first measure, where the chart's axis is its own."""
    first = shown[0]
    if not chart.y_label.startswith(first.measure.name.replace("_", " ")):
        return
    ends = np.array(
        [min(float(line.x.min()) for line in chart.lines), max(line.x.max() for line in chart.lines)]
    )
    for limit in first.limits:
        if limit is not None:
            yield Line(f"limit, {limit:.4g}", ends, np.full(2, limit), GREY, "6 4")


def _listed(line: Line) -> dict[str, object]:
    every = max(len(line.x) // POINTS, 1)
    kept = np.unique([*range(0, len(line.x), every), int(np.argmax(line.y)), len(line.x) - 1])
    return {
        "name": line.name,
        "xs": np.round(line.x[kept], 4).tolist(),
        "ys": np.round(line.y[kept], 5).tolist(),
        "colour": line.colour,
        "dash": line.dash,
    }


def _balance(vehicle: Vehicle, finding: Finding) -> Chart:
    steepest = finding.value or 0.0
    grades = [0.0, SLIGHT_GRADE, *([0.01 * steepest] if finding.measure.unit == "%" else [])]
    speeds = np.linspace(0.0, FASTEST, POINTS)
    force, resistances = force_balance(vehicle, speeds / 3.6, grades)
    lines = [Line("largest force at the driven wheels", speeds, 1e-3 * force, 0)]
    lines += [
        Line(f"resistance on {100.0 * grade:.3g} %", speeds, 1e-3 * resistance, number)
        for number, (grade, resistance) in enumerate(zip(grades, resistances, strict=True), 1)
    ]
    return Chart(
        "speed, km/h",
        "force, kN",
        lines,
        "Where the force meets a resistance, the speed on that grade is highest.",
    )


def _acceleration(vehicle: Vehicle, _: Finding) -> Chart:
    time, way = acceleration_from_rest(vehicle)
    return Chart(
        "time, s", "way from rest, m", [Line("way", time, way, 0)], "The first 100 m on a level road."
    )


def _front(vehicle: Vehicle, _: Finding) -> Chart:
    turn = low_speed_turn(vehicle)
    return Chart(
        "place along the guided path, m",
        "frontal swing, m",
        _of_bodies(vehicle, turn, stations(turn), front_swing),
        "How far each front corner is outside the path of the outer front tyre; the arc begins at 0 m.",
    )


def _rear(vehicle: Vehicle, _: Finding) -> Chart:
    turn = low_speed_turn(vehicle)
    return Chart(
        "way of the guided tyre, m",
        "tail swing, m",
        _of_bodies(vehicle, turn, turn.way, lambda turn, unit: np.maximum(rear_swing(turn, unit), 0.0)),
        "How far each rear corner is outside its straight way.",
    )


def _of_bodies(
    vehicle: Vehicle, turn: Turn, x: FloatArray, swing: Callable[[Turn, int], FloatArray]
) -> list[Line]:
    return [Line(vehicle.unit_names[unit], x, swing(turn, unit), unit) for unit in turn.bodies]


def _friction(vehicle: Vehicle, _: Finding) -> Chart:
    from yawdamp_ros.analysis.driven import friction_use  # noqa: PLC0415 - compiled code loads long

    way, share = friction_use(vehicle)
    return Chart(
        "place along the guided path, m",
        "steer tyre friction demand, %",
        [Line("steered tyres", way, share, 0)],
        "Share of the road's friction; the arc begins at 0 m.",
    )


def _tracking(vehicle: Vehicle, finding: Finding) -> Chart:
    from yawdamp_ros.analysis.bodies import corners, straight_places  # noqa: PLC0415
    from yawdamp_ros.analysis.tracking import tracking  # noqa: PLC0415

    found = tracking(vehicle, finding.speed)
    places = straight_places(vehicle)
    x = np.array([places[unit] + corner.real for unit, corner in corners(vehicle)])
    lines = []
    for number in range(len(vehicle.units)):
        own = 4 * number + np.array([0, 1, 3, 2, 0])
        lines.append(Line(vehicle.unit_names[number], x[own], found.mean[own], number))
        for side, sign in ((slice(0, 4, 2), -1.0), (slice(1, 4, 2), 1.0)):
            edge = 4 * number + np.arange(4)[side]
            lines.append(Line("", x[edge], found.mean[edge] + sign * found.spread[edge], number, "4 3"))
    return Chart(
        "place along the combination, m",
        "left, m",
        lines,
        "Mean places of the bodies, seen from above, scales unequal; dashed: the side stays within on 99 % "
        f"of the road. Without roughness {found.steady:.2f} m.",
    )


def _braking(vehicle: Vehicle, finding: Finding) -> Chart:
    from yawdamp_ros.analysis.bodies import lateral_positions  # noqa: PLC0415
    from yawdamp_ros.analysis.driven import stop_on_split_friction  # noqa: PLC0415

    outputs = stop_on_split_friction(vehicle, finding.speed)
    across, way = lateral_positions(vehicle, outputs, 0.0), outputs.position[:, 0, 0]
    lines = [
        Line("leftmost corner", way, across.max(axis=1), 0),
        Line("rightmost", way, across.min(axis=1), 1),
    ]
    return Chart("way of the lead unit, m", "left, m", lines, "From the beginning of braking to the stop.")


def _transfer(vehicle: Vehicle, finding: Finding) -> Chart:
    from yawdamp_ros.analysis.driven import load_transfers  # noqa: PLC0415
    from yawdamp_ros.analysis.nonlinear_runs import drive_lane_change  # noqa: PLC0415

    run = drive_lane_change(vehicle, finding.speed)
    lines = [
        Line(name, run.time, ratio, number)
        for number, (name, ratio) in enumerate(load_transfers(vehicle, run).items())
    ]
    return Chart(
        "time, s", "load transfer ratio", lines, "In the lane change, of the units that roll together."
    )


_CHARTS: Mapping[tuple[str, ...], Callable[[Vehicle, Finding], Chart]] = MappingProxyType(
    {
        ("startability", "gradeability", "gradeability_speed"): _balance,
        ("acceleration_capability",): _acceleration,
        ("tracking_ability_on_a_straight_path",): _tracking,
        (
            "frontal_swing",
            "frontal_swing_maximum_of_differences",
            "frontal_swing_difference_of_maxima",
        ): _front,
        ("tail_swing",): _rear,
        ("steer_tyre_friction_demand",): _friction,
        ("load_transfer_ratio",): _transfer,
        ("directional_stability_under_braking",): _braking,
    }
)
