"""Free linear motion at many instants at once: exact, with no step to choose."""

import math

import numpy as np

from yawdamp_ros.dynamics.kinematics import FloatArray

_TERMS = 16


def free_motion(
    matrix: FloatArray, start: FloatArray, step: float | FloatArray, count: int, rows: FloatArray
) -> FloatArray:
    """Outputs of ``x' = matrix x``, ``y = rows x`` at evenly spaced instants, for a stack of systems.

    A steering that solves a linear equation itself, such as a sine, may be part of the state.

    Parameters
    ----------
    matrix : ndarray, shape (k, m, m)
    start : ndarray, shape (k, m)
    step : float or ndarray, shape (k,)
        Time between instants [s].
    count : int
        Number of instants, the start among them.
    rows : ndarray, shape (k, q, m)

    Returns
    -------
    ndarray, shape (k, q, count)
    """
    transition = stacked_exponential(matrix * np.asarray(step)[..., np.newaxis, np.newaxis])
    # Rows are carried on over a stretch, states from stretch to stretch: few products of few with few.
    stretch = max(math.isqrt(count), 1)
    known, over = _continued(rows, transition, stretch)
    stretches = -(-count // stretch)
    states, _ = _continued(start[:, np.newaxis], over.transpose(0, 2, 1), stretches)
    size = matrix.shape[-1]
    outputs = states[:, :, 0] @ known.reshape(len(matrix), -1, size).transpose(0, 2, 1)
    # By stretch, by instant within it, by output.
    outputs = outputs.reshape(len(matrix), stretches * stretch, rows.shape[1])
    return np.asarray(outputs[:, :count].transpose(0, 2, 1), dtype=np.float64)


def stacked_exponential(matrices: FloatArray) -> FloatArray:
    """Exponential of each of a stack of matrices by Taylor's series, each scaled and squared as it needs.

    Parameters
    ----------
    matrices : ndarray, shape (k, m, m)

    Returns
    -------
    ndarray, shape (k, m, m)
    """
    norms = np.abs(matrices).sum(axis=1).max(axis=1)
    _, exponents = np.frexp(norms)
    squarings = np.maximum(exponents + 1, 0)
    scaled = matrices * np.ldexp(1.0, -squarings)[:, np.newaxis, np.newaxis]
    term = np.broadcast_to(np.eye(matrices.shape[-1]), matrices.shape)
    result = term.copy()
    # For norms up to 1/2 the 17th term is at most 2e-20.
    for power in range(1, _TERMS + 1):
        term = term @ scaled / power
        result += term
    for done in range(int(squarings.max(initial=0))):
        left = squarings > done
        result[left] = result[left] @ result[left]
    return result


def _continued(rows: FloatArray, transition: FloatArray, count: int) -> tuple[FloatArray, FloatArray]:
    """``rows @ transition^i`` for i below a count, shape (k, count, q, m), and ``transition^count``."""
    stack, width, size = rows.shape
    found = np.empty((stack, count, width, size))
    found[:, 0] = rows
    done, over, total = 1, transition, np.broadcast_to(np.eye(size), transition.shape)
    for bit in range(count.bit_length()):
        if count >> bit & 1:
            total = total @ over
        # Each round continues all so far at once: the transition over them is squared as they double.
        if more := min(done, count - done):
            ahead = found[:, :more].reshape(stack, more * width, size) @ over
            found[:, done : done + more] = ahead.reshape(stack, more, width, size)
            done += more
        over = over @ over
    return found, total
