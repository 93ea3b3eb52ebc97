"""Simulated time, counted in whole steps of whole nanoseconds."""

from dataclasses import dataclass
from typing import overload

import numpy as np
import numpy.typing as npt

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.stepping.errors import SteppingError

SECOND = 1_000_000_000
"""Nanoseconds in a second."""

LONGEST_TIME = 1e9
"""Longest time [s], as for the node: a longer one is a typing error."""


def nanoseconds(seconds: float) -> int:
    """Whole nanoseconds nearest to a time [s]."""
    return round(seconds * SECOND)


@dataclass(frozen=True)
class TimeGrid:
    """Fixed step, and samples at a fixed number of steps.

    Integers throughout: a sum of a million floats drifts, a count does not.

    Attributes
    ----------
    step_ns : int
        Length of a step [ns].
    steps_per_sample : int
        Steps from one published sample to the next.

    Examples
    --------
    >>> from yawdamp_ros.stepping import TimeGrid
    >>> grid = TimeGrid.of(step_size=0.001, sample_period=0.01)
    >>> grid.steps_per_sample, grid.samples_in(2.0)
    (10, 200)
    """

    step_ns: int
    steps_per_sample: int

    @classmethod
    def of(cls, step_size: float, sample_period: float) -> "TimeGrid":
        """Grid of a step size and a sample period, both [s].

        Raises
        ------
        SteppingError
            If the step is shorter than 1 us, or the period is not a whole number of steps.
        """
        for name, value in (("step_size", step_size), ("sample_period", sample_period)):
            if not 0.0 < value <= LONGEST_TIME:
                message = f"{name}: {value}: expected a time in s above 0, at most {LONGEST_TIME:g}"
                raise SteppingError(message)
        step_ns, period_ns = nanoseconds(step_size), nanoseconds(sample_period)
        if step_ns < 1000:  # noqa: PLR2004 - a microsecond
            message = f"step_size: {step_size}: expected at least 1e-06 s"
            raise SteppingError(message)
        steps = round(period_ns / step_ns)
        # A rate such as 300 Hz has no exact period; its rounding may reach a nanosecond for each step.
        if steps < 1 or abs(steps * step_ns - period_ns) > steps:
            message = (
                f"step_size: {step_size:g} s: expected a whole number of steps "
                f"in a sample period of {sample_period:g} s"
            )
            raise SteppingError(message)
        return cls(step_ns, steps)

    @property
    def step_size(self) -> float:
        """Length of a step [s]."""
        return self.step_ns / SECOND

    @property
    def period_ns(self) -> int:
        """Time from one sample to the next [ns]."""
        return self.step_ns * self.steps_per_sample

    @overload
    def seconds(self, step: int) -> float: ...

    @overload
    def seconds(self, step: npt.NDArray[np.int64]) -> FloatArray: ...

    def seconds(self, step: int | npt.NDArray[np.int64]) -> float | FloatArray:
        """Simulated time in s of a step, or of each of several."""
        return step * self.step_ns / SECOND

    def samples_in(self, duration: float) -> int:
        """Whole sample periods in a duration given [s].

        Raises
        ------
        SteppingError
            If the duration is none.
        """
        if not 0.0 <= duration <= LONGEST_TIME:
            message = f"duration: {duration}: expected a time in s, 0 to {LONGEST_TIME:g}"
            raise SteppingError(message)
        return nanoseconds(duration) // self.period_ns
