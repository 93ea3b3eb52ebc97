"""Yaw damping: how fast dies out what swings in the free decay after a pulse of steering."""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from yawdamp_ros.analysis.answers import Answers, stack_of
from yawdamp_ros.analysis.eigenmodes import ComplexArray, damping_ratios
from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.analysis.motion import free_motion, stacked_exponential
from yawdamp_ros.dynamics import LinearModel
from yawdamp_ros.dynamics.kinematics import FloatArray

BoolArray = npt.NDArray[np.bool_]

PULSE_WIDTH = 0.5
"""Width of the steering pulse [s], as in the manoeuvre `pulse`."""

EXCITED = 0.02
"""Share of the largest swing above which a mode counts as excited. No accessible standard gives one."""

FAINT = 0.001
"""Share of the largest swing above which a mode with less damping than the excited ones is reported."""

_SMALLEST = 1e-9
"""Share of the largest extremum below which extrema are ignored: the rounding of 1 is 1e-16."""

_RESOLVED = 1e-6
"""Share of the whole decay above which a swing counts as real and not as rounding."""

_LARGEST_EXPONENT = 300.0
"""Largest exponent of a growth over the pulse; a greater one would overflow."""

_STEPS_PER_RADIAN = 100.0
_DECAY_TIME = -math.log(_SMALLEST)
_MOST_STEPS = 200_000


class ModesOfDecay(NamedTuple):
    """Free decay as a sum of modes, ``sum_j residues_j exp(eigenvalues_j t)``.

    Attributes
    ----------
    eigenvalues : ndarray of complex, shape (k, m)
        Eigenvalues of each of k vehicles [1/s].
    residues : ndarray of complex, shape (k, n, m)
        Residues of n signals at the end of a pulse of 1 rad: the last unit's yaw rate [rad/s], then the
        articulation angles [rad].
    """

    eigenvalues: ComplexArray
    residues: ComplexArray

    @property
    def damping_ratios(self) -> FloatArray:
        """``-Re / abs`` of the eigenvalues, shape (k, m)."""
        return damping_ratios(self.eigenvalues)

    @property
    def swinging(self) -> BoolArray:
        """True for each mode that swings, shape (k, m): the first of a pair whose next peak is resolved.

        A critically damped pair, or one close to it, has its second peak of the same sign below rounding.
        """
        positive = self.eigenvalues.imag > 0.0
        frequency = np.where(positive, self.eigenvalues.imag, 1.0)
        return np.asarray(positive & (math.tau * self.eigenvalues.real > -_DECAY_TIME * frequency))

    @property
    def swings(self) -> FloatArray:
        """Size of the swings of each mode in each signal, shape (k, n, m); 0 where a mode does not swing.

        It is the amplitude half a period after the pulse, about the first extremum on the other side: a mode
        of heavy damping begins large and never comes back.
        """
        frequency = np.where(self.swinging, self.eigenvalues.imag, 1.0)
        half_period = np.exp(np.minimum(math.pi * self.eigenvalues.real / frequency, 0.5 * _DECAY_TIME))
        return np.asarray(np.abs(self.residues) * (half_period * self.swinging)[:, np.newaxis])


def modes_of_decay(model: LinearModel) -> ModesOfDecay:
    """Modes of the free decay after a pulse of steering, found without samples or peaks.

    Parameters
    ----------
    model : LinearModel
        Model of a stack of k vehicles.

    Returns
    -------
    ModesOfDecay
    """
    eigenvalues, shapes = (np.asarray(part, np.complex128) for part in np.linalg.eig(model.state_matrix))
    # The state at the end of the pulse is the integral of exp(A t) B over it.
    over_pulse = np.minimum(eigenvalues.real * PULSE_WIDTH, _LARGEST_EXPONENT)
    over_pulse = over_pulse + 1j * eigenvalues.imag * PULSE_WIDTH
    still = eigenvalues == 0.0
    held = np.where(still, PULSE_WIDTH, np.expm1(over_pulse) / np.where(still, 1.0, eigenvalues))
    amplitudes = held * _solved(shapes, model.input_matrix)
    units = len(model.vehicle.units)
    signals = shapes[:, units:]  # the last yaw rate, and all articulation angles
    return ModesOfDecay(eigenvalues, signals * amplitudes[:, np.newaxis])


