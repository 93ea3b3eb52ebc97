"""What the linear model of a vehicle makes of a drive whose speed varies, an hour in a moment.

The speed is followed quasi-statically, as a run follows it: at each instant the model is that of its speed.
Steps of one size are exact for what is held over them. A drive is cut into blocks that are stepped side by
side, all of them with one product of stacked matrices; what each starts from follows from the block before.
"""

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.linalg import expm

from yawdamp_ros.drives.drive import Drive
from yawdamp_ros.dynamics import LinearModel, linear_model
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.stepping.speed_input import HIGHEST_SPEED, LOWEST_SPEED
from yawdamp_ros.vehicle import Vehicle

IntArray = npt.NDArray[np.int64]
STEP_SIZE = 0.01
"""In s: a hundredth of the period of anything that a heavy vehicle does."""
SPEED_RATIO = 1.01
"""From one speed for which matrices are computed to the next; between two they are interpolated."""
MOST_BLOCKS = 256


class Inputs(NamedTuple):
    """What acts on a vehicle at instants a step apart.

    Attributes
    ----------
    times : ndarray, shape (k,)
        In s.
    steering : ndarray, shape (k,)
        Road-wheel steer angle in force at each instant, rad.
    mean_steering : ndarray, shape (k,)
        Its mean from each instant to the next, rad.
    speed : ndarray, shape (k,)
        In m/s.
    """

    times: FloatArray
    steering: FloatArray
    mean_steering: FloatArray
    speed: FloatArray


def inputs_of(drive: Drive, speed: float, step_size: float = STEP_SIZE) -> Inputs:
    """Inputs of a drive at the instants of a grid; every sample holds until the next.

    Parameters
    ----------
    drive : Drive
    speed : float
        In m/s, where the drive does not tell; also at the start, where it tells the acceleration.
    step_size : float
        In s.
    """
    steering = drive["steering"]
    count = math.floor(drive.duration / step_size + 1e-6) + 1
    times: FloatArray = step_size * np.arange(count, dtype=np.float64)
    # The integral of what is held is linear between samples.
    knots = np.append(steering.times, max(times[-1], steering.times[-1]) + step_size)
    integral = np.concatenate([[0.0], np.cumsum(np.diff(knots) * steering.values)])
    at = np.interp(np.append(times, times[-1] + step_size), knots, integral)
    followed = drive.speed(speed)
    speeds = np.full(count, speed) if followed is None else followed.held(times + 1e-9)
    return Inputs(
        times,
        steering.held(times + 1e-9),
        np.diff(at) / step_size,
        np.clip(speeds, LOWEST_SPEED, HIGHEST_SPEED),
    )


def predict(vehicle: Vehicle, inputs: Inputs, model: str = "consistent") -> Mapping[str, FloatArray]:
    """Outputs of a vehicle at the instants of its inputs, from a steady turn at the first.

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
    """
    step = float(inputs.times[1] - inputs.times[0]) if len(inputs.times) > 1 else STEP_SIZE
    low, high = float(inputs.speed.min()), float(inputs.speed.max())
    nodes = max(math.ceil(math.log(high / low) / math.log(SPEED_RATIO)), 1) + 1
    speeds = np.geomspace(low, high, nodes)
    models = [linear_model(vehicle, float(speed), model) for speed in speeds]
    place = np.clip(np.searchsorted(speeds, inputs.speed, side="right") - 1, 0, nodes - 2)
    width = speeds[place + 1] - speeds[place]
    share = np.where(width > 0.0, (inputs.speed - speeds[place]) / np.where(width > 0.0, width, 1.0), 0.0)
    weights = _Between(place, share)
    states = _states(_steps(models, step), weights, inputs.mean_steering, _steady(models, inputs))
    outputs = np.stack([np.column_stack([each.output_matrix, each.feedthrough]) for each in models])
    found = _outputs(outputs, weights, np.column_stack([states, inputs.steering]))
    named = dict(zip(models[0].output_names, found.T, strict=True))
    lead = vehicle.unit_names[0]
    yaw = np.concatenate(
        [[0.0], np.cumsum(0.5 * step * (named[f"{lead}/yaw_rate"][1:] + named[f"{lead}/yaw_rate"][:-1]))]
    )
    for joint, unit in enumerate(vehicle.unit_names):
        if joint:
            yaw = yaw - named[f"articulation_{joint}"]
        named[f"{unit}/yaw"] = yaw
    return named


