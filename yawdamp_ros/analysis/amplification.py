"""Rearward amplification: how much harder than the first unit the last one swings."""

from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize_scalar

from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.dynamics import LinearModel
from yawdamp_ros.dynamics.kinematics import FloatArray

FREQUENCIES = np.concatenate([[0.0], np.geomspace(0.01, 4.0, 400)])
"""Searched for the largest amplification, in Hz: from a steady turn to faster than any driver steers."""


class PeakAmplification(NamedTuple):
    """Largest ratio of lateral accelerations, last unit over first, in steady sine steering.

    Attributes
    ----------
    gain : float
    frequency : float
        Where it is reached, in Hz.
    """

    gain: float
    frequency: float


def rearward_amplification(values: FloatArray) -> float:
    """Rearward amplification in time, after ISO 14791 and SAE J2179.

    The largest magnitude at the last unit over the largest at the first. Of the standards only catalogue
    pages and secondary sources were readable. SAE J2179 is said to take the front axle for the first unit;
    here every unit is taken at its centre of gravity.

    Parameters
    ----------
    values : ndarray, shape (m, n)
        Lateral acceleration in m/s^2 or, for the yaw-rate form, yaw rate in rad/s of n units.

    Returns
    -------
    float

    Raises
    ------
    AnalysisError
        If the first unit does not move.
    """
    peaks = np.abs(values).max(axis=0)
    if not peaks[0]:
        message = "rearward amplification: the first unit does not move"
        raise AnalysisError(message)
    return float(peaks[-1] / peaks[0])


def amplification_at(model: LinearModel, frequencies: FloatArray) -> FloatArray:
    """``abs(G_ay,last / G_ay,first)`` in steady sine steering.

    Parameters
    ----------
    model : LinearModel
    frequencies : ndarray, shape (k,)
        In Hz.

    Returns
    -------
    ndarray, shape (k,)

    Raises
    ------
    AnalysisError
        If a frequency is that of an undamped mode.
    """
    units = len(model.vehicle.units)
    s = 2j * np.pi * np.asarray(frequencies)[:, np.newaxis, np.newaxis]
    try:
        # NumPy 1 does not broadcast the right-hand side of stacked systems.
        inputs = np.broadcast_to(model.input_matrix[:, np.newaxis], (len(s), 2 * units, 1))
        states = np.linalg.solve(s * np.eye(2 * units) - model.state_matrix, inputs)
    except np.linalg.LinAlgError as error:
        message = f"{model.vehicle.name}: an undamped mode: there is no frequency response"
        raise AnalysisError(message) from error
    ends = [2 * units, 3 * units - 1]
    first, last = (states[..., 0] @ model.output_matrix[ends].T + model.feedthrough[ends]).T
    return np.asarray(np.abs(last / first), dtype=np.float64)


def peak_amplification(model: LinearModel) -> PeakAmplification:
    """Rearward amplification by frequency, after ISO 14791, of which only the catalogue page was readable.

    Parameters
    ----------
    model : LinearModel

    Returns
    -------
    PeakAmplification
        The largest within `FREQUENCIES`, refined between them; at 0 Hz it is that of a steady turn, which
        is 1.

    Raises
    ------
    AnalysisError
        If the model is unstable, so that no steering leads to a steady sine.
    """
    if np.linalg.eigvals(model.state_matrix).real.max() >= 0.0:
        message = f"{model.vehicle.name}: unstable at {model.speed:.4g} m/s: no sine is ever steady"
        raise AnalysisError(message)
    gains = amplification_at(model, FREQUENCIES)
    best = int(np.argmax(gains))
    bounds = FREQUENCIES[max(best - 1, 0)], FREQUENCIES[min(best + 1, len(FREQUENCIES) - 1)]
    refined = minimize_scalar(
        lambda frequency: -amplification_at(model, np.array([frequency]))[0],
        bounds=bounds,
        method="bounded",
        options={"xatol": 1e-9},
    )
    # A bounded search never quite reaches its bounds; and where all is rounding, the scan's place stands.
    if -refined.fun > gains[best] * (1.0 + 1e-12):
        return PeakAmplification(float(-refined.fun), float(refined.x))
    return PeakAmplification(float(gains[best]), float(FREQUENCIES[best]))
