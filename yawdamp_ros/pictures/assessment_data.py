"""Data of the page of an assessment: the vehicles and their turn at low speed."""

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from yawdamp_ros.analysis import AnalysisError, Assessment, Turn, low_speed_turn
from yawdamp_ros.analysis.swept_path import envelope, on_guide, stations
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.pictures.placement import placed
from yawdamp_ros.vehicle import (
    STANDARD_GRAVITY,
    Axle,
    Unit,
    Vehicle,
    assumed,
    complete,
    static_loads,
    supports,
)

EVERY = 8
"""Samples of a turn, and stations of its envelope, between drawn points."""
SHOWN = 5
"""Places at which the combination is drawn in its turn."""
FLOOR = 0.9
"""Height of a drawn body's floor [m]."""


def vehicle_tables(vehicle: Vehicle) -> list[dict[str, object]]:
    """Tables of units and axles; assumed values are marked with an asterisk.

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    list of dict
        Tables, each with title, columns and rows of text.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> [table["title"] for table in vehicle_tables(load_vehicle("interlink"))]
    ['Units', 'Axles']
    """
    full, marks = complete(vehicle), {each.key for each in assumed(vehicle)}
    loads = static_loads(vehicle)
    units, axles = [], []
    for index, unit in enumerate(full.units):
        held, key = supports(unit), f"units.{index}."
        units.append(
            [
                unit.name,
                f"{unit.mass / 1000.0:.2f}",
                _marked(unit.cg_height, key + "cg_height", marks),
                f"{held.front - held.rear:.2f}",
                f"{loads[index].front_hitch / STANDARD_GRAVITY / 1000.0:.2f}" if index else "",
                _marked(unit.width, key + "width", marks),
                _marked(unit.front_overhang, key + "front_overhang", marks),
                _marked(unit.rear_overhang, key + "rear_overhang", marks),
            ]
        )
        axles += [
            _axle_row(unit, axle, f"{key}axles.{place}.", marks) for place, axle in enumerate(unit.axles)
        ]
    heads = [
        "unit",
        "mass, t",
        "CG height, m",
        "wheelbase, m",
        "hitch load, t",
        "width, m",
        "front overhang, m",
    ]
    return [
        {"title": "Units", "columns": [*heads, "rear overhang, m"], "rows": units},
        {
            "title": "Axles",
            "columns": ["unit", "from CG, m", "load, t", "stiffness, kN/deg", "track, m", "kind"],
            "rows": axles,
        },
    ]


def _axle_row(unit: Unit, axle: Axle, key: str, marks: set[str]) -> list[str]:
    kinds = {
        "steered": axle.steered,
        "driven": axle.driven,
        "self-steering": axle.self_steering,
        f"low-speed steering {axle.low_speed_steering:g}": axle.low_speed_steering,
    }
    kind = ", ".join(name for name, is_so in kinds.items() if is_so)
    return [
        unit.name,
        f"{axle.position:.2f}",
        f"{(axle.static_load or 0.0) / STANDARD_GRAVITY / 1000.0:.2f}",
        f"{math.radians(axle.cornering_stiffness) / 1000.0:.2f}",
        _marked(axle.track_width, key + "track_width", marks),
        kind,
    ]


def _marked(value: float | None, key: str, marks: set[str]) -> str:
    return f"{value:.2f}" + ("*" if key in marks else "")


def side_view(vehicle: Vehicle) -> dict[str, object]:
    """Vehicle from the side, to scale.

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    dict
        Lengths [m], from the lead unit's centre of gravity, forward positive.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> len(side_view(load_vehicle("interlink"))["units"])
    3
    """
    units = []
    for unit, x, rear, front, assumed_height in placed(vehicle):
        units.append(
            {
                "name": unit.name,
                "mass": f"{unit.mass / 1000.0:.1f} t",
                "rear": rear,
                "front": front,
                "floor": min(FLOOR, 0.6 * (unit.height or 0.0)),
                "height": unit.height,
                "cg": [x, unit.cg_height],
                "assumed": assumed_height,
                "axles": [
                    [x + axle.position, f"{(axle.static_load or 0.0) / STANDARD_GRAVITY / 1000.0:.1f}"]
                    for axle in unit.axles
                ],
                "hitch": None if unit.rear_hitch is None else [x + unit.rear_hitch, unit.hitch_height],
            }
        )
    return {"units": units}


