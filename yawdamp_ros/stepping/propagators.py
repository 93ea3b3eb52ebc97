"""The matrices of a step at any speed: the zero-order hold by matrix exponential."""

import math
from functools import lru_cache
from typing import cast

import numpy as np

from yawdamp_ros.dynamics import LOWEST_SPEED, LinearModel, linear_model
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.dynamics.speed_family import SPEEDS, SpeedParts
from yawdamp_ros.stepping.propagation import LARGEST_PRODUCT, Propagator

KNOWN_MODELS = 4
"""Number of models whose propagators are kept for further runs."""
LONGEST_BLOCK = 32
"""Most steps that are computed from one start."""
LARGEST_MATRIX_PRODUCT = 262144
"""Multiplications up to which OpenBLAS does not split a product of matrices over threads."""
_TAYLOR = np.array([1.0 / math.factorial(power) for power in range(16)]).reshape(4, 4)
_OF_IDENTITY, _OF_POWERS = _TAYLOR[:, :1].copy(), _TAYLOR[:, 1:].copy()
"""Taylor coefficients of the exponential: for norms up to 1/2 the first term left out is at most 7e-19."""


class Propagators:
    """A vehicle in one model, to be stepped at any speed.

    The matrices are a sum of three parts, so that a new speed costs a few products of small matrices.

    Parameters
    ----------
    model : LinearModel
        Model at any speed.
    step_size : float
        Step size [s].
    """

    def __init__(self, model: LinearModel, step_size: float) -> None:
        self._vehicle, self._model, self._step_size = model.vehicle, model.model, step_size
        self._size = len(model.state_matrix)
        self._block = _block_length(self._size)
        self._parts = SpeedParts.of(self._numbers(np.array(SPEEDS)))
        self._norms = [_norm(self._rates(part)) for part in self._parts]

    @classmethod
    @lru_cache(maxsize=KNOWN_MODELS)
    def of(cls, model: LinearModel, step_size: float) -> "Propagators":
        """Return those of a model, which all its runs share."""
        return cls(model, step_size)

    def at(self, speed: float) -> Propagator:
        """Matrices at a speed [m/s].

        Raises
        ------
        DynamicsError
            As `linear_model`.
        """
        if not LOWEST_SPEED <= speed < math.inf:
            linear_model(self._vehicle, speed, self._model)  # raises the error
        numbers = self._parts.at(speed)
        constant, by_inverse, by_speed = self._norms
        step = exponential(self._rates(numbers), constant + by_inverse / speed + by_speed * speed)
        if not math.isfinite(step[0, 0]):
            linear_model(self._vehicle, speed, self._model)
        width = self._size + 1
        outputs = numbers[(self._size + 2) ** 2 :].reshape(-1, width)
        return Propagator(speed, _steps(step, self._size, self._block), np.asfortranarray(outputs))

    def _numbers(self, speeds: FloatArray) -> FloatArray:
        """Rates over a step of states, yaw and steer angle, and outputs, in a row for each speed."""
        model = linear_model(self._vehicle, cast("float", speeds), self._model)  # as of a stack
        count, size = len(speeds), self._size
        rates = np.zeros((count, size + 2, size + 2))
        rates[:, :size, :size] = model.state_matrix
        rates[:, :size, -1] = model.input_matrix
        rates[:, size, 1] = 1.0  # yaw, by the yaw rate of the lead unit
        rates *= self._step_size
        outputs = np.concatenate([model.output_matrix, model.feedthrough[..., np.newaxis]], axis=-1)
        return np.concatenate([rates.reshape(count, -1), outputs.reshape(count, -1)], axis=-1)

    def _rates(self, numbers: FloatArray) -> FloatArray:
        width = self._size + 2
        return numbers[: width * width].reshape(width, width)


def propagator(model: LinearModel, step_size: float) -> Propagator:
    """Matrices of a model for steps of a size [s], as `Propagators` has them."""
    return Propagators.of(model, step_size).at(model.speed)


def exponential(matrix: FloatArray, norm: float | None = None) -> FloatArray:
    """Matrix exponential by Taylor's series, scaled and squared.

    As accurate as `scipy.linalg.expm` for the small matrices of a step; importing that
    would take longer than all else that a node does to start.

    Parameters
    ----------
    matrix : ndarray, shape (n, n)
    norm : float, optional
        A bound of its column sums.

    Returns
    -------
    ndarray, shape (n, n)
    """
    size = len(matrix)
    bound = _norm(matrix) if norm is None else norm
    squarings = max(math.frexp(bound)[1] + 1, 0) if math.isfinite(bound) else 0
    powers = np.empty((3, size, size))
    first, second, third = powers
    np.multiply(matrix, 0.5**squarings, out=first)
    _multiply(first, first, second)
    _multiply(second, first, third)
    fourth = np.empty_like(first)
    _multiply(second, second, fourth)
    # Paterson and Stockmeyer: a polynomial in the fourth power, its coefficients polynomials below it.
    sums = np.empty((4, size * size))
    _multiply(_OF_POWERS, powers.reshape(3, -1), sums)
    sums[:, :: size + 1] += _OF_IDENTITY
    fourths = sums.reshape(4, size, size)
    result: FloatArray = fourths[3]
    other: FloatArray = first
    for below in (2, 1, 0):
        _multiply(result, fourth, other)
        other += fourths[below]
        result, other = other, result
    for _ in range(squarings):
        _multiply(result, result, other)
        result, other = other, result
    return result


def _norm(matrix: FloatArray) -> float:
    """Largest sum of a column's absolute values."""
    return float(np.abs(matrix).sum(axis=0).max())


def _steps(step: FloatArray, size: int, block: int) -> FloatArray:
    """See `Propagator.steps`."""
    width = size + 1
    powers = np.empty((block * width, width))
    powers[:width] = step[:-1, :-1]
    done = 1
    while done < block:
        more = min(done, block - done)
        last = powers[(done - 1) * width : done * width]
        _multiply(powers[: more * width], last, powers[done * width : (done + more) * width])
        done += more
    # Effect of an angle on each state: column `block` after one step, earlier columns after more, else zero.
    effects = np.zeros((width, 2 * block + 1))
    by_angle = np.ascontiguousarray(step[:-1, -1])
    effects[:, block] = by_angle
    effects[:, block - 1 : 0 : -1] = powers[:-width].dot(by_angle).reshape(-1, width).T
    steps = np.empty((block, width, width + block))
    steps[:, :, :size] = powers.reshape(block, width, width)[:, :, :size]
    of_state, later = effects.strides
    # Row j and angle i: the effect after j - i steps.
    steps[:, :, size:] = np.ndarray(
        (block, width, block + 1), effects.dtype, effects, block * later, (-later, of_state, later)
    )
    return steps.reshape(-1, width + block)


def _multiply(left: FloatArray, right: FloatArray, product: FloatArray) -> None:
    """Write the product of two matrices into a third; its bits do not depend on the number of threads."""
    columns = LARGEST_MATRIX_PRODUCT // left.size
    if right.shape[1] <= columns:
        left.dot(right, product)
        return
    for begin in range(0, right.shape[1], max(columns, 1)):
        part = slice(begin, begin + max(columns, 1))
        product[:, part] = left @ right[:, part]


def _block_length(size: int) -> int:
    fitting = [b for b in range(1, LONGEST_BLOCK + 1) if b * (size + 1) * (size + b + 1) < LARGEST_PRODUCT]
    return max(fitting, default=1)
