"""Linear motion that nothing drives any more, at many instants at once: exact, with no step to choose."""

import numpy as np
from scipy.linalg import expm

from yawdamp_ros.dynamics.kinematics import FloatArray


def free_motion(matrix: FloatArray, start: FloatArray, step: float, count: int) -> FloatArray:
    """States of ``x' = matrix x`` at evenly spaced instants.

    A steering that is itself the solution of a linear equation, as a sine is, may be part of the state.

    Parameters
    ----------
    matrix : ndarray, shape (m, m)
    start : ndarray, shape (m,)
    step : float
        Time between instants in s.
    count : int
        Number of instants, the start among them.

    Returns
    -------
    ndarray, shape (count, m)
    """
    states = start[np.newaxis]
    transition = np.asarray(expm(matrix * step), dtype=np.float64)
    # Each round continues all states so far at once: the transition over them is squared as they double.
    while len(states) < count:
        states = np.concatenate([states, states @ transition.T])
        transition = transition @ transition
    return states[:count]
