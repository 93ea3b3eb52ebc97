"""Rearward amplification: swing of the last unit over that of the first."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from yawdamp_ros.analysis.answers import Answers, stack_of
from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.analysis.frequency_response import FrequencyResponse
from yawdamp_ros.dynamics import LinearModel
from yawdamp_ros.dynamics.kinematics import FloatArray

FREQUENCIES = np.concatenate([[0.0], np.geomspace(0.01, 4.0, 400)])
"""Frequencies of the search, from a steady turn to faster than any driver steers [Hz]."""


BoolArray = npt.NDArray[np.bool_]

_HALVINGS = 50
"""Bisections of a peak's bracket; they leave 1e-15 of its length."""


class PeakAmplification(NamedTuple):
    """Largest ratio of lateral accelerations, last unit over first, in steady sine steering.

    Attributes
    ----------
    gain : float
    frequency : float
        Frequency of that gain [Hz].

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> model = linear_model(load_vehicle("a_double"))
    >>> from yawdamp_ros.analysis import peak_amplification
    >>> round(float(peak_amplification(model).frequency), 2)
    0.36
    """

    gain: float
    frequency: float


def rearward_amplification(values: FloatArray) -> float:
    """Return the rearward amplification in time, after ISO 14791 and SAE J2179.

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

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> model = linear_model(load_vehicle("a_double"))
    >>> from yawdamp_ros.analysis import run_lane_change
    >>> response = run_lane_change(model)
    >>> from yawdamp_ros.analysis import rearward_amplification
    >>> round(float(rearward_amplification(response.lateral_acceleration)), 2)
    1.75
    """
    value = rearward_amplifications(values[np.newaxis]).only()
    return np.nan if value is None else value


def rearward_amplifications(values: FloatArray) -> Answers:
    """`rearward_amplification` of each of k vehicles, from values of shape (k, m, n)."""
    peaks = np.abs(values).max(axis=1)
    still = peaks[:, 0] == 0.0
    message = "rearward amplification: the first unit does not move"
    ratios = np.where(still, np.nan, peaks[:, -1] / np.where(still, 1.0, peaks[:, 0]))
    return Answers(ratios, dict.fromkeys(np.flatnonzero(still).tolist(), message))


def amplification_at(model: LinearModel, frequencies: FloatArray) -> FloatArray:
    """Return ``abs(G_ay,last / G_ay,first)`` in steady sine steering.

    Parameters
    ----------
    model : LinearModel
    frequencies : ndarray, shape (k,)
        Frequencies [Hz].

    Returns
    -------
    ndarray, shape (k,)

    Raises
    ------
    AnalysisError
        If a frequency is that of an undamped mode.

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> model = linear_model(load_vehicle("a_double"))
    >>> import numpy as np
    >>> from yawdamp_ros.analysis import amplification_at
    >>> amplification_at(model, np.array([0.1, 0.4])).round(2).tolist()
    [1.11, 2.2]
    """
    found = _ratios(_ends(stack_of(model)), np.asarray(frequencies)[:, np.newaxis])[:, 0]
    if not np.isfinite(found).all():
        message = f"{model.vehicle.name}: an undamped mode: there is no frequency response"
        raise AnalysisError(message)
    return found


def peak_amplification(model: LinearModel) -> PeakAmplification:
    """Return the rearward amplification by frequency of one vehicle; see `peak_amplifications`.

    Parameters
    ----------
    model : LinearModel

    Returns
    -------
    PeakAmplification

    Raises
    ------
    AnalysisError
        If the model is unstable, so that no steering leads to a steady sine.

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> model = linear_model(load_vehicle("a_double"))
    >>> from yawdamp_ros.analysis import peak_amplification
    >>> round(float(peak_amplification(model).gain), 2)
    2.33
    """
    gains, frequencies = peak_amplifications(stack_of(model))
    return PeakAmplification(gains.only() or 0.0, frequencies.only() or 0.0)


def peak_amplifications(model: LinearModel) -> tuple[Answers, Answers]:
    """Rearward amplification by frequency, after ISO 14791, of which only the catalogue page was readable.

    It is looked for at `FREQUENCIES`; between those beside the largest the place is found at which the slope
    is 0.

    Parameters
    ----------
    model : LinearModel
        Model of a stack of vehicles.

    Returns
    -------
    gains, frequencies : Answers
        Largest gain within `FREQUENCIES`, and its frequency [Hz]; at 0 Hz it is that of a steady turn,
        which is 1. None where the vehicle is unstable.
    """
    reasons = {
        index: f"{_name(model, index)}: no sine is ever steady"
        for index in np.flatnonzero(np.linalg.eigvals(model.state_matrix).real.max(axis=1) >= 0.0).tolist()
    }
    ends = _ends(model)
    scanned = _ratios(ends, FREQUENCIES[:, np.newaxis])
    best = np.argmax(scanned, axis=0)
    places = FREQUENCIES[best]
    low = np.maximum(FREQUENCIES[np.maximum(best - 1, 0)], 1e-3 * places)
    high = FREQUENCIES[np.minimum(best + 1, len(FREQUENCIES) - 1)]
    peaks = (best > 0) & _rises(ends, low) & ~_rises(ends, high)
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        rising = _rises(ends, middle)
        low, high = np.where(rising, middle, low), np.where(rising, high, middle)
    frequencies = np.where(peaks, 0.5 * (low + high), places)
    gains = np.where(peaks, _ratios(ends, frequencies), scanned.max(axis=0))
    for values in (gains, frequencies):
        values[list(reasons)] = np.nan
    return Answers(gains, reasons), Answers(frequencies, reasons)


def _ends(model: LinearModel) -> FrequencyResponse:
    """Lateral accelerations of the first and of the last unit."""
    units = len(model.vehicle.units)
    return FrequencyResponse.of(model, (2 * units, 3 * units - 1))


def _ratios(ends: FrequencyResponse, frequencies: FloatArray) -> FloatArray:
    """Last over first at frequencies [Hz], shape (..., k)."""
    shape = (*frequencies.shape[:-1], len(ends.inputs))
    s = np.asarray(2j * np.pi * np.broadcast_to(frequencies, shape), dtype=np.complex128)
    with np.errstate(divide="ignore", invalid="ignore"):  # a vehicle without a steady sine has a reason
        first, last = ends.gains(s)
        return np.asarray(np.abs(last / first), dtype=np.float64)


def _rises(ends: FrequencyResponse, frequencies: FloatArray) -> BoolArray:
    """True where the ratio rises with the frequency, shape (k,): ``d log abs G / d omega = -Im(G'/G)``."""
    s = np.asarray(2j * np.pi * frequencies, dtype=np.complex128)
    with np.errstate(divide="ignore", invalid="ignore"):
        first, last = ends.slopes(s) / ends.gains(s)
        return np.asarray(first.imag > last.imag)


def _name(model: LinearModel, index: int) -> str:
    speed = float(np.broadcast_to(model.speed, len(model.state_matrix))[index])
    return f"{model.vehicle.name}: unstable at {speed:.4g} m/s"