class _Between(NamedTuple):
    """Where each instant's speed lies: after which node, and how far on the way to the next."""

    place: IntArray
    share: FloatArray

    def of(self, stack: FloatArray, instants: slice | IntArray) -> FloatArray:
        """Matrices of a stack, one for each of some instants."""
        place, share = self.place[instants], self.share[instants][:, np.newaxis, np.newaxis]
        mixed: FloatArray = stack[place] * (1.0 - share) + stack[place + 1] * share
        return mixed


def _steps(models: list[LinearModel], step: float) -> FloatArray:
    """State after a step by state and held steering, shape (m, 2 n, 2 n + 1)."""
    size = len(models[0].state_matrix)
    rates = np.zeros((len(models), size + 1, size + 1))
    rates[:, :size, :size] = [each.state_matrix for each in models]
    rates[:, :size, size] = [each.input_matrix for each in models]
    stack: FloatArray = expm(step * rates)[:, :size]
    return stack


def _steady(models: list[LinearModel], inputs: Inputs) -> FloatArray:
    nearest = models[int(np.argmin([abs(each.speed - inputs.speed[0]) for each in models]))]
    turn = np.linalg.solve(nearest.state_matrix, nearest.input_matrix)
    return np.asarray(-inputs.steering[0] * turn, dtype=np.float64)


def _states(steps: FloatArray, weights: _Between, steering: FloatArray, start: FloatArray) -> FloatArray:
    count, size = len(steering), len(start)
    blocks = max(min(MOST_BLOCKS, count // 64), 1)
    length = -(-count // blocks)
    first = length * np.arange(-(-count // length))
    blocks = len(first)
    angles = np.zeros(blocks * length)
    angles[:count] = steering
    padded = _Between(np.resize(weights.place, blocks * length), np.resize(weights.share, blocks * length))
    moved = np.zeros((blocks, size, size + 1))  # by the state at the start, and what steering adds
    moved[:, :, :size] = np.eye(size)
    for index in range(length):
        now = padded.of(steps, first + index)
        added = now[:, :, size] * angles[first + index][:, np.newaxis]
        moved = now[:, :, :size] @ moved
        moved[:, :, size] += added
    starts = np.empty((blocks, size))
    starts[0] = start
    for block in range(1, blocks):
        starts[block] = moved[block - 1] @ np.append(starts[block - 1], 1.0)
    states = np.empty((length, blocks, size))
    now_at = starts[:, :, np.newaxis]
    for index in range(length):
        states[index] = now_at[:, :, 0]
        now = padded.of(steps, first + index)
        now_at = (
            now[:, :, :size] @ now_at + now[:, :, size:] * angles[first + index][:, np.newaxis, np.newaxis]
        )
    return states.transpose(1, 0, 2).reshape(blocks * length, size)[:count]


def _outputs(stack: FloatArray, weights: _Between, known: FloatArray) -> FloatArray:
    if len(stack) == 2 and (stack[0] == stack[1]).all():  # noqa: PLR2004 - one speed
        constant: FloatArray = known @ stack[0].T
        return constant
    parts = []
    for begin in range(0, len(known), 1 << 14):
        piece = slice(begin, begin + (1 << 14))
        parts.append((weights.of(stack, piece) @ known[piece][:, :, np.newaxis])[:, :, 0])
    return np.concatenate(parts)
