"""A measure of many vehicles that differ in a few numbers: the chunks of a sweep."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np

from yawdamp_ros.analysis.eigenmodes import ComplexArray, damping_ratios
from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.analysis.measures import (
    ALL_MEASURES,
    MEASURES,
    NONLINEAR,
    NONLINEAR_MEASURES,
    VEHICLE_MEASURES,
)
from yawdamp_ros.analysis.points import Points
from yawdamp_ros.dynamics import LinearModel, linear_model
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.vehicle import Vehicle, load_stack, unstacked

STABILITY = "stability"
STUDIED = (STABILITY, *ALL_MEASURES)
"""Answers that a study may ask for: stability alone, or a measure beside it."""

LARGEST_REAL_PART = "largest_real_part"
"""Column of the largest real part of the eigenvalues [1/s]; below 0 the vehicle is stable."""

_EIGENVALUES = (STABILITY, "least_damping_ratio")
_LARGE_CHUNK, _CHUNK, _SOME, _FEW = 25_000, 500, 100, 5


@dataclass(frozen=True)
class Study:
    """Question asked at every point; it can be sent to another process or machine.

    Attributes
    ----------
    text : str
        Text of the vehicle file.
    source : str
        Name of the file in error messages.
    overrides : tuple of str
        Changes applied before the point's values.
    model : str
        One of `yawdamp_ros.dynamics.MODELS`, or ``nonlinear``: then the measure is by the nonlinear model,
        and the eigenvalues are those of `consistent`.
    keys : tuple of tuple of str
        Keys that take the value of each coordinate of a point.
    measure : str
        One of `STUDIED`.
    """

    text: str
    source: str
    overrides: tuple[str, ...]
    model: str
    keys: tuple[tuple[str, ...], ...]
    measure: str = STABILITY

    def __post_init__(self) -> None:
        if self.measure not in STUDIED:
            message = f"measure: {self.measure!r}: expected one of {', '.join(STUDIED)}"
            raise AnalysisError(message)
        if self.model == NONLINEAR and self.measure not in {*NONLINEAR_MEASURES, *VEHICLE_MEASURES}:
            known = ", ".join(NONLINEAR_MEASURES)
            message = f"measure: {self.measure!r}: the nonlinear model has {known}"
            raise AnalysisError(message)

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of what `evaluate` gives."""
        return (LARGEST_REAL_PART,) if self.measure == STABILITY else (LARGEST_REAL_PART, self.measure)

    @property
    def chunk(self) -> int:
        """Points that are worth a message to another process."""
        if self.model == NONLINEAR:
            return _FEW
        if self.measure in VEHICLE_MEASURES:
            return _SOME
        return _LARGE_CHUNK if self.measure in _EIGENVALUES else _CHUNK

    @property
    def threads(self) -> bool:
        """True if the work is compiled and runs without Python's lock, side by side in threads."""
        return self.model == NONLINEAR

    def check(self, points: Points) -> None:
        """Refuse points that are no valid vehicles, before any work is done.

        Raises
        ------
        VehicleError, DynamicsError
            As `eigenvalues`.
        """
        for start in range(0, len(points), _LARGE_CHUNK):
            self._stack(points[start : start + _LARGE_CHUNK])
        self.eigenvalues(points[:1])

    def eigenvalues(self, points: FloatArray) -> ComplexArray:
        """Eigenvalues at many points, by one call for all of them.

        Parameters
        ----------
        points : ndarray, shape (k, d)

        Returns
        -------
        ndarray of complex, shape (k, 2 n)
            In 1/s.

        Raises
        ------
        VehicleError, DynamicsError
            If any point is no valid vehicle, or there is no such model of it.
        """
        return _eigenvalues(self._model(self._stack(points), len(points), None))

    def evaluate(self, points: FloatArray) -> FloatArray:
        """Answers at many points.

        Parameters
        ----------
        points : ndarray, shape (k, d)

        Returns
        -------
        ndarray, shape (k, len(columns))
            NaN where a measure has no value.

        Raises
        ------
        VehicleError, DynamicsError
            As `eigenvalues`.
        """
        stack = self._stack(points)
        eigenvalues = _eigenvalues(self._model(stack, len(points), None))
        found = [eigenvalues.real.max(axis=1)]
        if self.measure in VEHICLE_MEASURES:
            found.append(self._one_by_one(stack, len(points)))
        elif self.model == NONLINEAR:
            found.append(self._nonlinear(stack, len(points)))
        elif self.measure in _EIGENVALUES[1:]:
            found.append(damping_ratios(eigenvalues).min(axis=1))
        elif self.measure != STABILITY:
            measure = MEASURES[self.measure]
            speed = measure.speed_for(stack, stack.speed if self._speed_given else None)
            found.append(measure.answers(self._model(stack, len(points), speed)).values)
        return np.column_stack(found)

    @property
    def _speed_given(self) -> bool:
        return any("speed" in keys for keys in self.keys) or any(
            override.startswith("speed=") for override in self.overrides
        )

    def _one_by_one(self, stack: Vehicle, count: int) -> FloatArray:
        """The measure of each of a stack; NaN where there is none."""
        measure, values = VEHICLE_MEASURES[self.measure], np.full(count, np.nan)
        for index in range(count):
            vehicle = unstacked(stack, index)
            speed = measure.speed_for(vehicle, vehicle.speed if self._speed_given else None)
            with suppress(AnalysisError):
                value = measure.value_of(vehicle, speed)
                values[index] = np.nan if value is None else value
        return values

    def _nonlinear(self, stack: Vehicle, count: int) -> FloatArray:
        """The measure of each of a stack by the nonlinear model; NaN where it ends in a rollover."""
        # Numba takes long to import, which no other study waits for.
        from yawdamp_ros.analysis.nonlinear_measures import nonlinear_measure  # noqa: PLC0415

        values = np.full(count, np.nan)
        for index in range(count):
            vehicle = unstacked(stack, index)
            speed = vehicle.speed if self._speed_given else None
            with suppress(AnalysisError):
                values[index] = nonlinear_measure(self.measure, vehicle, speed)
        return values

    def _stack(self, points: FloatArray) -> Vehicle:
        values = {key: column for keys, column in zip(self.keys, points.T, strict=True) for key in keys}
        return load_stack(self.text, self.source, self.overrides, values)

    def _model(self, stack: Vehicle, count: int, speed: float | None) -> LinearModel:
        """Linear model of a stack, of each of its vehicles even where they are all alike."""
        model = linear_model(stack, speed, "consistent" if self.model == NONLINEAR else self.model)

        def each(part: FloatArray, axes: int) -> FloatArray:
            return np.broadcast_to(part, (count, *part.shape[-axes:]))

        return replace(
            model,
            state_matrix=each(model.state_matrix, 2),
            input_matrix=each(model.input_matrix, 1),
            output_matrix=each(model.output_matrix, 2),
            feedthrough=each(model.feedthrough, 1),
        )


def _eigenvalues(model: LinearModel) -> ComplexArray:
    return np.asarray(np.linalg.eigvals(model.state_matrix), dtype=np.complex128)


class Evaluated(Protocol):
    """Study of one measure or of several, as far as `evaluate_all` asks."""

    @property
    def chunk(self) -> int:
        """Points that are worth a message to another process."""

    def evaluate(self, points: FloatArray) -> FloatArray:
        """Answers at many points."""


def evaluate_all(
    study: Evaluated,
    points: Points,
    mapped: Callable[[Callable[[FloatArray], FloatArray], Iterable[FloatArray]], Iterable[Any]] = map,
    start: int = 0,
) -> Iterator[FloatArray]:
    """Answers at many points, chunk by chunk and in order.

    Parameters
    ----------
    study : Study or SchemeStudy
    points : Points
    mapped : callable
        Applies a function to every chunk: ``map``, or that method of an executor of `concurrent.futures`.
    start : int
        Index of the first point.

    Yields
    ------
    ndarray, shape (chunk, c)
        Answers of the study's `evaluate`.
    """
    chunks = (points[begin : begin + study.chunk] for begin in range(start, len(points), study.chunk))
    yield from mapped(study.evaluate, chunks)
