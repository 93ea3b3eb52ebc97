"""Readings of the imu topics: the motion with noise, bias, drift and delay."""

from collections.abc import Sequence
from itertools import repeat

import numpy as np

from yawdamp_ros.dynamics.kinematics import ComplexArray, FloatArray
from yawdamp_ros.simulation import SimParameters
from yawdamp_ros.stepping import TimeGrid
from yawdamp_ros.stepping.time_grid import SECOND

AXES = ("yaw", "yaw_rate", "lateral_acceleration")
"""Quantities that have errors."""


class Sensors:
    """Sensors of every unit, whose errors depend on the seed and the step alone, so that a run repeats.

    Parameters
    ----------
    settings : SimParameters
    grid : TimeGrid
    units : int

    Attributes
    ----------
    deviations : tuple of float
        Standard deviations of the noise on `AXES`.
    history : list of list of float
        Motion of the last samples, oldest first, as far as the delay reaches back.

    Examples
    --------
    >>> import numpy as np
    >>> sensors = Sensors(SimParameters(yaw_rate_bias=0.01), TimeGrid.of(0.001, 0.01), units=1)
    >>> zero = np.zeros((1, 1))
    >>> float(sensors.readings([0], zero + 1.0, zero + 0.2, zero, zero)["imu_yaw_rate"][0, 0])
    0.21000000000000002
    """

    def __init__(self, settings: SimParameters, grid: TimeGrid, units: int) -> None:
        def of_axes(kind: str) -> tuple[float, ...]:
            return tuple(getattr(settings, f"{axis}_{kind}") for axis in AXES)

        self.deviations = of_axes("stddev")
        self._bias, self._drift = of_axes("bias"), of_axes("drift")
        self._seed, self._grid, self._units = settings.noise_seed, grid, units
        self._delay = round(settings.imu_delay * SECOND / grid.period_ns)
        # Random generators load slowly, and few runs need them.
        self._walk = _RandomWalk(settings.noise_seed, units) if any(self._drift) else None
        self.history: list[list[float]] = []

    @property
    def exact(self) -> bool:
        """True if the readings are the motion."""
        return not (any((*self.deviations, *self._bias, *self._drift)) or self._delay)

    def readings(
        self,
        steps: Sequence[int],
        half: ComplexArray,
        yaw_rate: FloatArray,
        along: FloatArray,
        across: FloatArray,
    ) -> dict[str, FloatArray]:
        """Readings of m samples by the names of the quantities of an imu.

        Parameters
        ----------
        steps : sequence of int
            Step of each sample.
        half : ndarray of complex
            Half turns of n units, in m rows or one.
        yaw_rate, along, across : ndarray
            Yaw rates and accelerations, in the same shape [rad/s, m/s^2].

        Returns
        -------
        dict of str to ndarray, shape (m, n)
        """
        shape = len(steps), 5, self._units
        motion = np.stack([half.real, half.imag, yaw_rate, along, across]).reshape(5, shape[0], shape[2])
        real, imaginary, yaw_rate, along, across = (
            self._delayed(motion.swapaxes(0, 1).reshape(shape[0], -1)).reshape(shape).swapaxes(0, 1)
        )
        errors = np.array([self._errors(step) for step in steps])
        half = (real + 1j * imaginary) * np.exp(0.5j * errors[:, 0])
        return {
            "imu_z": half.imag,
            "imu_w": half.real,
            "imu_yaw_rate": yaw_rate + errors[:, 1],
            "imu_longitudinal_acceleration": along,
            "imu_lateral_acceleration": across + errors[:, 2],
        }

    def _delayed(self, rows: FloatArray) -> FloatArray:
        """Rows of samples, each of the sample before it by the delay, or of the first one."""
        if not self._delay:
            return rows
        known = [*self.history, *rows.tolist()]
        first = len(self.history) - self._delay
        self.history = known[-self._delay :]
        return np.array([known[max(first + index, 0)] for index in range(len(rows))])

    def _errors(self, step: int) -> FloatArray:
        """Errors of `AXES` on every unit at a step, shape (3, units)."""
        errors: FloatArray = np.zeros((self._units, 3))
        if any(self.deviations):
            generator = np.random.default_rng([self._seed, step])
            errors = generator.standard_normal((self._units, 3)) * self.deviations
        if self._walk is not None:
            errors = errors + self._walk.at(float(self._grid.seconds(step))) * self._drift
        return (errors + self._bias).T


class _RandomWalk:
    """A random walk of every axis of every unit, with a standard deviation of 1 after a second.

    It has a knot every second and runs straight in between.
    """

    def __init__(self, seed: int, units: int) -> None:
        # A stream of its own: those of the noise are of a seed and a step, and zeros behind change none.
        self._generator = np.random.default_rng([seed, 0, 0, 1])
        self._shape = units, len(AXES)
        self._second = 0
        self._before = np.zeros(self._shape)
        self._after = self._generator.standard_normal(self._shape)

    def at(self, time: float) -> FloatArray:
        """Walk at a time, not before that of the last call [s], shape (units, 3)."""
        for _ in repeat(None, int(time) - self._second):
            self._before = self._after
            self._after = self._before + self._generator.standard_normal(self._shape)
        self._second = int(time)
        walk: FloatArray = self._before + (time - self._second) * (self._after - self._before)
        return walk
