"""Sample periods that are due by a monotonic clock."""

from typing import NamedTuple

CATCH_UP_NS = 100_000_000
"""Longest delay of the clock that is caught up [ns]."""
LEAST_CATCH_UP = 10
"""Sample periods that are caught up even if they are longer than that."""


class Due(NamedTuple):
    """Periods that a reading of the clock asks for.

    Attributes
    ----------
    periods : int
        Sample periods to simulate now.
    dropped : int
        Periods that are too late to be caught up.
    lateness : float
        Delay of simulated time behind the clock, beyond the period that has just passed [ns].
    """

    periods: int
    dropped: int
    lateness: float


class Pacer:
    """Simulated time that follows a monotonic clock at a rate.

    The clock is read, not counted in callbacks: a timer skips the cycles that it misses. A delay of up to
    `CATCH_UP_NS`, or `LEAST_CATCH_UP` periods, is caught up; the rest is dropped, so that a process that
    was stopped does not run through minutes in a burst.

    Parameters
    ----------
    period_ns : int
        Sample period in simulated time [ns].
    rate : float
        Simulated time over clock time; 0 runs as fast as possible.
    now : int
        Clock time of the first sample [ns].

    Examples
    --------
    >>> from yawdamp_ros.stepping import Pacer
    >>> pacer = Pacer(period_ns=10_000_000, rate=1.0, now=0)
    >>> pacer.due(now=25_000_000).periods
    2
    """

    def __init__(self, period_ns: int, rate: float, now: int) -> None:
        self._period_ns = period_ns
        self._rate = rate
        self._since = now
        self._ahead = 0.0
        self._paused = False

    @property
    def paused(self) -> bool:
        """True while time stands still."""
        return self._paused

    def pause(self, now: int) -> None:
        """Pause time; a second pause does nothing."""
        self._bank(now)
        self._paused = True

    def resume(self, now: int) -> None:
        """Resume time where it stood."""
        self._bank(now)
        self._paused = False

    def change_rate(self, rate: float, now: int) -> None:
        """Continue at another rate."""
        self._bank(now)
        self._rate = rate

    def due(self, now: int) -> Due:
        """Periods due at a steady time [ns]; they count as simulated from now on."""
        if self._paused:
            return Due(0, 0, 0.0)
        if not self._rate:
            return Due(self._most(), 0, 0.0)
        # Whole periods stay integers: only the fraction of one is a float, even after days.
        self._bank(now)
        periods = int(self._ahead // self._period_ns)
        self._ahead -= periods * self._period_ns
        dropped = max(periods - self._most(), 0)
        late = (max(periods - 1, 0) * self._period_ns + self._ahead) / self._rate if periods else 0.0
        return Due(periods - dropped, dropped, late)

    def _most(self) -> int:
        return max(int(CATCH_UP_NS * max(self._rate, 1.0)) // self._period_ns, LEAST_CATCH_UP)

    def _bank(self, now: int) -> None:
        """Convert the time since the last reading into simulated time that is due."""
        if not self._paused:
            self._ahead += (now - self._since) * self._rate
        self._since = now