def yaw_dampings(model: LinearModel) -> Answers:
    """Yaw damping coefficient of the Australian PBS scheme for a stack of vehicles.

    The scheme takes it from the mean ratio of successive peaks of the same sign, see `damping_of_peaks`. That
    ratio gives the damping if one mode swings alone. Here the decay is split into its modes, and modes that
    do not swing are left out. The coefficient is the lowest damping ratio of the modes that are excited in
    the last unit's yaw rate: their swings are at least `EXCITED` of the largest. If one mode swings alone,
    both agree.

    If several modes are excited, the peaks mix them and the measure is ambiguous: the span reaches up to the
    highest damping ratio of an excited mode. It also reaches down to a mode that is faint in the yaw rate
    (`FAINT`), or excited in an articulation angle alone.

    Parameters
    ----------
    model : LinearModel
        Model of a stack of vehicles.

    Returns
    -------
    Answers
        Damping coefficients; negative if a swing grows, -1 if the motion grows without swinging.
    """
    decay = modes_of_decay(model)
    ratios, swings = decay.damping_ratios, decay.swings
    sizes = np.abs(decay.residues)
    resolved = swings > _RESOLVED * sizes.sum(axis=2, keepdims=True)
    shares = np.where(resolved, swings, 0.0)
    largest = shares.max(axis=2, keepdims=True)
    shares /= np.where(largest > 0.0, largest, 1.0)
    excited = shares[:, 0] >= EXCITED
    told = excited | (shares[:, 0] >= FAINT) | (shares >= EXCITED).any(axis=1)
    counted = np.where(excited.any(axis=1, keepdims=True), excited, told)
    values = _least(ratios, counted)
    spans = np.column_stack([_least(ratios, told), -_least(-ratios, counted)])
    grows = (decay.eigenvalues.imag == 0.0) & (decay.eigenvalues.real > 0.0)
    grows &= sizes[:, 0] > _RESOLVED * sizes[:, 0].max(axis=1, keepdims=True)
    values[grows.any(axis=1)] = spans[grows.any(axis=1)] = -1.0
    message = "yaw damping coefficient: the motion does not swing: expected two peaks of the same sign"
    return Answers(values, dict.fromkeys(np.flatnonzero(np.isnan(values)).tolist(), message), spans)


def yaw_damping_coefficient(model: LinearModel) -> float:
    """Yaw damping coefficient of one vehicle, see `yaw_dampings`.

    Parameters
    ----------
    model : LinearModel

    Returns
    -------
    float

    Raises
    ------
    AnalysisError
        If the motion does not swing.

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> round(yaw_damping_coefficient(linear_model(load_vehicle("a_double"))), 3)
    0.372
    """
    value = yaw_dampings(stack_of(model)).only()
    return math.nan if value is None else value


def damping_of_peaks(values: FloatArray) -> float:
    """Return the damping by the definition of the Australian PBS scheme, from the peaks of a decay.

    ``D = ln r / sqrt(4 pi^2 + ln^2 r)`` where r is the mean ratio of successive peaks **of the same sign**,
    those above zero and those below it taken alike. A ratio of successive peaks of either sign spans half a
    cycle and would have to go with pi^2. The formula was read in secondary sources, not in the standard. It
    tells the damping of a mode that swings alone; of a decay that holds more, `yaw_dampings` does.

    Parameters
    ----------
    values : ndarray, shape (m,)
        Yaw rate of the last unit, or an articulation angle, evenly sampled after the steering has returned
        to zero. Peaks are interpolated by a parabola through three samples.

    Returns
    -------
    float
        Positive where the motion decays; of a single mode it is the damping ratio.

    Raises
    ------
    AnalysisError
        If there are no two peaks of the same sign: the motion does not swing.

    Examples
    --------
    >>> import numpy as np
    >>> from yawdamp_ros.analysis import damping_of_peaks
    >>> time = np.linspace(0.0, 10.0, 2001)
    >>> round(float(damping_of_peaks(np.exp(-0.2 * time) * np.sin(2.0 * time))), 2)
    0.1
    """
    extrema = _extrema(values)
    extrema = _longest_swing(extrema[np.abs(extrema) > _SMALLEST * np.abs(values).max()])
    ratios = extrema[:-2] / extrema[2:]
    if not len(ratios):
        message = "yaw damping coefficient: the motion does not swing: expected two peaks of the same sign"
        raise AnalysisError(message)
    decrement = math.log(ratios.mean())
    return decrement / math.hypot(math.tau, decrement)


