"""Transfer functions from the steer angle to an output."""

from dataclasses import dataclass

import numpy as np

from yawdamp_ros.analysis.eigenmodes import ComplexArray
from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.dynamics import LinearModel
from yawdamp_ros.dynamics.kinematics import FloatArray

_INFINITE = 1e6
"""Zeros this many times faster than the fastest pole are the infinite ones of a strictly proper output."""


@dataclass(frozen=True)
class TransferFunction:
    """``G(s) = C (s I - A)^-1 B + D`` of one output.

    Attributes
    ----------
    output : str
        Name of the output.
    state_matrix : ndarray, shape (m, m)
    input_matrix : ndarray, shape (m,)
    output_row : ndarray, shape (m,)
    feedthrough : float

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> model = linear_model(load_vehicle("a_double"))
    >>> from yawdamp_ros.analysis import transfer_function
    >>> round(abs(transfer_function(model, "tractor/yaw_rate")(2j)), 2)
    5.44
    """

    output: str
    state_matrix: FloatArray
    input_matrix: FloatArray
    output_row: FloatArray
    feedthrough: float

    @property
    def poles(self) -> ComplexArray:
        """Eigenvalues of the state matrix [1/s], shape (m,)."""
        return np.sort_complex(np.asarray(np.linalg.eigvals(self.state_matrix), dtype=np.complex128))

    @property
    def zeros(self) -> ComplexArray:
        """Finite zeros [1/s], shape (m,) with feed-through and fewer without.

        They are the finite generalised eigenvalues of the Rosenbrock matrix [[A, B], [C, D]].
        """
        from scipy.linalg import eigvals  # noqa: PLC0415 - the rest does without

        size = len(self.state_matrix)
        rosenbrock = np.block(
            [
                [self.state_matrix, self.input_matrix[:, np.newaxis]],
                [self.output_row[np.newaxis], np.array([[self.feedthrough]])],
            ]
        )
        finite, infinite = eigvals(rosenbrock, np.diag([*[1.0] * size, 0.0]), homogeneous_eigvals=True)
        fastest = float(np.abs(self.poles).max())
        kept = np.abs(finite) < _INFINITE * fastest * np.abs(infinite)
        return np.sort_complex(finite[kept] / infinite[kept])

    @property
    def static_gain(self) -> float:
        """``G(0)``, in the output's unit per rad.

        Raises
        ------
        AnalysisError
            If there is a pole at the origin.
        """
        return float(self(0j).real)

    def __call__(self, s: complex) -> complex:
        """Value at a complex frequency [1/s].

        Raises
        ------
        AnalysisError
            If s is a pole.
        """
        try:
            state = np.linalg.solve(s * np.eye(len(self.state_matrix)) - self.state_matrix, self.input_matrix)
        except np.linalg.LinAlgError as error:
            message = f"{self.output}: {s} is a pole: there is no gain"
            raise AnalysisError(message) from error
        return complex(self.output_row @ state + self.feedthrough)


def transfer_function(model: LinearModel, output: str) -> TransferFunction:
    """Return the transfer function from the road-wheel steer angle to an output.

    Parameters
    ----------
    model : LinearModel
    output : str
        One of the model's `output_names`.

    Returns
    -------
    TransferFunction

    Raises
    ------
    AnalysisError
        If there is no such output.

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> model = linear_model(load_vehicle("a_double"))
    >>> from yawdamp_ros.analysis import transfer_function
    >>> transfer_function(model, "tractor/yaw_rate").output
    'tractor/yaw_rate'
    """
    if output not in model.output_names:
        message = f"output: {output!r}: expected one of {', '.join(model.output_names)}"
        raise AnalysisError(message)
    index = model.output_names.index(output)
    return TransferFunction(
        output=output,
        state_matrix=model.state_matrix,
        input_matrix=model.input_matrix,
        output_row=model.output_matrix[index],
        feedthrough=float(model.feedthrough[index]),
    )
