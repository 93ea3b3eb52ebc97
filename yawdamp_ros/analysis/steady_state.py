"""The steady turn: the steering that a curve needs, and the motion of the vehicle in it."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from yawdamp_ros.analysis.answers import Answers, stack_of
from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.dynamics import LinearModel, linear_model
from yawdamp_ros.dynamics.kinematics import FloatArray


@dataclass(frozen=True)
class SteadyTurn:
    """A steady turn per unit of yaw rate; unlike a static gain it exists at a critical speed, too.

    Attributes
    ----------
    steering_angle : float
        Road-wheel steer angle over yaw rate [s].
    lateral_velocity : float
        Lateral velocity of the lead unit's centre of gravity over yaw rate [m].
    articulation : ndarray, shape (n - 1,)
        Articulation angles over yaw rate [s].

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> model = linear_model(load_vehicle("a_double"))
    >>> from yawdamp_ros.analysis import steady_turn
    >>> round(float(steady_turn(model).steering_angle), 3)
    0.18
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
        Steer angle times radius at vanishing speed [m]. Of a two-axle vehicle it is the wheelbase; the
        tyres of an axle group scrub in a turn, which lengthens it.
    understeer_gradient : float
        Understeer gradient [rad/(m/s^2)]; positive is understeer.

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> model = linear_model(load_vehicle("a_double"))
    >>> from yawdamp_ros.analysis import steady_steering
    >>> round(float(steady_steering(model).equivalent_wheelbase), 2)
    4.0
    """

    equivalent_wheelbase: float
    understeer_gradient: float


class SteadyTurns(NamedTuple):
    """Steady turns of k vehicles as `SteadyTurn`, NaN where no steer angle holds one.

    Attributes
    ----------
    steering_angle, lateral_velocity : ndarray, shape (k,)
    articulation : ndarray, shape (k, n - 1)
    """

    steering_angle: FloatArray
    lateral_velocity: FloatArray
    articulation: FloatArray


def steady_turns(model: LinearModel) -> SteadyTurns:
    """Solve for the steady turn of each of a stack of vehicles in which all units have one yaw rate."""
    rates = len(model.vehicle.units) + 1
    unknown = [0, *range(rates, model.state_matrix.shape[-1])]
    acting = model.input_matrix[:, :rates, np.newaxis]
    balance = np.concatenate([model.state_matrix[:, :rates, unknown], acting], axis=2)
    sizes = np.linalg.det(balance)
    none = (sizes == 0.0)[:, np.newaxis, np.newaxis]
    yawing = -model.state_matrix[:, :rates, 1:rates].sum(axis=2)
    solution = np.linalg.solve(np.where(none, np.eye(rates), balance), yawing[..., np.newaxis])[..., 0]
    solution[none[:, 0, 0]] = np.nan
    return SteadyTurns(solution[:, -1], solution[:, 0], solution[:, 1:-1])


def steady_turn(model: LinearModel) -> SteadyTurn:
    """Solve for the steady turn in which all units have one yaw rate.

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

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> model = linear_model(load_vehicle("a_double"))
    >>> from yawdamp_ros.analysis import steady_turn
    >>> steady_turn(model).articulation.shape
    (3,)
    """
    turns = steady_turns(stack_of(model))
    if np.isnan(turns.steering_angle[0]):
        message = f"{model.vehicle.name}: no steer angle holds a steady turn"
        raise AnalysisError(message)
    return SteadyTurn(float(turns.steering_angle[0]), float(turns.lateral_velocity[0]), turns.articulation[0])


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

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> model = linear_model(load_vehicle("a_double"))
    >>> from yawdamp_ros.analysis import steady_steering
    >>> round(float(steady_steering(model).understeer_gradient), 5)
    0.0
    """
    steady_turn(model)
    wheelbase, gradient = _steerings(stack_of(model))
    return Steering(float(wheelbase[0]), float(gradient[0]))


def understeer_gradients(model: LinearModel) -> Answers:
    """`Steering.understeer_gradient` of each of a stack of vehicles, in rad/(m/s^2)."""
    _, gradients = _steerings(model)
    message = f"{model.vehicle.name}: no steer angle holds a steady turn"
    return Answers(gradients, dict.fromkeys(np.flatnonzero(np.isnan(gradients)).tolist(), message))


def _steerings(model: LinearModel) -> tuple[FloatArray, FloatArray]:
    """Equivalent wheelbase and understeer gradient of each of a stack of vehicles."""
    speed = np.broadcast_to(model.speed, len(model.state_matrix))
    faster = stack_of(linear_model(model.vehicle, 2.0 * model.speed, model.model))
    here = steady_turns(model).steering_angle * speed
    there = steady_turns(faster).steering_angle * (2.0 * speed)
    slope = (there - here) / ((2.0 * speed) ** 2 - speed**2)
    return here - slope * speed**2, slope


def static_gains(model: LinearModel) -> dict[str, float]:
    """Return the steady value of every output for a road-wheel steer angle of 1 rad, by output name.

    Parameters
    ----------
    model : LinearModel

    Returns
    -------
    dict of str to float
        Gains in the output's unit per rad. An unstable vehicle does not settle there.

    Raises
    ------
    AnalysisError
        If the state matrix is singular, as it is at a monotonic critical speed.

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> model = linear_model(load_vehicle("a_double"))
    >>> from yawdamp_ros.analysis import static_gains
    >>> round(float(static_gains(model)["tractor/yaw_rate"]), 2)
    5.55
    """
    try:
        state = np.linalg.solve(model.state_matrix, -model.input_matrix)
    except np.linalg.LinAlgError as error:
        message = f"{model.vehicle.name}: a root at the origin: there are no static gains"
        raise AnalysisError(message) from error
    gains = model.output_matrix @ state + model.feedthrough
    return dict(zip(model.output_names, map(float, gains), strict=True))
