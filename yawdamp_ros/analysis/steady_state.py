"""The steady turn: how much steering a curve needs, and what the vehicle does in it."""

from dataclasses import dataclass

import numpy as np

from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.dynamics import LinearModel, linear_model
from yawdamp_ros.dynamics.kinematics import FloatArray


@dataclass(frozen=True)
class SteadyTurn:
    """A steady turn per unit of yaw rate; unlike a static gain it exists at a critical speed, too.

    Attributes
    ----------
    steering_angle : float
        Road-wheel steer angle over yaw rate, in s.
    lateral_velocity : float
        Of the lead unit's centre of gravity over yaw rate, in m.
    articulation : ndarray, shape (n - 1,)
        Articulation angles over yaw rate, in s.
    """

    steering_angle: float
    lateral_velocity: float
    articulation: FloatArray


@dataclass(frozen=True)
class Steering:
    """``delta = equivalent_wheelbase / R + understeer_gradient a_y`` in a steady turn of radius R.

    Attributes
    ----------
    equivalent_wheelbase : float
        Steer angle times radius at vanishing speed, in m. Of a two-axle vehicle it is the wheelbase; the
        tyres of an axle group scrub in a turn, which lengthens it.
    understeer_gradient : float
        In rad/(m/s^2); positive is understeer.
    """

    equivalent_wheelbase: float
    understeer_gradient: float


def steady_turn(model: LinearModel) -> SteadyTurn:
    """Solve for the steady turn in which every unit yaws alike.

    Parameters
    ----------
    model : LinearModel

    Returns
    -------
    SteadyTurn

    Raises
    ------
    AnalysisError
        If no steer angle holds such a turn.
    """
    rates = len(model.vehicle.units) + 1
    unknown = [0, *range(rates, len(model.state_matrix))]
    balance = np.column_stack([model.state_matrix[:rates, unknown], model.input_matrix[:rates]])
    try:
        solution = np.linalg.solve(balance, -model.state_matrix[:rates, 1:rates].sum(axis=1))
    except np.linalg.LinAlgError as error:
        message = f"{model.vehicle.name}: no steer angle holds a steady turn"
        raise AnalysisError(message) from error
    return SteadyTurn(float(solution[-1]), float(solution[0]), solution[1:-1])


def steady_steering(model: LinearModel) -> Steering:
    """Split the steer angle of a steady turn into geometry and understeer.

    Linear tyres make the steer angle ``(L + K u^2) / R`` at every speed, in both models, so that two
    speeds give both numbers.

    Parameters
    ----------
    model : LinearModel

    Returns
    -------
    Steering

    Raises
    ------
    AnalysisError
        If no steer angle holds a steady turn.
    """
    faster = linear_model(model.vehicle, 2.0 * model.speed, model.model)
    here, there = (steady_turn(each).steering_angle * each.speed for each in (model, faster))
    slope = (there - here) / (faster.speed**2 - model.speed**2)
    return Steering(here - slope * model.speed**2, slope)


def static_gains(model: LinearModel) -> dict[str, float]:
    """Steady value of every output for a road-wheel steer angle of 1 rad, by output name.

    Parameters
    ----------
    model : LinearModel

    Returns
    -------
    dict of str to float
        In the output's unit per rad. An unstable vehicle does not settle there.

    Raises
    ------
    AnalysisError
        If the state matrix is singular, as it is at a monotonic critical speed.
    """
    try:
        state = np.linalg.solve(model.state_matrix, -model.input_matrix)
    except np.linalg.LinAlgError as error:
        message = f"{model.vehicle.name}: a root at the origin: there are no static gains"
        raise AnalysisError(message) from error
    gains = model.output_matrix @ state + model.feedthrough
    return dict(zip(model.output_names, map(float, gains), strict=True))
