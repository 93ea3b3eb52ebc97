"""The modes of a linear model: frequency, damping and moving units."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from yawdamp_ros.analysis.answers import Answers, stack_of
from yawdamp_ros.dynamics import LinearModel
from yawdamp_ros.dynamics.kinematics import FloatArray

ComplexArray = npt.NDArray[np.complex128]

MOVING = 0.5
"""Share of the largest yaw rate above which a unit counts as moving in a mode."""


@dataclass(frozen=True)
class Mode:
    """One eigenvalue of a state matrix, with its eigenvector as yaw rates.

    Attributes
    ----------
    eigenvalue : complex
        Eigenvalue [1/s].
    yaw_rates : ndarray of complex, shape (n,)
        Yaw rate of every unit in the mode, scaled so that the largest is 1; an argument is a phase lead.
    moving_units : tuple of str
        Units whose yaw rate is at least half the largest.

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> model = linear_model(load_vehicle("a_double"))
    >>> from yawdamp_ros.analysis import modes
    >>> mode = modes(model)[0]
    >>> mode.moving_units, round(mode.damping_ratio, 3)
    (('semitrailer_2',), 0.372)
    """

    eigenvalue: complex
    yaw_rates: ComplexArray
    moving_units: tuple[str, ...]

    @property
    def undamped_frequency(self) -> float:
        """``abs(lambda)`` in rad/s."""
        return abs(self.eigenvalue)

    @property
    def damped_frequency(self) -> float:
        """``abs(Im lambda)`` in rad/s."""
        return abs(self.eigenvalue.imag)

    @property
    def damping_ratio(self) -> float:
        """``-Re(lambda) / abs(lambda)``: 1 for a decaying real mode, -1 for a growing one."""
        return float(damping_ratios(np.asarray(self.eigenvalue, dtype=np.complex128)))


def modes(model: LinearModel) -> tuple[Mode, ...]:
    """Return the modes of a model, one for every eigenvalue.

    Parameters
    ----------
    model : LinearModel

    Returns
    -------
    tuple of Mode
        Lightest damping first, then fastest first; of a conjugate pair the positive frequency first. It
        is the order of Table 6 of Frerichs (2012).

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> model = linear_model(load_vehicle("a_double"))
    >>> from yawdamp_ros.analysis import modes
    >>> [round(mode.damping_ratio, 2) for mode in modes(model)][::2]
    [0.37, 0.39, 0.44, 1.0]
    """
    eigenvalues, eigenvectors = np.linalg.eig(model.state_matrix)
    rates = eigenvectors[1 : len(model.vehicle.units) + 1].T
    found = [_mode(model, complex(value), shape) for value, shape in zip(eigenvalues, rates, strict=True)]
    return tuple(sorted(found, key=lambda m: (m.damping_ratio, -m.undamped_frequency, -m.eigenvalue.imag)))


def least_damping_ratio(model: LinearModel) -> float:
    """Return the damping ratio of the lightest damped mode.

    Parameters
    ----------
    model : LinearModel

    Returns
    -------
    float

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> model = linear_model(load_vehicle("a_double"))
    >>> from yawdamp_ros.analysis import least_damping_ratio
    >>> round(least_damping_ratio(model), 3)
    0.372
    """
    return float(least_damping_ratios(stack_of(model)).values[0])


def least_damping_ratios(model: LinearModel) -> Answers:
    """Damping ratio of the lightest damped mode of each of a stack of vehicles."""
    eigenvalues = np.asarray(np.linalg.eigvals(model.state_matrix), dtype=np.complex128)
    return Answers(damping_ratios(eigenvalues).min(axis=1))


def damping_ratios(eigenvalues: ComplexArray) -> FloatArray:
    """``-Re(lambda) / abs(lambda)`` of eigenvalues in 1/s, 0 at the origin."""
    sizes = np.abs(eigenvalues)
    return np.asarray(-eigenvalues.real / np.where(sizes > 0.0, sizes, 1.0), dtype=np.float64)


def growth(model: LinearModel) -> str:
    """Return a warning of the fastest growing mode; empty if the vehicle is stable.

    Parameters
    ----------
    model : LinearModel

    Returns
    -------
    str

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> from yawdamp_ros.analysis import growth
    >>> growth(linear_model(load_vehicle("interlink")))
    ''
    """
    mode = max(modes(model), key=lambda mode: mode.eigenvalue.real)
    rate = mode.eigenvalue.real
    if rate <= 0.0:
        return ""
    frequency = mode.damped_frequency / (2.0 * np.pi)
    kind = f"an oscillation of {frequency:.3g} Hz" if frequency else "a motion without oscillation"
    return (
        f"{model.vehicle.name} is unstable at {model.speed:g} m/s: {kind} of {', '.join(mode.moving_units)} "
        f"doubles every {np.log(2.0) / rate:.3g} s"
    )


def rightmost(state_matrix: FloatArray) -> complex:
    """Return the eigenvalue with the largest real part; of a pair the one with positive imaginary part.

    Parameters
    ----------
    state_matrix : ndarray, shape (m, m)

    Returns
    -------
    complex
        In 1/s.

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> model = linear_model(load_vehicle("a_double"))
    >>> from yawdamp_ros.analysis import rightmost
    >>> round(rightmost(model.state_matrix).real, 3)
    -0.852
    """
    eigenvalues = np.linalg.eigvals(state_matrix)
    value = complex(eigenvalues[np.argmax(eigenvalues.real)])
    return complex(value.real, abs(value.imag))


def _mode(model: LinearModel, eigenvalue: complex, shape: ComplexArray) -> Mode:
    largest = shape[np.argmax(np.abs(shape))]
    yaw_rates = np.asarray(shape / largest if largest else shape, dtype=np.complex128)
    moving = tuple(
        name for name, rate in zip(model.vehicle.unit_names, yaw_rates, strict=True) if abs(rate) >= MOVING
    )
    return Mode(eigenvalue, yaw_rates, moving)
