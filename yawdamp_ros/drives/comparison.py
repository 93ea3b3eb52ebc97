"""Simulated against measured, channel by channel."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from yawdamp_ros.drives.channel import QUANTITIES, quantity_of
from yawdamp_ros.drives.drive import Drive
from yawdamp_ros.drives.errors import DriveError
from yawdamp_ros.drives.matching import Match
from yawdamp_ros.dynamics.kinematics import FloatArray

LONGEST_LAG = 1.0
"""Largest lag of a measurement [s]; a later one belongs to another drive."""
WINDOW = 10.24
"""Length of the segments of the spectra [s]: they resolve 0.1 Hz."""
BANDS = ((0.0, 0.25), (0.25, 0.5), (0.5, 1.0), (1.0, 2.0), (2.0, 5.0))
"""Frequencies of a table [Hz]."""
FEWEST_SAMPLES = 20
_POWER_SHARE = 0.95


@dataclass(frozen=True)
class ChannelComparison:
    """A measured channel beside its simulated twin.

    Attributes
    ----------
    output : str
        Name of the output, as in ``truck/yaw_rate``.
    unit : str
    times, measured, simulated : ndarray, shape (m,)
        Times of the measurement [s], and both signals there in SI units.
    bias : float
        Mean of measured less simulated.
    gain : float
        Slope of measured over simulated, both less their means, with the lag taken out.
    lag : float
        Time in s by which the measured signal follows the simulated one, where they correlate best.
    rms_error, rms_measured, rms_simulated : float
        Root mean square of measured minus simulated, and of each signal.
    r_squared : float
        Share of the measured variance that the simulation explains; NaN for a constant signal.
    noise : float
        Noise floor: standard deviation of changes from sample to sample that are too fast for a vehicle.
    attainable : float
        R2 that a perfect model would reach with that noise.
    frequencies, coherence : ndarray, shape (k,)
        Hz, and the share of the measured power there that is linear in the simulated signal.

    Examples
    --------
    >>> from yawdamp_ros import load_drive, load_vehicle
    >>> from yawdamp_ros.drives import compare, inputs_of, matches, predict
    >>> drive, vehicle = load_drive("docs/recorded_drive.csv").steered_by(18.0), load_vehicle("truck_trailer")
    >>> inputs = inputs_of(drive, vehicle.speed)
    >>> found, notes = matches(drive, vehicle.unit_names)
    >>> first = compare(found, inputs.times, predict(vehicle, inputs))[0]
    >>> first.output, round(first.r_squared, 2)
    ('trailer/yaw_rate', 0.75)
    """

    output: str
    unit: str
    times: FloatArray
    measured: FloatArray
    simulated: FloatArray
    bias: float
    gain: float
    lag: float
    rms_error: float
    rms_measured: float
    rms_simulated: float
    r_squared: float
    noise: float
    attainable: float
    frequencies: FloatArray
    coherence: FloatArray

    def in_band(self, low: float, high: float) -> float:
        """Mean coherence between two frequencies [Hz]; NaN without a measured one."""
        kept = (self.frequencies >= low) & (self.frequencies < high)
        return float(self.coherence[kept].mean()) if kept.any() else float("nan")


@dataclass(frozen=True)
class Excitation:
    """Excitation of a vehicle by a drive.

    Attributes
    ----------
    steering_rms : float
        Root mean square of the road-wheel angle about its mean [rad].
    steering_bandwidth : float
        Frequency in Hz below which 95 % of its power about the mean lies.
    lowest_speed, highest_speed : float
        Range of the speed [m/s].
    duration : float
        Duration [s].

    Examples
    --------
    >>> from yawdamp_ros import load_drive
    >>> drive = load_drive("docs/recorded_drive.csv").steered_by(18.0)
    >>> from yawdamp_ros.drives import excitation
    >>> round(excitation(drive, 20.0).duration, 1)
    94.5
    """

    steering_rms: float
    steering_bandwidth: float
    lowest_speed: float
    highest_speed: float
    duration: float


def compare_channel(match: Match, times: FloatArray, values: FloatArray) -> ChannelComparison:
    """Compare one measured channel with a simulated signal.

    Parameters
    ----------
    match : Match
    times, values : ndarray, shape (k,)
        Simulated signal: times [s], and values in the channel's unit.

    Raises
    ------
    DriveError
        If fewer than `FEWEST_SAMPLES` samples lie within the simulated time.
    """
    within = (match.channel.times >= times[0]) & (match.channel.times <= times[-1])
    at, measured = match.channel.times[within], match.channel.values[within]
    if len(at) < FEWEST_SAMPLES:
        message = f"{match.output}: {len(at)} samples while it was steered; expected {FEWEST_SAMPLES} or more"
        raise DriveError(message)
    simulated = np.interp(at, times, values)
    step = float(np.median(np.diff(at)))
    even = np.arange(at[0], at[-1], step) if step > 0.0 else at
    on_grid = np.interp(even, at, measured), np.interp(even, times, values)
    lag = _lag(*on_grid, step)
    shifted = np.interp(at - lag, times, values)
    error, variance = measured - simulated, float(measured.var())
    noise = _noise(measured)
    frequencies, coherent = _coherence(*on_grid, step)
    return ChannelComparison(
        output=match.output,
        unit=QUANTITIES[quantity_of(match.output)],
        times=at,
        measured=measured,
        simulated=simulated,
        bias=float(error.mean()),
        gain=_slope(shifted, measured),
        lag=lag,
        rms_error=_rms(error),
        rms_measured=_rms(measured),
        rms_simulated=_rms(simulated),
        r_squared=1.0 - float(np.mean(error**2)) / variance if variance else float("nan"),
        noise=noise,
        attainable=1.0 - min(noise**2 / variance, 1.0) if variance else float("nan"),
        frequencies=frequencies,
        coherence=coherent,
    )


def compare(
    matched: list[Match], times: FloatArray, outputs: Mapping[str, FloatArray]
) -> list[ChannelComparison]:
    """Compare every matched channel that has a simulated twin.

    Parameters
    ----------
    matched : list of Match
    times : ndarray, shape (k,)
        Times of the outputs [s].
    outputs : mapping of str to ndarray, shape (k,)

    Returns
    -------
    list of ChannelComparison

    Raises
    ------
    DriveError
        If nothing was measured that could be compared.

    Examples
    --------
    >>> from yawdamp_ros import load_drive, load_vehicle
    >>> from yawdamp_ros.drives import compare, inputs_of, matches, predict
    >>> drive, vehicle = load_drive("docs/recorded_drive.csv").steered_by(18.0), load_vehicle("truck_trailer")
    >>> inputs = inputs_of(drive, vehicle.speed)
    >>> found, notes = matches(drive, vehicle.unit_names)
    >>> compared = compare(found, inputs.times, predict(vehicle, inputs))
    >>> [(each.output, round(each.gain, 2)) for each in compared]
    [('trailer/yaw_rate', 1.0), ('truck/yaw_rate', 0.97), ('truck/lateral_acceleration', 0.96)]
    """
    found = [match for match in matched if match.output in outputs]
    if not found:
        message = f"nothing measured to compare with; expected one of {', '.join(outputs)}"
        raise DriveError(message)
    return [compare_channel(match, times, outputs[match.output]) for match in found]


def excitation(drive: Drive, speed: float) -> Excitation:
    """Return the excitation of a vehicle by a drive.

    Parameters
    ----------
    drive : Drive
    speed : float
        Speed of the vehicle where the drive has none [m/s].

    Returns
    -------
    Excitation

    Examples
    --------
    >>> from yawdamp_ros import load_drive
    >>> drive = load_drive("docs/recorded_drive.csv").steered_by(18.0)
    >>> from yawdamp_ros.drives import excitation
    >>> round(excitation(drive, 20.0).steering_bandwidth, 1)
    0.4
    """
    from scipy.signal import welch  # noqa: PLC0415 - it loads longer than most commands run

    steering = drive["steering"]
    times = np.arange(0.0, max(drive.duration, 0.02), 0.01)
    angles = steering.held(times)
    frequencies, power = welch(angles - angles.mean(), 100.0, nperseg=min(len(angles), 2048), detrend=False)
    total = np.cumsum(power)
    beyond = int(np.searchsorted(total, _POWER_SHARE * total[-1])) if total[-1] > 0.0 else 0
    followed = drive.speed(speed)
    speeds = np.array([speed]) if followed is None else followed.values
    return Excitation(
        float(angles.std()),
        float(frequencies[beyond]),
        float(speeds.min()),
        float(speeds.max()),
        drive.duration,
    )


def _rms(values: FloatArray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _slope(simulated: FloatArray, measured: FloatArray) -> float:
    about = simulated - simulated.mean()
    power = float(about @ about)
    return float(about @ (measured - measured.mean())) / power if power else float("nan")


def _noise(values: FloatArray) -> float:
    # A slow signal has nearly no third difference; that of white noise has 20 times its variance.
    differences = np.diff(values, n=3)
    return float(np.sqrt(np.mean(differences**2) / 20.0)) if len(differences) else 0.0


def _lag(measured: FloatArray, simulated: FloatArray, step: float) -> float:
    about = measured - measured.mean(), simulated - simulated.mean()
    if step <= 0.0 or not (about[0].any() and about[1].any()):
        return float("nan")
    from scipy.signal import correlate  # noqa: PLC0415 - it loads longer than most commands run

    correlation = correlate(*about, method="fft")
    middle = len(simulated) - 1
    reach = min(max(round(LONGEST_LAG / step), 1), middle - 1)
    near = correlation[middle - reach - 1 : middle + reach + 2]
    best = min(max(int(np.argmax(near)), 1), len(near) - 2)
    before, peak, after = near[best - 1 : best + 2]
    curvature = before - 2.0 * peak + after
    vertex = 0.5 * (before - after) / curvature if curvature else 0.0
    return float(best + vertex - reach - 1) * step


def _coherence(measured: FloatArray, simulated: FloatArray, step: float) -> tuple[FloatArray, FloatArray]:
    length = min(round(WINDOW / step), len(measured) // 4) if step > 0.0 else 0
    if length < FEWEST_SAMPLES or not (np.ptp(measured) and np.ptp(simulated)):
        return np.zeros(0), np.zeros(0)
    from scipy.signal import coherence  # noqa: PLC0415 - it loads longer than most commands run

    frequencies, coherent = coherence(simulated, measured, 1.0 / step, nperseg=length)
    return np.asarray(frequencies), np.asarray(coherent)
