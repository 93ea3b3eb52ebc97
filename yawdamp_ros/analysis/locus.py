"""Eigenvalues over one parameter of the vehicle."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from yawdamp_ros.analysis.boundaries import Boundary, find_boundaries
from yawdamp_ros.analysis.eigenmodes import ComplexArray, rightmost
from yawdamp_ros.dynamics import LinearModel
from yawdamp_ros.dynamics.kinematics import FloatArray


@dataclass(frozen=True)
class Locus:
    """Eigenvalues over the values of a parameter.

    Attributes
    ----------
    values : ndarray, shape (k,)
    eigenvalues : ndarray of complex, shape (k, 2 n)
        Eigenvalues of each value [1/s], by rising real, then imaginary part.
    boundaries : tuple of Boundary
        Values between the first and the last at which stability changes.

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> from yawdamp_ros.analysis import eigenvalue_locus
    >>> interlink = load_vehicle("interlink")
    >>> locus = eigenvalue_locus(lambda speed: linear_model(interlink, speed), [10.0, 20.0, 30.0])
    >>> locus.eigenvalues.shape, locus.boundaries
    ((3, 6), ())
    """

    values: FloatArray
    eigenvalues: ComplexArray
    boundaries: tuple[Boundary, ...]


def eigenvalue_locus(
    model_at: Callable[[float], LinearModel],
    values: Sequence[float],
    progress: Callable[[Sequence[float]], Iterable[float]] = iter,
) -> Locus:
    """Return eigenvalues over values of a parameter, and the boundaries of stability among them.

    Parameters
    ----------
    model_at : callable
        Model at a value of the parameter.
    values : sequence of float
        Rising or falling.
    progress : callable
        Wrapped around the values while they are worked on, as a progress bar is.

    Returns
    -------
    Locus

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> from yawdamp_ros.analysis import eigenvalue_locus
    >>> interlink = load_vehicle("interlink")
    >>> locus = eigenvalue_locus(lambda speed: linear_model(interlink, speed), [10.0, 20.0, 30.0])
    >>> locus.values.tolist()
    [10.0, 20.0, 30.0]
    """
    eigenvalues = np.array(
        [np.sort_complex(np.linalg.eigvals(model_at(value).state_matrix)) for value in progress(values)]
    )

    def eigenvalue(value: float) -> complex:
        return rightmost(model_at(value).state_matrix)

    # Sorted by real part, so that the last is the rightmost, with the positive imaginary part of a pair.
    scan = list(zip(values, map(complex, eigenvalues[:, -1]), strict=True))
    return Locus(np.array(values), eigenvalues, find_boundaries(eigenvalue, scan))
