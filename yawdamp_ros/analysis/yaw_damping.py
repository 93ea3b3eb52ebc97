"""Yaw damping as it is measured: from the peaks of a free decay."""

import math

import numpy as np
from scipy.linalg import expm

from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.analysis.motion import free_motion
from yawdamp_ros.dynamics import LinearModel
from yawdamp_ros.dynamics.kinematics import FloatArray

PULSE_WIDTH = 0.5
"""Of the steering pulse in s, as the manoeuvre `pulse` has it."""

SETTLING = 0.5
"""Share of the extrema that is left out, from the first on: in them other modes have not died out yet."""

_SMALLEST = 1e-9
"""Extrema below this share of the largest are not used: the rounding of 1 is 1e-16."""

_STEPS_PER_RADIAN = 100.0
_DECAY_TIME = -math.log(_SMALLEST)
_MOST_STEPS = 200_000


def yaw_damping_coefficient(values: FloatArray, settling: float = SETTLING) -> float:
    """Yaw damping coefficient of the Australian PBS scheme from a free decay.

    ``D = ln r / sqrt(4 pi^2 + ln^2 r)`` where r is the mean ratio of successive peaks **of the same sign**,
    those above zero and those below it taken alike. A ratio of successive peaks of either sign spans half a
    cycle and would have to go with pi^2. The formula was read in secondary sources, not in the standard.

    Parameters
    ----------
    values : ndarray, shape (m,)
        Yaw rate of the last unit, or an articulation angle, evenly sampled after the steering has returned
        to zero. Peaks are interpolated by a parabola through three samples.
    settling : float
        Share of the extrema left out, from the first on: every mode starts with the decay, and a
        logarithmic decrement tells the damping only once the lightest is alone.

    Returns
    -------
    float
        Positive where the motion decays; of a single mode it is the damping ratio.

    Raises
    ------
    AnalysisError
        If there are no two peaks of the same sign: the motion does not swing.
    """
    extrema = _extrema(values)
    extrema = _longest_swing(extrema[np.abs(extrema) > _SMALLEST * np.abs(values).max()])
    # Three extrema give one ratio: so many are left in any case.
    used = extrema[max(min(int(settling * len(extrema)), len(extrema) - 3), 0) :]
    ratios = used[:-2] / used[2:]
    if not len(ratios):
        message = "yaw damping coefficient: the motion does not swing: expected two peaks of the same sign"
        raise AnalysisError(message)
    decrement = math.log(ratios.mean())
    return decrement / math.hypot(math.tau, decrement)


def pulse_decay(model: LinearModel) -> FloatArray:
    """Yaw rate of the last unit after a pulse of steering has ended.

    Parameters
    ----------
    model : LinearModel

    Returns
    -------
    ndarray, shape (m,)
        In rad/s for a pulse of 1 rad over `PULSE_WIDTH`, which the damping does not depend on, evenly sampled
        until the slowest mode has died out or, of an unstable vehicle, the fastest has grown as far.
    """
    size = len(model.state_matrix)
    held = np.zeros((size + 1, size + 1))
    held[:size, :size] = model.state_matrix
    held[:size, -1] = model.input_matrix
    start = np.asarray(expm(held * PULSE_WIDTH), dtype=np.float64)[:size, -1]
    eigenvalues = np.linalg.eigvals(model.state_matrix)
    step = 1.0 / (_STEPS_PER_RADIAN * float(np.abs(eigenvalues).max()))
    growing = float(eigenvalues.real.max())
    # Nothing lasts beside what grows: waiting for the slowest would be waiting past all numbers.
    slowest = growing if growing > 0.0 else float(np.abs(eigenvalues.real).min())
    slowest = max(slowest, _DECAY_TIME / (step * _MOST_STEPS))
    count = math.ceil(_DECAY_TIME / (slowest * step)) + 1
    return free_motion(model.state_matrix, start, step, count)[:, len(model.vehicle.units)]


def _extrema(values: FloatArray) -> FloatArray:
    """Values at the inner extrema, each by the parabola through the extreme sample and its neighbours."""
    slopes = np.diff(values)
    places = np.flatnonzero(slopes[:-1] * slopes[1:] < 0.0) + 1
    before, at, after = values[places - 1], values[places], values[places + 1]
    slope, curvature = 0.5 * (after - before), after - 2.0 * at + before
    found: FloatArray = at - 0.5 * slope**2 / curvature
    return found


def _longest_swing(extrema: FloatArray) -> FloatArray:
    """Longest run of extrema that lie on either side of zero by turns: the others ride on a slower motion."""
    turns = np.flatnonzero(extrema[:-1] * extrema[1:] >= 0.0) + 1
    return max(np.split(extrema, turns), key=len)
