"""Offtracking: how far beside the path of the steer axle the last axle runs."""

from typing import NamedTuple

import numpy as np

from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.analysis.lane_change import steer_axle
from yawdamp_ros.analysis.steady_state import steady_turn
from yawdamp_ros.dynamics import LinearModel
from yawdamp_ros.dynamics.kinematics import FloatArray, coupled_positions
from yawdamp_ros.stepping import Response
from yawdamp_ros.vehicle import Vehicle

STEADY_RADIUS = 400.0
"""Of the steady curve, at the lead unit's centre of gravity, in m."""


class Path(NamedTuple):
    """Ground path of an axle in m.

    Attributes
    ----------
    x, y : ndarray, shape (m,)
    """

    x: FloatArray
    y: FloatArray


def axle_path(response: Response, unit: int, position: float) -> Path:
    """Path of a point on a unit's centre line.

    Parameters
    ----------
    response : Response
        A run that holds x and y.
    unit : int
        Index of the unit.
    position : float
        From its centre of gravity in m, forward positive.

    Returns
    -------
    Path
    """
    yaw = response.yaw[:, unit]
    return Path(
        response.x[:, unit] + position * np.cos(yaw),
        response.y[:, unit] + position * np.sin(yaw),
    )


def high_speed_transient_offtracking(vehicle: Vehicle, response: Response) -> float:
    """Largest lateral distance between the paths of the last axle and of the steer axle in a lane change.

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
    """
    steer = axle_path(response, 0, steer_axle(vehicle).position)
    last = axle_path(response, len(vehicle.units) - 1, _last_axle(vehicle))
    # The road before the run is straight: there the steer axle's path lies where it starts.
    beside = last.y - np.interp(last.x, steer.x, steer.y)
    return float(np.abs(beside).max())


def steady_offtracking(model: LinearModel, radius: float = STEADY_RADIUS) -> float:
    """Radius of the last axle's path less that of the steer axle's on a steady curve.

    No standard was readable; the curve is this package's choice. The angles are those of the linear
    model, the positions follow from them by true geometry.

    Parameters
    ----------
    model : LinearModel
    radius : float
        Of the path of the lead unit's centre of gravity in m.

    Returns
    -------
    float
        In m; positive where the last axle runs outside the steer axle's path, as at high speed, negative
        where it cuts the corner.

    Raises
    ------
    AnalysisError
        If no steer angle holds a steady turn on that radius.
    """
    turn = steady_turn(model)
    if not abs(turn.lateral_velocity) < radius:
        message = f"{model.vehicle.name}: no steer angle holds a steady turn of {radius:g} m"
        raise AnalysisError(message)
    # Turning left about the origin: where the centre of gravity moves at (u, v), it lies at (v, -u) / r.
    lead = turn.lateral_velocity - 1j * np.sqrt(radius**2 - turn.lateral_velocity**2)
    yaw_rate = -model.speed / lead.imag
    heading = np.exp(-1j * np.concatenate([[0.0], np.cumsum(yaw_rate * turn.articulation)]))
    positions = coupled_positions(model.vehicle.hitches, lead, heading)
    steer, last = steer_axle(model.vehicle).position, _last_axle(model.vehicle)
    return float(abs(positions[-1] + last * heading[-1]) - abs(positions[0] + steer))


def _last_axle(vehicle: Vehicle) -> float:
    return min(axle.position for axle in vehicle.units[-1].axles)
