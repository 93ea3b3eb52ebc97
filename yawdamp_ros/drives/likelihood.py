"""The largest likelihood of measured series under a model with parameters, and its curvature."""

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import AbstractContextManager, nullcontext
from typing import NamedTuple

import numpy as np

from yawdamp_ros.drives.noise_model import NoiseModel, fitted, independent
from yawdamp_ros.drives.parameters import Parameter
from yawdamp_ros.dynamics.kinematics import FloatArray

DIFFERENCE = 1e-5
"""Step of a coordinate for numerical derivatives."""
MOST_ROUNDS = 6
"""Limit on the rounds that fit parameters and noise in turn."""
MOST_SAMPLES = 40_000
"""Limit on the samples of a series; a longer series is fitted by means over neighbours."""
WIDE = 3.0
"""Prior standard deviation of a coordinate: it keeps undetermined coordinates finite."""
NEAR = 0.03
"""Move of a parameter's coordinate within which derivatives hold: they change by as small a share."""
LAGS, MOST_OF_SERIES = 200, 0.05
"""Lags at which the robust intervals look for correlation that the noise model left, at most this share of
the samples."""


class Series(NamedTuple):
    """Measurements of one sensor.

    Attributes
    ----------
    name : str
        Output that it measures.
    times, values : ndarray, shape (k,)
    """

    name: str
    times: FloatArray
    values: FloatArray


class Fit(NamedTuple):
    """Maximum of the likelihood.

    Attributes
    ----------
    coordinates : ndarray, shape (p,)
        Coordinates of the parameters, then the offset of every series.
    errors : ndarray, shape (p,)
        Standard errors of the coordinates.
    correlations : ndarray, shape (p, p)
    noise_order : int
    """

    coordinates: FloatArray
    errors: FloatArray
    correlations: FloatArray
    noise_order: int


def maximise(
    parameters: Sequence[Parameter],
    outputs: Callable[[Mapping[str, float]], Mapping[str, FloatArray]],
    times: FloatArray,
    series: Sequence[Series],
    spreads: Sequence[float],
) -> Fit:
    """Fit parameters and the series' offsets.

    Parameters
    ----------
    parameters : sequence of Parameter
    outputs : callable
        Outputs at the times by values of the parameters.
    times : ndarray, shape (k,)
    series : sequence of Series
    spreads : sequence of float
        Standard deviation that is expected of each series' offset.
    """
    # Matrices are small: several threads would wait for one another far longer than they work.
    with _one_thread():
        widths = np.array([*(WIDE for _ in parameters), *spreads])
        return _maximum(_Problem(parameters, outputs, times, series, widths))


def _maximum(problem: "_Problem") -> Fit:
    from scipy.optimize import least_squares  # noqa: PLC0415 - it loads longer than most commands run

    at = problem.start()
    noises = [independent(each) for each in problem.residuals(at)]
    for _ in range(MOST_ROUNDS):
        solution = least_squares(
            problem.whitened, at, problem.jacobian, x_scale="jac", ftol=1e-7, xtol=1e-5, args=(noises,)
        )
        moved = solution.x - at
        at = solution.x
        found = [fitted(each) for each in problem.residuals(at)]
        settled = [each.order for each in found] == [each.order for each in noises]
        noises = found
        errors = np.sqrt(np.diag(_inverse(solution.jac)))
        if settled and (np.abs(moved) < 0.05 * errors).all():
            break
    covariance = problem.covariance(at, noises)
    errors = np.sqrt(np.diag(covariance))
    return Fit(at, errors, covariance / np.outer(errors, errors), max(noise.order for noise in noises))


