"""Steady turns of the nonlinear model, and its linear model about one."""

from dataclasses import dataclass

import numpy as np

from yawdamp_ros.dynamics.kinematics import FloatArray, IntArray
from yawdamp_ros.nonlinear.dynamics import NonlinearDynamics
from yawdamp_ros.nonlinear.errors import NonlinearError
from yawdamp_ros.nonlinear.layout import SPEED, STEERING
from yawdamp_ros.nonlinear.outputs import Outputs

TOLERANCE = 1e-9
"""Largest rate of the state left in a steady turn, over the state's scale [1/s]."""
STRIDES = 8
"""Severities on the way to a turn, each solved from the one before."""
DIFFERENCE = 1e-6
"""Step of the differences that linearise, over the state's scale."""


@dataclass(frozen=True)
class SteadyTurn:
    """A turn in which nothing but position and yaw changes.

    Attributes
    ----------
    state : ndarray, shape (m,)
        State at the origin, along X.
    inputs : ndarray
        Inputs that hold the turn: the steer angle, and the speed demanded of the controller.
    outputs : Outputs
        Outputs of this one instant.

    Examples
    --------
    >>> from yawdamp_ros.nonlinear import NonlinearDynamics, steady_turn
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> dynamics = NonlinearDynamics(load_vehicle("truck_trailer"))
    >>> turn = steady_turn(dynamics, 20.0, dynamics.inputs(), lateral_acceleration=2.0)
    >>> bool(turn.outputs.yaw_rate[0, 0] > 0.0)
    True
    """

    state: FloatArray
    inputs: FloatArray
    outputs: Outputs


@dataclass(frozen=True)
class Linearisation:
    """``x' = A x + B delta``, ``y = C x + D delta`` for small deviations from a steady motion.

    Attributes
    ----------
    state_matrix : ndarray, shape (k, k)
    input_matrix : ndarray, shape (k,)
        Input matrix for the road-wheel steer angle [1/rad].
    output_matrix : ndarray, shape (5 n - 1, k)
    feedthrough : ndarray, shape (5 n - 1,)
    states : ndarray of int, shape (k,)
        Elements of the model's state that x holds; those that the settings keep at rest are left out.
    output_names : tuple of str
        Names as in `LinearModel.output_names`, then those of the roll angles.

    Examples
    --------
    >>> from yawdamp_ros.nonlinear import NonlinearDynamics, linearise, steady_turn
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> dynamics = NonlinearDynamics(load_vehicle("truck_trailer"))
    >>> turn = steady_turn(dynamics, 20.0, dynamics.inputs(), lateral_acceleration=2.0)
    >>> linear = linearise(dynamics, turn.state, turn.inputs)
    >>> linear.output_names[:1]
    ('truck/lateral_velocity',)
    """

    state_matrix: FloatArray
    input_matrix: FloatArray
    output_matrix: FloatArray
    feedthrough: FloatArray
    states: IntArray
    output_names: tuple[str, ...]


def steady_turn(
    dynamics: NonlinearDynamics,
    speed: float,
    inputs: FloatArray,
    *,
    steering: float | None = None,
    lateral_acceleration: float | None = None,
) -> SteadyTurn:
    """Find the steady turn at a speed by a steer angle, or by the lateral acceleration that it is to have.

    Parameters
    ----------
    dynamics : NonlinearDynamics
    speed : float
        Longitudinal speed of the lead unit [m/s].
    inputs : ndarray
        Road and demands; steering and speed are found.
    steering : float, optional
        Steer angle [rad].
    lateral_acceleration : float, optional
        Speed times yaw rate [m/s^2]; one of both is needed.

    Returns
    -------
    SteadyTurn

    Raises
    ------
    NonlinearError
        If there is no such turn, or none is found.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> dynamics = NonlinearDynamics(load_vehicle("interlink"))
    >>> turn = steady_turn(dynamics, 20.0, dynamics.inputs(), lateral_acceleration=2.0)
    >>> round(float(turn.outputs.yaw_rate[0, 2]), 6)
    0.1
    """
    if (steering is None) == (lateral_acceleration is None):
        message = "expected a steer angle or a lateral acceleration"
        raise NonlinearError(message)
    free, scale = moving_states(dynamics)
    layout = dynamics.layout
    state, row = dynamics.initial_state(speed), np.array(inputs, float)
    row[STEERING], row[SPEED] = 0.0, speed
    wanted = lateral_acceleration if steering is None else steering
    assert wanted is not None  # noqa: S101 - one of both is
    sought = np.zeros(len(free) + 2)
    sought[:-2], sought[-1] = state[free] / scale, speed

    def put(values: FloatArray) -> None:
        state[free] = values[:-2] * scale
        row[STEERING], row[SPEED] = values[-2], values[-1]

    def residual(values: FloatArray, severity: float) -> FloatArray:
        put(values)
        rates = dynamics.derivatives(state, row)
        velocity, yaw_rate = state[layout.velocity.start], state[layout.yaw_rate.start]
        found = velocity * yaw_rate if steering is None else row[STEERING]
        return np.concatenate([rates[free] / scale, [velocity - speed, found - severity * wanted]])

    from scipy.optimize import root  # noqa: PLC0415 - it loads longer than most commands run

    for stride in range(1, STRIDES + 1):
        solved = root(residual, sought, args=(stride / STRIDES,), options={"xtol": 1e-13})
        left = np.abs(solved.fun).max()
        if not left < TOLERANCE:
            held = (stride - 1) / STRIDES
            message = (
                f"{dynamics.vehicle.name}: no steady turn at {speed:g} m/s beyond {held:g} of what is asked"
            )
            raise NonlinearError(message)
        sought = solved.x
    put(sought)
    return SteadyTurn(state, row, dynamics.outputs(state[np.newaxis], row))


