"""Prediction of a drive with varying speed by the linear model; an hour takes a moment.

The speed is followed quasi-statically, as a run follows it: at each instant the model is that of its speed.
Steps of one size are exact for held inputs. A drive is cut into blocks that are stepped side by
side, all of them with one product of stacked matrices; what each starts from follows from the block before.
"""

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from yawdamp_ros.drives.drive import Drive
from yawdamp_ros.dynamics import linear_model
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.stepping.held_input import HIGHEST_SPEED, LOWEST_FOLLOWED
from yawdamp_ros.vehicle import Vehicle

STEP_SIZE = 0.01
"""Step size [s]: a hundredth of the shortest period in a heavy vehicle's motion."""
SPEED_RATIO = 1.01
"""Ratio of neighbouring speeds with computed matrices; between two they are interpolated."""
MOST_BLOCKS = 256


class Inputs(NamedTuple):
    """Inputs of a vehicle at instants a step apart.

    Attributes
    ----------
    times : ndarray, shape (k,)
        Times [s].
    steering : ndarray, shape (k,)
        Road-wheel steer angle in force at each instant [rad].
    mean_steering : ndarray, shape (k,)
        Mean steering from each instant to the next [rad].
    speed : ndarray, shape (k,)
        Speed [m/s].

    Examples
    --------
    >>> from yawdamp_ros import load_drive
    >>> drive = load_drive("docs/recorded_drive.csv").steered_by(18.0)
    >>> from yawdamp_ros.drives import inputs_of
    >>> inputs = inputs_of(drive.window(0.0, 10.0), 20.0)
    >>> inputs.times[:3].tolist()
    [0.0, 0.01, 0.02]
    """

    times: FloatArray
    steering: FloatArray
    mean_steering: FloatArray
    speed: FloatArray


def inputs_of(drive: Drive, speed: float, step_size: float = STEP_SIZE, delay: float | None = None) -> Inputs:
    """Return the inputs of a drive at the instants of a grid; every sample holds until the next.

    Parameters
    ----------
    drive : Drive
    speed : float
        Speed for a drive without one [m/s]; the initial speed for a drive with the acceleration.
    step_size : float
        Step size [s].
    delay : float, optional
        Time in s by which the steering acts later than its stamps say, or earlier. If one is given the
        angle at an instant is interpolated, so that the prediction is a smooth function of the delay.

    Returns
    -------
    Inputs

    Examples
    --------
    >>> from yawdamp_ros import load_drive
    >>> drive = load_drive("docs/recorded_drive.csv").steered_by(18.0)
    >>> from yawdamp_ros.drives import inputs_of
    >>> inputs_of(drive.window(0.0, 10.0), 20.0).steering.shape
    (1001,)
    """
    steering = drive["steering"]
    count = math.floor(drive.duration / step_size + 1e-6) + 1
    times: FloatArray = step_size * np.arange(count, dtype=np.float64)
    # The integral of a held value is linear between samples.
    knots = np.append(steering.times, max(times[-1], steering.times[-1]) + step_size)
    integral = np.concatenate([[0.0], np.cumsum(np.diff(knots) * steering.values)])
    shift = 0.0 if delay is None else delay
    at = np.interp(np.append(times, times[-1] + step_size) - shift, knots, integral)
    instant = steering.held(times + 1e-9) if delay is None else steering.interpolated(times - shift)
    followed = drive.speed(speed)
    speeds = np.full(count, speed) if followed is None else followed.held(times + 1e-9)
    return Inputs(
        times,
        instant,
        np.diff(at) / step_size,
        np.clip(speeds, LOWEST_FOLLOWED, HIGHEST_SPEED),
    )


def predict(vehicle: Vehicle, inputs: Inputs, model: str = "consistent") -> Mapping[str, FloatArray]:
    """Return the outputs of a vehicle at the instants of its inputs, from a steady turn at the first.

    Parameters
    ----------
    vehicle : Vehicle
    inputs : Inputs
    model : str
        One of `yawdamp_ros.dynamics.MODELS`.

    Returns
    -------
    mapping of str to ndarray, shape (k,)
        ``<unit>/yaw_rate``, ``<unit>/lateral_acceleration``, ``<unit>/yaw`` and ``articulation_1`` onwards.

    Examples
    --------
    >>> from yawdamp_ros import load_drive
    >>> drive = load_drive("docs/recorded_drive.csv").steered_by(18.0)
    >>> from yawdamp_ros import load_vehicle
    >>> from yawdamp_ros.drives import inputs_of, predict
    >>> outputs = predict(load_vehicle("truck_trailer"), inputs_of(drive.window(0.0, 10.0), 20.0))
    >>> sorted(outputs)[:2]
    ['articulation_1', 'trailer/lateral_acceleration']
    """
    step = float(inputs.times[1] - inputs.times[0]) if len(inputs.times) > 1 else STEP_SIZE
    family = _Family.of(vehicle, float(inputs.speed.min()), float(inputs.speed.max()), model)
    states = _states(family, step, inputs)
    outputs = family.outputs(np.column_stack([states, inputs.steering]), inputs.speed)
    named = dict(zip(family.output_names, outputs.T, strict=True))
    lead = vehicle.unit_names[0]
    yaw = np.concatenate(
        [[0.0], np.cumsum(0.5 * step * (named[f"{lead}/yaw_rate"][1:] + named[f"{lead}/yaw_rate"][:-1]))]
    )
    for joint, unit in enumerate(vehicle.unit_names):
        if joint:
            yaw = yaw - named[f"articulation_{joint}"]
        named[f"{unit}/yaw"] = yaw
    return named


