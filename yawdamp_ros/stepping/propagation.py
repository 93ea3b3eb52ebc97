"""Many steps of the zero-order hold at once."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from yawdamp_ros.dynamics.kinematics import FloatArray

LARGEST_PRODUCT = 9216
"""Elements from which OpenBLAS splits a product over threads; their number would change bits."""


class Propagator(NamedTuple):
    """A model at one speed, ready to be stepped.

    Attributes
    ----------
    speed : float
        Speed [m/s].
    steps : ndarray, shape (b (2 n + 1), 2 n + b + 1)
        Matrix that gives the state and the yaw of the lead unit after each of b steps, from the state at the
        start of the block and the steer angles at its b + 1 instants; later angles have no effect.
    outputs : ndarray, shape (4 n - 1, 2 n + 1)
        Matrix that gives the model's outputs from state and steer angle.
    """

    speed: float
    steps: FloatArray
    outputs: FloatArray

    @property
    def dot(self) -> Callable[[FloatArray, FloatArray], object]:
        """Function that writes the product of `steps` and a vector into another vector."""
        return self.steps.dot if self.steps.size < LARGEST_PRODUCT else self._dot_by_parts

    def _dot_by_parts(self, vector: FloatArray, product: FloatArray) -> None:
        rows = (LARGEST_PRODUCT - 1) // self.steps.shape[1]
        for begin in range(0, len(self.steps), rows):
            part = slice(begin, begin + rows)
            self.steps[part].dot(vector, product[part])


class Propagation:
    """State and yaw of the lead unit over time, exact while the steering is held.

    One product computes all steps of a block from the start of the block. Its rows do not depend on the
    number of steps taken at once, so that the bits do not depend on how a run is split.

    Parameters
    ----------
    propagator : Propagator
        Matrices of one speed; replaced between blocks when the speed changes.
    """

    def __init__(self, propagator: Propagator) -> None:
        self.propagator = propagator
        size = propagator.outputs.shape[1] - 1
        self._start = np.zeros(propagator.steps.shape[1])
        self._state, self._angles = self._start[:size], self._start[size:]
        self._block = len(self._angles) - 1
        self._after = np.zeros((self._block + 1, size + 1))
        self._product = self._after[1:].reshape(-1)
        self._taken = 0

    @property
    def steering_angle(self) -> float:
        """Road-wheel steer angle in force from this instant on [rad]."""
        return float(self._angles[self._taken])

    @steering_angle.setter
    def steering_angle(self, angle: float) -> None:
        self._angles[self._taken] = angle

    @property
    def state(self) -> FloatArray:
        """Copy of the model's state, shape (2 n,)."""
        return self._after[self._taken, :-1].copy()

    @property
    def yaw_since_block_start(self) -> float:
        """Yaw of the lead unit since the start of the block [rad]."""
        return float(self._after[self._taken, -1])

    @property
    def steps_left(self) -> int:
        """Number of steps to the end of the block."""
        return self._block - self._taken

    def start_block(self) -> float:
        """Start a block at this instant; return the yaw of the lead unit in the last block [rad]."""
        turned = self.yaw_since_block_start
        self.stand(self._after[self._taken, :-1])
        return turned

    def stand(self, state: FloatArray) -> None:
        """Start a block in a state, with the steering as it is."""
        self._state[:] = state
        self._after[0, :-1] = state
        self._after[0, -1] = 0.0
        self._angles[0] = self._angles[self._taken]
        self._taken = 0

    def advance(self, angles: FloatArray, states: FloatArray) -> list[tuple[int, float]]:
        """Take a step for each of k steer angles.

        Parameters
        ----------
        angles : ndarray, shape (k,)
            Steer angles, each in force from the instant after its step on [rad].
        states : ndarray, shape (k, 2 n + 1)
            Output: the state after each step, and the yaw of the lead unit since the start of its block.

        Returns
        -------
        list of (int, float)
            Number of these steps in each block, and the yaw of the lead unit in the block that ended before
            it [rad]; 0 if none did.
        """
        blocks: list[tuple[int, float]] = []
        done = 0
        while done < len(angles):
            turned = self.start_block() if self._taken == self._block else 0.0
            left = len(angles) - done
            if not self._taken and left >= self._block:
                end = done + left // self._block * self._block
                blocks.append((self._block, turned))
                blocks += self._take_blocks(angles[done:end], states[done:end])
            else:
                end = done + min(self.steps_left, left)
                states[done:end] = self.advance_within_block(angles[done:end])
                blocks.append((end - done, turned))
            done = end
        return blocks

    def advance_within_block(self, angles: FloatArray) -> FloatArray:
        """Take at most `steps_left` steps; the states, as `advance` has them, last until the next step."""
        first = self._taken + 1
        end = first + len(angles)
        self._angles[first:end] = angles
        self.propagator.dot(self._start, self._product)
        self._taken = end - 1
        return self._after[first:end]

    def _take_blocks(self, angles: FloatArray, states: FloatArray) -> list[tuple[int, float]]:
        """Take whole blocks from the start of one; return all but the first, which is the caller's."""
        size, block = len(self._state), self._block
        products = states.reshape(-1, len(self._product))
        starts = np.empty((len(products), len(self._start)))
        starts[0, :size] = self._state
        starts[:, size:] = sliding_window_view(np.append(self._angles[0], angles), block + 1)[::block]
        dot = self.propagator.dot
        # An unstable motion may overflow; the caller checks its values.
        with np.errstate(over="ignore", invalid="ignore"):
            dot(starts[0], products[0])
            states_before = zip(starts[1:, :size], products[:-1, -size - 1 : -1], strict=True)
            for start, product, (state, before) in zip(starts[1:], products[1:], states_before, strict=True):
                state[:] = before
                dot(start, product)
        self._start[:] = starts[-1]
        self._product[:] = products[-1]
        self._taken = block
        return [(block, turned) for turned in products[:-1, -1].tolist()]


def outputs_of(known: Propagator, states_and_angle: FloatArray) -> FloatArray:
    """Outputs of the model, shape (..., 4 n - 1), by states and steer angles, shape (..., 2 n + 1)."""
    # One small product for each instant: the bits of a larger one would depend on the number of instants.
    outputs: FloatArray = np.matmul(known.outputs, states_and_angle[..., np.newaxis])[..., 0]
    return outputs
