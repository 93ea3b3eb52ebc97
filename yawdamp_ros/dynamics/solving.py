"""Systems of linear equations with a solution that does not depend on the number of threads."""

import numpy as np

from yawdamp_ros.dynamics.kinematics import FloatArray

LARGEST_SYSTEM = 4
"""Equations whose bits no kernels of OpenBLAS 0.3.23 change by splitting them over threads.

From 5 on those for processors without AVX do, from 6 on those for AVX-512, from 12 on those for AVX2.
"""


def solve(matrix: FloatArray, right: FloatArray) -> FloatArray:
    """Solve systems of linear equations with positive definite matrices.

    Parameters
    ----------
    matrix : ndarray, shape (..., n, n)
        Symmetric and positive definite, as mass matrices are: elimination needs no pivoting.
    right : ndarray, shape (..., n, k)

    Returns
    -------
    ndarray, shape (..., n, k)

    Examples
    --------
    >>> solve(np.array([[2.0, 0.0], [0.0, 4.0]]), np.array([[1.0], [1.0]])).tolist()
    [[0.5], [0.25]]
    """
    size = matrix.shape[-1]
    if size <= LARGEST_SYSTEM:
        return np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)
    stack = np.broadcast_shapes(matrix.shape[:-2], right.shape[:-2])
    both = (np.broadcast_to(part, (*stack, *part.shape[-2:])) for part in (matrix, right))
    rows = np.concatenate(list(both), axis=-1)
    for place in range(size):
        pivot = rows[..., place, :] / rows[..., place, place, np.newaxis]
        rows -= rows[..., :, place, np.newaxis] * pivot[..., np.newaxis, :]
        rows[..., place, :] = pivot
    return rows[..., size:]