def linearise(dynamics: NonlinearDynamics, state: FloatArray, inputs: FloatArray) -> Linearisation:
    """Linear model of small deviations from a steady motion, by central differences.

    Parameters
    ----------
    dynamics : NonlinearDynamics
    state, inputs : ndarray
        State and inputs of the steady motion, as in `SteadyTurn`.

    Returns
    -------
    Linearisation

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> dynamics = NonlinearDynamics(load_vehicle("interlink"))
    >>> turn = steady_turn(dynamics, 20.0, dynamics.inputs(), lateral_acceleration=2.0)
    >>> poles = np.linalg.eigvals(linearise(dynamics, turn.state, turn.inputs).state_matrix)
    >>> bool(poles.real.max() < 0.0)  # the turn is stable
    True
    """
    free, scale = moving_states(dynamics)
    columns = []
    for column in range(len(free) + 1):
        ends = []
        for sign in (1.0, -1.0):
            moved, row = state.copy(), inputs.copy()
            if column < len(free):
                moved[free[column]] += sign * DIFFERENCE * scale[column]
            else:
                row[STEERING] += sign * DIFFERENCE
            ends.append(np.concatenate([dynamics.derivatives(moved, row)[free], _seen(dynamics, moved, row)]))
        step = DIFFERENCE * (scale[column] if column < len(free) else 1.0)
        columns.append((ends[0] - ends[1]) / (2.0 * step))
    matrix = np.array(columns).T
    count = len(free)
    return Linearisation(
        matrix[:count, :count],
        matrix[:count, count],
        matrix[count:, :count],
        matrix[count:, count],
        free,
        _names(dynamics),
    )


def moving_states(dynamics: NonlinearDynamics) -> tuple[IntArray, FloatArray]:
    """Elements of the state that the settings let move, but for position and yaw, and their scales.

    Returns
    -------
    free : ndarray of int, shape (k,)
    scale : ndarray, shape (k,)
    """
    layout, settings = dynamics.layout, dynamics.settings
    scale = np.full(layout.size, 0.1)
    scale[layout.velocity] = 1.0
    scale[layout.pitching_moment] = 0.1 * dynamics.vehicle_weight
    scale[layout.carcass] = 1.0
    moves = np.ones(layout.size, dtype=bool)
    moves[: layout.moving.start] = False
    if not (settings.roll and settings.track):
        moves[layout.roll] = moves[layout.roll_rate] = False
    moves[layout.pitching_moment] = settings.load_shift
    moves[layout.lateral_slip] = dynamics.lagging_wheels
    return np.flatnonzero(moves).astype(np.int64), scale[moves]


def _seen(dynamics: NonlinearDynamics, state: FloatArray, inputs: FloatArray) -> FloatArray:
    """Outputs of the linear model, of one instant."""
    found = dynamics.outputs(state[np.newaxis], inputs)
    return np.concatenate(
        [
            found.velocity[0, :, 1],
            found.yaw_rate[0],
            found.acceleration[0, :, 1],
            found.articulation[0],
            found.roll[0],
        ]
    )


def _names(dynamics: NonlinearDynamics) -> tuple[str, ...]:
    units = dynamics.vehicle.unit_names
    quantities = ("lateral_velocity", "yaw_rate", "lateral_acceleration")
    return (
        *(f"{unit}/{quantity}" for quantity in quantities for unit in units),
        *(f"articulation_{joint}" for joint in range(1, len(units))),
        *(f"{unit}/roll" for unit in units),
    )