def turn_view(vehicle: Vehicle) -> dict[str, object] | None:
    """Low-speed turn of a vehicle as paths to draw; None for a vehicle without one.

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    dict or None
        Points [m].

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> turn_view(load_vehicle("interlink"))["width"]
    '7.99 m'
    """
    try:
        turn = low_speed_turn(vehicle)
    except AnalysisError:
        return None
    inner, outer = envelope(turn)
    places = stations(turn)
    shown = places <= _last_shown(turn)
    widest = int(np.argmax(inner - outer))
    inside = on_guide(turn, places[shown], inner[shown])
    outside = on_guide(turn, places[shown], outer[shown])
    last, end = len(turn.geometry) - 1, turn.way <= _last_shown(turn)
    front = turn.geometry[0]

    def path(unit: int, forward: float, left: float) -> tuple[FloatArray, FloatArray]:
        x, y = turn.path(unit, forward, left)
        return x[end], y[end]

    corner, behind = path(0, front.front, -front.half_width), path(last, 0.0, 0.0)
    return {
        "name": vehicle.name,
        "width": f"{inner[widest] - outer[widest]:.2f} m",
        "across": [
            [float(value[0]) for value in on_guide(turn, places[[widest]], np.array([edge]))]
            for edge in (inner[widest], outer[widest])
        ],
        "inner": _points(inside),
        "outer": _points(outside),
        "guide": _points(on_guide(turn, places[shown], np.zeros(int(shown.sum())))),
        "corner": _points(corner),
        "last": _points(behind),
        "bodies": [_bodies(turn, int(place)) for place in np.linspace(0, int(end.sum()) - 1, SHOWN)],
    }


def _last_shown(turn: Turn) -> float:
    """Way until the last unit is out of the arc [m]."""
    return turn.radius * turn.angle + sum(unit.leader for unit in turn.geometry)


def _bodies(turn: Turn, place: int) -> list[list[list[float]]]:
    outlines = []
    for index, unit in enumerate(turn.geometry):
        heading, middle = np.exp(1j * turn.yaw[place, index]), turn.position[place, index]
        half = unit.half_width
        corners = [(unit.front, half), (unit.front, -half), (unit.rear, -half), (unit.rear, half)]
        points = [middle + complex(*corner) * heading for corner in corners]
        outlines.append([[round(point.real, 3), round(point.imag, 3)] for point in points])
    return outlines


def _points(path: tuple[FloatArray, FloatArray]) -> list[list[float]]:
    x, y = path
    chosen = np.column_stack([x, y])[::EVERY]
    listed: list[list[float]] = np.round(np.vstack([chosen, [[x[-1], y[-1]]]]), 3).tolist()
    return listed


def differing(assessments: Sequence[Assessment]) -> list[list[str]]:
    """Rows of differences between the first vehicle and the others: key, and a value of each.

    Parameters
    ----------
    assessments : sequence of Assessment

    Returns
    -------
    list of list of str
    """
    each = [dict(_values(one.vehicle)) for one in assessments]
    keys = list(dict.fromkeys(key for values in each for key in values))
    rows = [[key, *(values.get(key, "none") for values in each)] for key in keys]
    return [row for row in rows if any(one != other for one, other in pairwise(row[1:]))]


def _values(vehicle: Vehicle) -> list[tuple[str, str]]:
    full = complete(vehicle)
    found = [("units", f"{len(full.units)}"), ("mass", f"{sum(unit.mass for unit in full.units):.5g} kg")]
    for index, unit in enumerate(full.units):
        key = f"units.{index}."
        found += [(key + "name", unit.name), (key + "mass", f"{unit.mass:.5g} kg")]
        found += [
            (key + name, f"{value:.4g} m")
            for name in ("front_hitch", "rear_hitch", "cg_height", "width", "front_overhang", "rear_overhang")
            if (value := getattr(unit, name)) is not None
        ]
        for place, axle in enumerate(unit.axles):
            found += [
                (f"{key}axles.{place}.position", f"{axle.position:.4g} m"),
                (f"{key}axles.{place}.cornering_stiffness", f"{axle.cornering_stiffness:.4g} N/rad"),
            ]
    return found
