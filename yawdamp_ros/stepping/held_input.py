"""A commanded number that holds until the next."""

import math

from yawdamp_ros.stepping.verdict import Verdict

LOWEST_FOLLOWED = 1.0
"""Lowest speed [m/s]. Slip angles divide by the speed and lose their meaning towards standstill."""
HIGHEST_SPEED = 70.0
"""Highest speed [m/s], as for vehicle files."""
FASTEST_REVERSE = 5.0
"""Largest speed backwards that may be demanded of a model that can reverse [m/s]."""


class HeldInput:
    """Input that holds its newest valid value; every value offered is checked and counted.

    Parameters
    ----------
    value : float or None
        Value until the first one arrives; None demands nothing.
    low, high : float
        Range; a value outside is clamped.
    backwards : bool
        Whether negative values are accepted; else they are rejected.

    Attributes
    ----------
    value : float or None
        Value in force.
    low, high : float
    counts : dict of Verdict to int
        Values offered so far, by verdict.

    Examples
    --------
    >>> speed = HeldInput(20.0, 1.0, 70.0, backwards=False)
    >>> speed.offer(0.5, step=0)
    <Verdict.CLAMPED: 'clamped'>
    >>> speed.value
    1.0
    """

    def __init__(self, value: float | None, low: float, high: float, *, backwards: bool = True) -> None:
        self.value = value
        self.counts = dict.fromkeys(
            (Verdict.ACCEPTED, Verdict.CLAMPED, Verdict.NOT_FINITE, Verdict.BACKWARDS, Verdict.NOT_SOURCE), 0
        )
        self.low, self.high = low, high
        self._backwards = backwards
        self._received_at: int | None = None

    def offer(self, value: float, step: int) -> Verdict:
        """Accept, clamp or reject a value that arrived after a step, and count which.

        Parameters
        ----------
        value : float
        step : int

        Returns
        -------
        Verdict
        """
        verdict = self._judge(value)
        self.counts[verdict] += 1
        if verdict in {Verdict.ACCEPTED, Verdict.CLAMPED}:
            self.value, self._received_at = min(max(value, self.low), self.high), step
        return verdict

    def reject(self, verdict: Verdict) -> Verdict:
        """Count a value without checking it."""
        self.counts[verdict] += 1
        return verdict

    def steps_since_command(self, step: int) -> int | None:
        """Steps since the last value; None before the first."""
        return None if self._received_at is None else step - self._received_at

    def _judge(self, value: float) -> Verdict:
        if not math.isfinite(value):
            return Verdict.NOT_FINITE
        if value < 0.0 and not self._backwards:
            return Verdict.BACKWARDS
        return Verdict.ACCEPTED if self.low <= value <= self.high else Verdict.CLAMPED