class _Family(NamedTuple):
    """A linear model at every speed: all of its numbers are ``a + b / speed + c speed``.

    Attributes
    ----------
    rates, responses : ndarray, shape (3, .., 2 n + 1)
        The three parts of state and input matrix, and of output matrix and feed-through.
    output_names : tuple of str
    """

    rates: FloatArray
    responses: FloatArray
    output_names: tuple[str, ...]

    @classmethod
    def of(cls, vehicle: Vehicle, low: float, high: float, model: str) -> "_Family":
        # Three speeds determine the three parts; they differ even if the drive keeps one speed.
        speeds = np.array([0.8 * low, np.sqrt(low * high), 1.25 * high])
        models = [linear_model(vehicle, float(speed), model) for speed in speeds]
        basis = np.linalg.inv(_basis(speeds))
        rates = [np.column_stack([each.state_matrix, each.input_matrix]) for each in models]
        responses = [np.column_stack([each.output_matrix, each.feedthrough]) for each in models]
        return cls(
            np.tensordot(basis, np.array(rates), 1),
            np.tensordot(basis, np.array(responses), 1),
            models[0].output_names,
        )

    def at(self, speeds: FloatArray) -> FloatArray:
        """State and input matrix at each of some speeds, shape (m, 2 n, 2 n + 1)."""
        return np.tensordot(_basis(speeds), self.rates, 1)

    def outputs(self, known: FloatArray, speeds: FloatArray) -> FloatArray:
        """Outputs by states and steer angle, shape (k, 2 n + 1), each at its own speed."""
        parts = zip(_basis(speeds).T, self.responses, strict=True)
        found: FloatArray = sum(
            (share[:, np.newaxis] * (known @ part.T) for share, part in parts), np.zeros(())
        )
        return found


def _basis(speeds: FloatArray) -> FloatArray:
    return np.column_stack([np.ones_like(speeds), 1.0 / speeds, speeds])


def _steps(family: _Family, step: float, speeds: FloatArray) -> FloatArray:
    """State after a step by state and held steering, each at its own speed, shape (k, 2 n, 2 n + 1)."""
    from scipy.linalg import expm  # noqa: PLC0415 - it loads longer than most commands run

    low, high = float(speeds.min()), float(speeds.max())
    nodes = np.geomspace(low, high, max(math.ceil(math.log(high / low) / math.log(SPEED_RATIO)), 1) + 1)
    rates = family.at(nodes)
    square = np.zeros((len(nodes), rates.shape[2], rates.shape[2]))
    square[:, :-1] = step * rates
    stack: FloatArray = expm(square)[:, :-1]
    if low == high:
        return np.broadcast_to(stack[:1], (len(speeds), *stack.shape[1:]))
    place = np.clip(np.searchsorted(nodes, speeds, side="right") - 1, 0, len(nodes) - 2)
    share = ((speeds - nodes[place]) / (nodes[place + 1] - nodes[place]))[:, np.newaxis, np.newaxis]
    mixed: FloatArray = stack[place]
    mixed += share * (stack[place + 1] - mixed)
    return mixed


def _states(family: _Family, step: float, inputs: Inputs) -> FloatArray:
    count = len(inputs.times)
    length = -(-count // max(min(MOST_BLOCKS, count // 64), 1))
    blocks = -(-count // length)
    whole = blocks * length
    steps = _steps(family, step, np.append(inputs.speed, np.full(whole - count, inputs.speed[-1])))
    size = steps.shape[1]
    # Instants of all blocks side by side come next to each other in memory.
    steps = np.ascontiguousarray(steps.reshape(blocks, length, size, size + 1).swapaxes(0, 1))
    angles = np.append(inputs.mean_steering, np.zeros(whole - count)).reshape(blocks, length).T
    added = steps[..., -1] * angles[..., np.newaxis]
    moved = np.zeros((blocks, size, size + 1))  # by the state at the start, and the share of the steering
    moved[:, :, :size] = np.eye(size)
    for transition, steered in zip(steps[..., :size], added, strict=True):
        moved = transition @ moved
        moved[:, :, size] += steered
    first = family.at(inputs.speed[:1])[0]
    now = np.empty((blocks, size, 1))
    now[0, :, 0] = -inputs.steering[0] * np.linalg.solve(first[:, :size], first[:, size])
    for block in range(1, blocks):
        now[block, :, 0] = moved[block - 1] @ np.append(now[block - 1, :, 0], 1.0)
    states = np.empty((length, blocks, size))
    for index, (transition, steered) in enumerate(zip(steps[..., :size], added, strict=True)):
        states[index] = now[:, :, 0]
        now = transition @ now + steered[:, :, np.newaxis]
    states = states.swapaxes(0, 1)
    return states.reshape(whole, size)[:count]