def pulse_decay(model: LinearModel) -> FloatArray:
    """Return the yaw rate of the last unit after a pulse of steering has ended.

    Parameters
    ----------
    model : LinearModel

    Returns
    -------
    ndarray, shape (m,)
        Yaw rate [rad/s] after a pulse of 1 rad over `PULSE_WIDTH`; the damping does not depend on it.
        Samples are even until the slowest mode has decayed or, if unstable, the fastest has grown as far.

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> model = linear_model(load_vehicle("a_double"))
    >>> from yawdamp_ros.analysis import pulse_decay
    >>> pulse_decay(model).ndim
    1
    """
    size = len(model.state_matrix)
    held = np.zeros((size + 1, size + 1))
    held[:size, :size] = model.state_matrix
    held[:size, -1] = model.input_matrix
    start = stacked_exponential(PULSE_WIDTH * held[np.newaxis])[0, :size, -1]
    eigenvalues = np.linalg.eigvals(model.state_matrix)
    step = 1.0 / (_STEPS_PER_RADIAN * float(np.abs(eigenvalues).max()))
    growing = float(eigenvalues.real.max())
    # A growing mode dominates in the end: waiting for the slowest decay would overflow.
    slowest = growing if growing > 0.0 else float(np.abs(eigenvalues.real).min())
    slowest = max(slowest, _DECAY_TIME / (step * _MOST_STEPS))
    count = math.ceil(_DECAY_TIME / (slowest * step)) + 1
    last_yaw_rate = np.eye(size)[len(model.vehicle.units)]
    rows = last_yaw_rate[np.newaxis, np.newaxis]
    shown: FloatArray = free_motion(model.state_matrix[np.newaxis], start[np.newaxis], step, count, rows)[
        0, 0
    ]
    return shown


def _extrema(values: FloatArray) -> FloatArray:
    """Values at the inner extrema, each by the parabola through the extreme sample and its neighbours."""
    slopes = np.diff(values)
    places = np.flatnonzero(slopes[:-1] * slopes[1:] < 0.0) + 1
    before, at, after = values[places - 1], values[places], values[places + 1]
    slope, curvature = 0.5 * (after - before), after - 2.0 * at + before
    found: FloatArray = at - 0.5 * slope**2 / curvature
    return found


def _least(ratios: FloatArray, chosen: BoolArray) -> FloatArray:
    """Lowest chosen value of each of k vehicles; NaN without one."""
    found = np.where(chosen, ratios, np.inf).min(axis=1)
    return np.where(np.isinf(found), np.nan, found)


def _solved(shapes: ComplexArray, vectors: FloatArray) -> ComplexArray:
    """Amplitudes of the modes that add up to a vector, of each of k vehicles."""
    singular = np.linalg.det(shapes) == 0.0
    # Two modes of one shape: their sum is the same, whichever of them takes the share.
    regular = np.where(singular[:, np.newaxis, np.newaxis], np.eye(shapes.shape[-1]), shapes)
    found = np.linalg.solve(regular, vectors[..., np.newaxis].astype(np.complex128))[..., 0]
    for index in np.flatnonzero(singular):
        found[index] = np.linalg.pinv(shapes[index]) @ vectors[index]
    return np.asarray(found, dtype=np.complex128)


def _longest_swing(extrema: FloatArray) -> FloatArray:
    """Longest run of extrema that lie on either side of zero by turns: the others ride on a slower motion."""
    turns = np.flatnonzero(extrema[:-1] * extrema[1:] >= 0.0) + 1
    return max(np.split(extrema, turns), key=len)
