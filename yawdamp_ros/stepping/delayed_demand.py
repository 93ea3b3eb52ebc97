"""The dead time and the lag between a demand and its effect."""

import math
from collections import deque


class DelayedDemand:
    """A demand that acts after a dead time and by a first-order lag, each 0 for none.

    Between two calls the effect follows the exact solution for the demand in force at the first of them.

    Parameters
    ----------
    dead_time, time_constant : float
        s.

    Examples
    --------
    >>> brakes = DelayedDemand(dead_time=0.1, time_constant=0.1)
    >>> [round(brakes.follow(0.1 * tenth, -3.0), 2) for tenth in range(5)]
    [0.0, 0.0, -1.9, -2.59, -2.85]
    """

    def __init__(self, dead_time: float, time_constant: float) -> None:
        self._dead_time = dead_time
        self._time_constant = time_constant
        self.clear()

    def clear(self) -> None:
        """Return to no demand."""
        self._coming: deque[tuple[float, float]] = deque()
        self._target = self._effect = self._since = 0.0

    def follow(self, time: float, demand: float) -> float:
        """Effect at a time of the demand from that time on.

        Parameters
        ----------
        time : float
            Time, not before that of the last call [s].
        demand : float

        Returns
        -------
        float
        """
        if self._time_constant:
            gone = 1.0 - math.exp((self._since - time) / self._time_constant)
            self._effect += gone * (self._target - self._effect)
        self._since = time
        self._coming.append((time + self._dead_time, demand))
        while self._coming and self._coming[0][0] <= time:
            self._target = self._coming.popleft()[1]
        return self._effect if self._time_constant else self._target
