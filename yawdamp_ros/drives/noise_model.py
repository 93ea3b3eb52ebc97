"""Residuals as a vector autoregression: they are rarely white, and their channels are coupled."""

from typing import NamedTuple

import numpy as np

from yawdamp_ros.dynamics.kinematics import FloatArray

ORDERS = (0, 1, 2, 3, 5, 8, 13, 21, 34, 55)
"""Candidate orders of the autoregression; Akaike's criterion and `GENEROSITY` select one."""
GENEROSITY = 2.5
"""Factor on the order that predicts best: slow noise matters to parameters and needs a high order."""


class NoiseModel(NamedTuple):
    """``r_t = sum_i coefficients[i] r_(t-1-i) + e_t`` with white e of covariance ``factor factor'``.

    Attributes
    ----------
    coefficients : ndarray, shape (p, m, m)
    factor : ndarray, shape (m, m)
        Lower triangular.
    freedom : float
        Degrees of freedom of the spectrum at zero frequency, below which a vehicle's motion lies.
    """

    coefficients: FloatArray
    factor: FloatArray
    freedom: float

    @property
    def order(self) -> int:
        """Number of coefficients."""
        return len(self.coefficients)

    def uncertainty(self, count: int) -> float:
        """Factor of a variance for the noise being estimated from as many samples, not known.

        With a covariance of m channels estimated by v degrees of freedom the variance of a generalised mean
        is ``v (v - 1) / ((v - m + 1) (v - m))`` times what that covariance says (Rao 1967), and with the
        weights of independent groups estimated by v each it is up to ``1 + 4 / v`` times (Meier 1953). The
        innovations are too small by the number of coefficients.

        Parameters
        ----------
        count : int

        Returns
        -------
        float
            1 or more.

        Examples
        --------
        >>> import numpy as np
        >>> NoiseModel(np.zeros((21, 6, 6)), np.eye(6), freedom=70.0).uncertainty(7600) > 1.15
        True
        """
        size = len(self.factor)
        freedom = max(self.freedom, size + 1.0)
        of_spectrum = freedom * (freedom - 1.0) / ((freedom - size + 1.0) * (freedom - size))
        of_weights = 1.0 + 4.0 / freedom
        return of_spectrum * of_weights * count / (count - self.order * size)

    def whitened(self, residuals: FloatArray) -> FloatArray:
        """Innovations, of unit variance, of residuals of shape (k, m, ...); the first `order` are left out.

        Returns
        -------
        ndarray, shape (k - p, m, ...)
        """
        from scipy.linalg import solve_triangular  # noqa: PLC0415 - it loads longer than most commands run

        count, size, *others = residuals.shape
        order, columns = self.order, int(np.prod(others, dtype=int))
        # One row a channel, so that a lag is a shift of columns, and each product a large one.
        rows = np.moveaxis(residuals, 1, 0).reshape(size, count * columns)
        innovations = rows[:, order * columns :].copy()
        for index, coefficients in enumerate(self.coefficients):
            innovations -= (
                coefficients @ rows[:, (order - 1 - index) * columns : (count - 1 - index) * columns]
            )
        white = solve_triangular(self.factor, innovations, lower=True)
        return np.ascontiguousarray(np.moveaxis(white.reshape(size, count - order, *others), 0, 1))


def independent(residuals: FloatArray) -> NoiseModel:
    """White noise, each channel its own, of the size of residuals of shape (k, m)."""
    sizes = np.sqrt(np.mean(residuals**2, axis=0))
    factor = np.diag(np.where(sizes > 0.0, sizes, 1.0))
    return NoiseModel(np.zeros((0, len(sizes), len(sizes))), factor, float(len(residuals)))


def fitted(residuals: FloatArray) -> NoiseModel:
    """Autoregression of residuals of shape (k, m) by the Yule-Walker equations."""
    count, size = residuals.shape
    orders = [order for order in ORDERS if (order * size + 1) * 10 < count]
    lags = max(orders, default=0)
    covariances: list[FloatArray] = [
        residuals[lag:].T @ residuals[: count - lag] / count for lag in range(lags + 1)
    ]
    # A constant series has no noise: a small value keeps the equations regular.
    covariances[0] = covariances[0] + 1e-12 * np.eye(size) * max(float(np.trace(covariances[0])), 1e-300)
    models = [_yule_walker(covariances, order, count) for order in orders]
    criteria = [
        2.0 * count * float(np.log(np.diag(model.factor)).sum()) + 2.0 * model.order * size**2
        for model in models
    ]
    enough = GENEROSITY * models[int(np.argmin(criteria))].order
    return next((model for model in models if model.order >= enough), models[-1])


def _yule_walker(covariances: list[FloatArray], order: int, count: int) -> NoiseModel:
    size = len(covariances[0])

    def at(lag: int) -> FloatArray:
        return covariances[lag] if lag >= 0 else covariances[-lag].T

    if not order:
        return NoiseModel(np.zeros((0, size, size)), _factor(covariances[0]), float(count))
    right = np.hstack([at(lag) for lag in range(1, order + 1)])
    toeplitz = np.block([[at(column - row) for column in range(order)] for row in range(order)])
    sums = np.tile(np.eye(size), (order, 1))
    solved = np.linalg.solve(toeplitz.T, np.hstack([right.T, sums]))
    stacked = solved[:, :size].T
    innovation = covariances[0] - stacked @ right.T
    coefficients = stacked.reshape(size, order, size).transpose(1, 0, 2)
    factor = _factor(0.5 * (innovation + innovation.T))
    return NoiseModel(coefficients, factor, _freedom(coefficients, factor, sums.T @ solved[:, size:], count))


def _freedom(coefficients: FloatArray, factor: FloatArray, precision: FloatArray, count: int) -> float:
    """Degrees of freedom of the spectrum at zero frequency, in the mean over the directions of the channels.

    The spectrum ``S`` there is that of the sum of the coefficients, whose covariance is ``precision / count``
    times the innovations'. To first order the variance of ``log u' S u`` is ``2 / count`` for the innovations
    and ``4 / count`` times the ratio of ``u' S precision S u`` to ``u' S u`` for the sum; with v degrees of
    freedom it is ``2 / v``. With noise of a short memory and a high order p, v is ``count / (2 p)`` (Akaike
    1969); with slow noise it is a fraction of that.
    """
    spread = np.linalg.solve(np.eye(len(factor)) - coefficients.sum(axis=0), factor)
    ratio = float(np.trace(spread.T @ precision @ spread)) / len(factor)
    return count / (1.0 + 2.0 * max(ratio, 0.0))


def _factor(covariance: FloatArray) -> FloatArray:
    return np.asarray(np.linalg.cholesky(covariance), dtype=np.float64)
