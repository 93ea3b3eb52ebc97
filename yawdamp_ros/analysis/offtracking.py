"""Offtracking: lateral distance of the last axle from the path of the steer axle."""

import functools
from typing import NamedTuple

import numpy as np

from yawdamp_ros.analysis.answers import Answers, stack_of
from yawdamp_ros.analysis.lane_change import LaneChangeRuns, Paths, steer_axle_position
from yawdamp_ros.analysis.steady_state import steady_turns
from yawdamp_ros.dynamics import LinearModel
from yawdamp_ros.dynamics.kinematics import FloatArray, coupled_positions
from yawdamp_ros.stepping import Response
from yawdamp_ros.vehicle import Vehicle

STEADY_RADIUS = 400.0
"""Radius of the steady curve, at the lead unit's centre of gravity [m]."""


class Path(NamedTuple):
    """Ground path of an axle [m].

    Attributes
    ----------
    x, y : ndarray, shape (m,)
    """

    x: FloatArray
    y: FloatArray


def axle_path(response: Response, unit: int, position: float) -> Path:
    """Return the path of a point on a unit's centre line.

    Parameters
    ----------
    response : Response
        A run that holds x and y.
    unit : int
        Index of the unit.
    position : float
        Position from its centre of gravity, forward positive [m].

    Returns
    -------
    Path

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> model = linear_model(load_vehicle("a_double"))
    >>> from yawdamp_ros.analysis import run_lane_change
    >>> response = run_lane_change(model)
    >>> from yawdamp_ros.analysis import axle_path
    >>> axle_path(response, unit=3, position=-2.0).y.shape
    (2401,)
    """
    return _on_axle(Paths(response.yaw, response.x, response.y), unit, np.asarray(position))


def high_speed_transient_offtracking(vehicle: Vehicle, response: Response) -> float:
    """Return the largest lateral distance between the paths of the last axle and of the steer axle.

    A measure of the Australian PBS scheme and of RTAC, read in secondary sources. Lateral is across the road,
    which runs along x.

    Parameters
    ----------
    vehicle : Vehicle
    response : Response
        A lane change that begins along x.

    Returns
    -------
    float
        In m.

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> model = linear_model(load_vehicle("a_double"))
    >>> from yawdamp_ros.analysis import run_lane_change
    >>> response = run_lane_change(model)
    >>> from yawdamp_ros.analysis import high_speed_transient_offtracking
    >>> round(high_speed_transient_offtracking(model.vehicle, response), 2)
    0.83
    """
    steer = axle_path(response, 0, steer_axle_position(vehicle))
    last = axle_path(response, len(vehicle.units) - 1, _last_axle(vehicle))
    return float(_beside(steer, last))


def lane_change_offtrackings(model: LinearModel) -> Answers:
    """`high_speed_transient_offtracking` of each of a stack of vehicles in the lane change of SAE J2179."""
    runs = LaneChangeRuns(model)
    paths, vehicle, count = runs.paths(), model.vehicle, len(model.state_matrix)
    steer = np.broadcast_to(steer_axle_position(vehicle), count)[:, np.newaxis]
    last = np.broadcast_to(_last_axle(vehicle), count)[:, np.newaxis]
    ahead, behind = _on_axle(paths, 0, steer), _on_axle(paths, len(vehicle.units) - 1, last)
    pairs = zip(zip(*ahead, strict=True), zip(*behind, strict=True), strict=True)
    values = np.array([_beside(Path(*one), Path(*other)) for one, other in pairs])
    values[list(runs.reasons)] = np.nan
    return Answers(values, runs.reasons)


def steady_offtracking(model: LinearModel, radius: float = STEADY_RADIUS) -> float:
    """Return the steady offtracking of one vehicle; see `steady_offtrackings`.

    Parameters
    ----------
    model : LinearModel
    radius : float
        Radius of the path of the lead unit's centre of gravity [m].

    Returns
    -------
    float
        In m.

    Raises
    ------
    AnalysisError
        If no steer angle holds a steady turn on that radius.

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> model = linear_model(load_vehicle("a_double"))
    >>> from yawdamp_ros.analysis import steady_offtracking
    >>> round(float(steady_offtracking(model)), 2)
    0.44
    """
    value = steady_offtrackings(stack_of(model), radius).only()
    return np.nan if value is None else value


def steady_offtrackings(model: LinearModel, radius: float = STEADY_RADIUS) -> Answers:
    """Radius of the last axle's path less that of the steer axle's on a steady curve, of a stack of vehicles.

    No standard was readable; the curve is this package's choice. The angles are those of the linear
    model, the positions follow from them by true geometry.

    Parameters
    ----------
    model : LinearModel
        Model of a stack of vehicles.
    radius : float
        Radius of the path of the lead unit's centre of gravity [m].

    Returns
    -------
    Answers
        In m; positive where the last axle runs outside the steer axle's path, as at high speed, negative
        where it cuts the corner. None where no steer angle holds a steady turn on that radius.
    """
    turns = steady_turns(model)
    held = np.abs(turns.lateral_velocity) < radius
    lateral = np.where(held, turns.lateral_velocity, 0.0)
    # Turning left about the origin: where the centre of gravity moves at (u, v), it lies at (v, -u) / r.
    lead = lateral - 1j * np.sqrt(radius**2 - lateral**2)
    yaw_rate = -model.speed / lead.imag
    angles = np.concatenate([np.zeros((len(lead), 1)), turns.articulation.cumsum(axis=1)], axis=1)
    heading = np.exp(-1j * yaw_rate[:, np.newaxis] * angles)
    positions = coupled_positions(model.vehicle.hitches, lead, heading)
    steer, last = steer_axle_position(model.vehicle), _last_axle(model.vehicle)
    values = np.abs(positions[:, -1] + last * heading[:, -1]) - np.abs(positions[:, 0] + steer)
    message = f"{model.vehicle.name}: no steer angle holds a steady turn of {radius:g} m"
    reasons = dict.fromkeys(np.flatnonzero(~held).tolist(), message)
    return Answers(np.where(held, values, np.nan), reasons)


def _on_axle(paths: Paths, unit: int, position: FloatArray) -> Path:
    """Paths of points on a unit's centre line, shape (k, m)."""
    yaw = paths.yaw[..., unit]
    return Path(paths.x[..., unit] + position * np.cos(yaw), paths.y[..., unit] + position * np.sin(yaw))


def _beside(steer: Path, last: Path) -> float:
    """Largest lateral distance of one path from another."""
    # The road before the run is straight: there the steer axle's path lies where it starts.
    return float(np.abs(last.y - np.interp(last.x, steer.x, steer.y)).max())


def _last_axle(vehicle: Vehicle) -> float:
    rearmost: float = functools.reduce(np.minimum, [axle.position for axle in vehicle.units[-1].axles])
    return rearmost