class _Problem:
    """Residuals and their derivatives; series that were sampled together share a noise model."""

    def __init__(
        self,
        parameters: Sequence[Parameter],
        outputs: Callable[[Mapping[str, float]], Mapping[str, FloatArray]],
        times: FloatArray,
        series: Sequence[Series],
        spreads: FloatArray,
    ) -> None:
        self._parameters, self._outputs, self._times = parameters, outputs, times
        self._spreads = spreads
        self._series = series
        self._groups = _together(series)
        # Results of the last place, which is requested more than once.
        self._known: tuple[FloatArray, list[FloatArray]] | None = None
        self._slopes: tuple[FloatArray, list[FloatArray]] | None = None

    def start(self) -> FloatArray:
        at = np.zeros(len(self._parameters) + len(self._series))
        for group, part in zip(self._groups, self.residuals(at), strict=True):
            places = [len(self._parameters) + index for index in group]
            widest = self._spreads[places]
            at[places] = np.clip(np.median(part, axis=0), -widest, widest)
        return at

    def residuals(self, at: FloatArray) -> list[FloatArray]:
        """Measured less predicted and offset, shape (k, m) for each group."""
        count = len(self._parameters)
        predicted = self._predicted(at[:count])
        return [
            _means(np.column_stack([self._series[index].values for index in group]) - part)
            - at[[count + index for index in group]]
            for group, part in zip(self._groups, predicted, strict=True)
        ]

    def whitened(self, at: FloatArray, noises: Sequence[NoiseModel]) -> FloatArray:
        parts = [noise.whitened(each).ravel() for noise, each in zip(noises, self.residuals(at), strict=True)]
        return np.concatenate([*parts, at / self._spreads])

    def jacobian(self, at: FloatArray, noises: Sequence[NoiseModel]) -> FloatArray:
        parts = [
            noise.whitened(each).reshape(-1, each.shape[2])
            for noise, each in zip(noises, self._derivatives(at), strict=True)
        ]
        return np.concatenate([*parts, np.diag(1.0 / self._spreads)])

    def covariance(self, at: FloatArray, noises: Sequence[NoiseModel]) -> FloatArray:
        """Covariance of the coordinates: the likelihood's or the robust one, whichever has larger errors."""
        jacobian = self.jacobian(at, noises)
        by_likelihood = _inverse(jacobian)
        middle = np.diag(1.0 / self._spreads**2)
        for noise, residual, derivative in zip(
            noises, self.residuals(at), self._derivatives(at), strict=True
        ):
            scores = np.einsum("km,kmp->kp", noise.whitened(residual), noise.whitened(derivative))
            middle = middle + _long_run(scores)
        robust = by_likelihood @ middle @ by_likelihood
        wider = np.sqrt(np.maximum(np.diag(robust) / np.diag(by_likelihood), 1.0))
        known = max(
            noise.uncertainty(len(residual))
            for noise, residual in zip(noises, self.residuals(at), strict=True)
        )
        return np.asarray(known * by_likelihood * np.outer(wider, wider), dtype=np.float64)

    def _derivatives(self, at: FloatArray) -> list[FloatArray]:
        """Derivatives of the residuals by the coordinates, here or near, shape (k, m, p) for each group."""
        count = len(self._parameters)
        if self._slopes is not None and np.abs(self._slopes[0] - at)[:count].max(initial=0.0) <= NEAR:
            return self._slopes[1]
        now = self._predicted(at[:count])
        found = [np.zeros((len(_means(part)), part.shape[1], len(at))) for part in now]
        with ThreadPoolExecutor() as executor:
            moved = executor.map(self._prediction, at[:count] + DIFFERENCE * np.eye(count))
        for index, parts in enumerate(moved):
            for place, (before, after) in enumerate(zip(now, parts, strict=True)):
                found[place][:, :, index] = _means(before - after) / DIFFERENCE
        for group, part in zip(self._groups, found, strict=True):
            for column, index in enumerate(group):
                part[:, column, count + index] = -1.0
        self._slopes = at.copy(), found
        return found

    def _predicted(self, at: FloatArray) -> list[FloatArray]:
        if self._known is None or not np.array_equal(self._known[0], at):
            self._known = at.copy(), self._prediction(at)
        return self._known[1]

    def _prediction(self, at: FloatArray) -> list[FloatArray]:
        values = {
            each.name: each.value(place) for each, place in zip(self._parameters, at.tolist(), strict=True)
        }
        outputs = self._outputs(values)
        return [
            np.column_stack(
                [
                    np.interp(self._series[index].times, self._times, outputs[self._series[index].name])
                    for index in group
                ]
            )
            for group in self._groups
        ]


def _long_run(scores: FloatArray) -> FloatArray:
    """Covariance of the sum of scores of shape (k, p) that are correlated over up to `LAGS` lags.

    It is Bartlett's estimate: the mean product of sums over windows of that length. Such an estimate is too
    small, and uncertain, by the share b of the window in all samples, so that the quantile 1.96 of 95 %
    intervals becomes ``1.96 + 2.9694 b + 0.4160 b^2 - 0.5324 b^3`` (Kiefer and Vogelsang 2005, table 1); here
    it is a factor.
    """
    count, size = scores.shape
    window = max(min(LAGS, int(MOST_OF_SERIES * count)), 1)
    share = window / count
    quantile = 1.96 + share * (2.9694 + share * (0.4160 - 0.5324 * share))
    sums = np.cumsum(np.concatenate([np.zeros((window, size)), scores, np.zeros((window, size))]), axis=0)
    within = sums[window:] - sums[:-window]
    return np.asarray((quantile / 1.96) ** 2 / window * (within.T @ within), dtype=np.float64)


def _one_thread() -> AbstractContextManager[object]:
    """Keep the BLAS to one thread, where threadpoolctl is there to do so."""
    try:
        from threadpoolctl import threadpool_limits  # noqa: PLC0415 - rosdep does not bring it
    except ImportError:
        return nullcontext()
    limits: AbstractContextManager[object] = threadpool_limits(1, "blas")
    return limits


def _together(series: Sequence[Series]) -> list[list[int]]:
    """Indices of series that were sampled at the same times, within a tenth of the interval."""
    groups: list[list[int]] = []
    for index, each in enumerate(series):
        for group in groups:
            times = series[group[0]].times
            if len(times) == len(each.times):
                near = 0.1 * float(np.median(np.diff(times))) if len(times) > 1 else 0.0
                if np.abs(times - each.times).max() <= near:
                    group.append(index)
                    break
        else:
            groups.append([index])
    return groups


def _means(values: FloatArray) -> FloatArray:
    """Means of neighbours along the first axis, so that at most `MOST_SAMPLES` are left."""
    every = -(-len(values) // MOST_SAMPLES)
    kept = values[: len(values) // every * every]
    return np.asarray(kept.reshape(-1, every, *values.shape[1:]).mean(axis=1), dtype=np.float64)


def _inverse(jacobian: FloatArray) -> FloatArray:
    """Covariance by a Jacobian of whitened residuals; very large for undetermined coordinates."""
    information = jacobian.T @ jacobian
    scale = np.sqrt(np.maximum(np.diag(information), 1e-300))
    values, vectors = np.linalg.eigh(information / np.outer(scale, scale))
    inverse = (vectors / np.maximum(values, 1e-12)) @ vectors.T
    return np.asarray(inverse / np.outer(scale, scale), dtype=np.float64)
