"""A measured speed that the model follows quasi-statically."""

import math

from yawdamp_ros.stepping.verdict import Verdict

LOWEST_FOLLOWED = 1.0
"""In m/s. A slip angle is a lateral velocity over the speed, which means nothing towards standstill."""
HIGHEST_SPEED = 70.0
"""In m/s, as for vehicle files."""


class SpeedInput:
    """The newest valid speed, held; every speed is judged and counted.

    Parameters
    ----------
    speed : float
        Until the first one arrives [m/s].

    Attributes
    ----------
    speed : float
        In force [m/s].
    counts : dict of Verdict to int
        Speeds offered so far, by verdict.

    Examples
    --------
    >>> source = SpeedInput(20.0)
    >>> source.offer(0.5)
    <Verdict.CLAMPED: 'clamped'>
    >>> source.speed
    1.0
    """

    def __init__(self, speed: float) -> None:
        self.speed = speed
        self.counts = dict.fromkeys(
            (Verdict.ACCEPTED, Verdict.CLAMPED, Verdict.NOT_FINITE, Verdict.BACKWARDS), 0
        )

    def offer(self, speed: float) -> Verdict:
        """Accept, clamp or reject a speed, and count which.

        Parameters
        ----------
        speed : float
            In m/s. NaN, infinities and driving backwards are rejected; what is too slow or too fast is
            clamped.

        Returns
        -------
        Verdict
        """
        verdict = self._judge(speed)
        self.counts[verdict] += 1
        if verdict in {Verdict.ACCEPTED, Verdict.CLAMPED}:
            self.speed = min(max(speed, LOWEST_FOLLOWED), HIGHEST_SPEED)
        return verdict

    def _judge(self, speed: float) -> Verdict:
        if not math.isfinite(speed):
            return Verdict.NOT_FINITE
        if speed < 0.0:
            return Verdict.BACKWARDS
        return Verdict.ACCEPTED if LOWEST_FOLLOWED <= speed <= HIGHEST_SPEED else Verdict.CLAMPED
