"""A vehicle at a speed, or a stack of vehicles, as a linear state space with named states and outputs."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from yawdamp_ros.dynamics import consistent, published
from yawdamp_ros.dynamics.errors import DynamicsError
from yawdamp_ros.dynamics.kinematics import FloatArray, cg_rows
from yawdamp_ros.vehicle import Vehicle

MODELS: Mapping[str, Callable[[Vehicle, float], tuple[FloatArray, FloatArray]]] = MappingProxyType(
    {"consistent": consistent.state_space, "published": published.state_space}
)
"""The models of a vehicle, each a function from vehicle and speed to state and input matrix."""

LOWEST_SPEED = 0.01
"""Lowest speed [m/s]. Slip angles divide by the speed and grow without bound towards standstill."""


@dataclass(frozen=True, eq=False)  # a model is equal to itself alone, and can be a key
class LinearModel:
    """``x' = A x + B delta``, ``y = C x + D delta`` for n units.

    For a stack of k vehicles, every array has a first axis of length k; each vehicle may have its own speed.

    Attributes
    ----------
    vehicle : Vehicle
    model : str
        Name of the model in `MODELS`.
    speed : float
        Longitudinal speed [m/s].
    state_matrix : ndarray, shape (2 n, 2 n)
    input_matrix : ndarray, shape (2 n,)
        Input matrix for the road-wheel steer angle [rad].
    output_matrix : ndarray, shape (4 n - 1, 2 n)
    feedthrough : ndarray, shape (4 n - 1,)
    state_names : tuple of str
        Lateral velocity of the lead unit (m/s), yaw rates (rad/s), articulation angles (rad).
    output_names : tuple of str
        For all units lateral velocity (m/s) in the unit's own frame, then yaw rate (rad/s), then
        lateral acceleration (m/s^2), each at the centre of gravity; then articulation angles (rad).

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> model = linear_model(load_vehicle("truck_trailer"))
    >>> model.output_names[:2]
    ('truck/lateral_velocity', 'trailer/lateral_velocity')
    """

    vehicle: Vehicle
    model: str
    speed: float
    state_matrix: FloatArray
    input_matrix: FloatArray
    output_matrix: FloatArray
    feedthrough: FloatArray
    state_names: tuple[str, ...]
    output_names: tuple[str, ...]


def linear_model(vehicle: Vehicle, speed: float | None = None, model: str = "consistent") -> LinearModel:
    """Return the linear model of a vehicle at a speed.

    The outputs follow from the states by the vehicle's true kinematics in every model. Where the states
    come from the published matrices, which contradict those kinematics, so do they: the accelerations
    are those that units moving like the published states would have.

    Parameters
    ----------
    vehicle : Vehicle
        Or a stack of them.
    speed : float, optional
        Longitudinal speed [m/s]; the vehicle's own unless given. Of a stack, one for all or for each.
    model : str
        One of `MODELS`.

    Returns
    -------
    LinearModel

    Raises
    ------
    DynamicsError
        If the speed is below `LOWEST_SPEED` or not finite, there is no such model for this vehicle, or its
        numbers are too far apart.

    Examples
    --------
    >>> from yawdamp_ros import load_vehicle
    >>> from yawdamp_ros import linear_model
    >>> model = linear_model(load_vehicle("truck_trailer"), speed=25.0)
    >>> model.state_names
    ('truck/lateral_velocity', 'truck/yaw_rate', 'trailer/yaw_rate', 'articulation_1')
    >>> model.state_matrix.shape
    (4, 4)
    """
    speed = vehicle.speed if speed is None else speed
    if not np.all(np.isfinite(speed) & (np.asarray(speed) >= LOWEST_SPEED)):
        message = f"speed: {speed}: expected a speed of at least {LOWEST_SPEED} m/s"
        raise DynamicsError(message)
    if model not in MODELS:
        message = f"model: {model!r}: expected one of {', '.join(MODELS)}"
        raise DynamicsError(message)
    with np.errstate(all="ignore"):  # overflow gives NaN, which is reported below
        state_matrix, input_matrix = MODELS[model](vehicle, speed)
        # A stack whose vehicles share one input matrix may come with that one alone.
        input_matrix = np.broadcast_to(input_matrix, state_matrix.shape[:-1])
        output_matrix, feedthrough = _outputs(vehicle, speed, state_matrix, input_matrix)
        parts = state_matrix, input_matrix, output_matrix, feedthrough
    if not all(np.isfinite(part).all() for part in parts):
        message = f"model: {model}: the numbers of {vehicle.name} are too far apart to compute with"
        raise DynamicsError(message)
    return LinearModel(
        vehicle=vehicle,
        model=model,
        speed=speed,
        state_matrix=state_matrix,
        input_matrix=input_matrix,
        output_matrix=output_matrix,
        feedthrough=feedthrough,
        state_names=_state_names(vehicle),
        output_names=_output_names(vehicle),
    )


class OutputSlices(NamedTuple):
    """Slices of each quantity in the outputs of n units, in the order of `LinearModel.output_names`."""

    lateral_velocity: slice
    yaw_rate: slice
    lateral_acceleration: slice
    articulation: slice

    @classmethod
    def of(cls, units: int) -> "OutputSlices":
        """Return the slices for a number of units."""
        return cls(*(slice(start, start + units) for start in range(0, 4 * units, units)))


class Outputs(NamedTuple):
    """Outputs of a linear model of n units by quantity.

    Attributes
    ----------
    lateral_velocity : ndarray, shape (..., n)
        Lateral velocity in each unit's own frame [m/s].
    yaw_rate : ndarray, shape (..., n)
        Yaw rate [rad/s].
    lateral_acceleration : ndarray, shape (..., n)
        Lateral acceleration [m/s^2].
    articulation : ndarray, shape (..., n - 1)
        Articulation angles [rad].

    Examples
    --------
    >>> import numpy as np
    >>> from yawdamp_ros.dynamics import split_outputs
    >>> split_outputs(np.arange(7.0), 2).articulation
    array([6.])
    """

    lateral_velocity: FloatArray
    yaw_rate: FloatArray
    lateral_acceleration: FloatArray
    articulation: FloatArray


def split_outputs(outputs: FloatArray, units: int) -> Outputs:
    """Return views of outputs by quantity.

    Parameters
    ----------
    outputs : ndarray, shape (..., 4 n - 1)
    units : int
        n.

    Returns
    -------
    Outputs

    Examples
    --------
    >>> import numpy as np
    >>> from yawdamp_ros.dynamics import split_outputs
    >>> split_outputs(np.arange(7.0), 2).yaw_rate
    array([2., 3.])
    """
    return Outputs(*(outputs[..., part] for part in OutputSlices.of(units)))


def _outputs(
    vehicle: Vehicle, speed: float, state_matrix: FloatArray, input_matrix: FloatArray
) -> tuple[FloatArray, FloatArray]:
    count = len(vehicle.units)
    rates = count + 1
    at = OutputSlices.of(count)
    rows = cg_rows(vehicle)
    identity = np.eye(2 * count)
    stack = state_matrix.shape[:-2]
    output_matrix = np.zeros((*stack, 4 * count - 1, 2 * count))
    output_matrix[..., at.lateral_velocity, :rates] = rows
    for index in range(count):
        # v_k = y_k' - u psi_k, and psi_1 - psi_k is the sum of the joints ahead of unit k.
        output_matrix[..., index, rates : rates + index] += np.asarray(speed)[..., np.newaxis]
    output_matrix[..., at.yaw_rate, :] = identity[1:rates]
    # a_y,k = y_k'' with y'' = v' + u r_1
    output_matrix[..., at.lateral_acceleration, :] = rows @ state_matrix[..., :rates, :]
    output_matrix[..., at.lateral_acceleration, 1] += np.asarray(speed)[..., np.newaxis]
    output_matrix[..., at.articulation, :] = identity[rates:]
    feedthrough = np.zeros((*stack, 4 * count - 1))
    feedthrough[..., at.lateral_acceleration] = (rows @ input_matrix[..., :rates, np.newaxis])[..., 0]
    return output_matrix, feedthrough


def _state_names(vehicle: Vehicle) -> tuple[str, ...]:
    lead = vehicle.unit_names[0]
    return (
        f"{lead}/lateral_velocity",
        *(f"{name}/yaw_rate" for name in vehicle.unit_names),
        *_articulations(vehicle),
    )


def _output_names(vehicle: Vehicle) -> tuple[str, ...]:
    quantities = ("lateral_velocity", "yaw_rate", "lateral_acceleration")
    return (
        *(f"{name}/{quantity}" for quantity in quantities for name in vehicle.unit_names),
        *_articulations(vehicle),
    )


def _articulations(vehicle: Vehicle) -> tuple[str, ...]:
    return tuple(f"articulation_{joint}" for joint in range(1, len(vehicle.units)))
