"""Outputs of a stack of vehicles in steady sine steering, at many frequencies at once."""

from dataclasses import dataclass

import numpy as np

from yawdamp_ros.analysis.eigenmodes import ComplexArray
from yawdamp_ros.dynamics import LinearModel
from yawdamp_ros.dynamics.kinematics import FloatArray


@dataclass(frozen=True)
class FrequencyResponse:
    """``G(s) = C (s I - A)^-1 B + D`` with A turned into a triangle, for k vehicles and q outputs.

    The turn is unitary, so that nothing is lost; then each frequency takes a substitution only.

    Attributes
    ----------
    triangle : ndarray of complex, shape (k, m, m)
    inputs : ndarray of complex, shape (k, m)
    rows : ndarray of complex, shape (k, q, m)
    through : ndarray, shape (k, q)
    """

    triangle: ComplexArray
    inputs: ComplexArray
    rows: ComplexArray
    through: FloatArray

    @classmethod
    def of(cls, model: LinearModel, outputs: tuple[int, ...]) -> "FrequencyResponse":
        """Response of some outputs, by index, to the road-wheel steer angle.

        Parameters
        ----------
        model : LinearModel
            Model of a stack of vehicles.
        outputs : tuple of int
        """
        from scipy.linalg import schur  # noqa: PLC0415 - what asks for no gain does not wait for it

        triangles = np.empty(model.state_matrix.shape, dtype=np.complex128)
        turns = np.empty_like(triangles)
        for index, matrix in enumerate(model.state_matrix):
            triangles[index], turns[index] = schur(matrix, output="complex", check_finite=False)
        inputs = (turns.conj().transpose(0, 2, 1) @ model.input_matrix[..., np.newaxis])[..., 0]
        rows = model.output_matrix[:, list(outputs)] @ turns
        return cls(triangles, inputs, rows, model.feedthrough[:, list(outputs)])

    def gains(self, s: ComplexArray) -> ComplexArray:
        """G at complex frequencies in 1/s of shape (..., k), shape (q, ..., k)."""
        states = self._solved(s, list(self.inputs.T))
        return self._seen(states) + self.through.T.reshape(-1, *[1] * (s.ndim - 1), s.shape[-1])

    def slopes(self, s: ComplexArray) -> ComplexArray:
        """``dG/ds`` at complex frequencies in 1/s of shape (..., k), shape (q, ..., k)."""
        return -self._seen(self._solved(s, self._solved(s, list(self.inputs.T))))

    def _solved(self, s: ComplexArray, right: list[ComplexArray]) -> list[ComplexArray]:
        """Components of ``(s I - triangle)^-1 right``, from the last on."""
        size = len(right)
        found: list[ComplexArray] = [right[0]] * size
        for row in range(size - 1, -1, -1):
            rest = right[row]
            for column in range(row + 1, size):
                rest = rest + self.triangle[:, row, column] * found[column]
            found[row] = np.asarray(rest / (s - self.triangle[:, row, row]))
        return found

    def _seen(self, states: list[ComplexArray]) -> ComplexArray:
        rows = self.rows.transpose(1, 2, 0)
        return np.stack(
            [sum(share * state for share, state in zip(row, states, strict=True)) for row in rows]
        )
