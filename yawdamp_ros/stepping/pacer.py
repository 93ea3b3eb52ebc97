"""How many sample periods are due, by a clock that only ever goes forward."""

from typing import NamedTuple


class Due(NamedTuple):
    """What a look at the clock asks for.

    Attributes
    ----------
    periods : int
        Sample periods to simulate now.
    given_up : int
        Periods that are too late to be made up for.
    """

    periods: int
    given_up: int


class Pacer:
    """Keeps simulated time beside a steady clock.

    The clock is asked, not counted in callbacks: a timer skips the cycles that it misses.

    Parameters
    ----------
    period_ns : int
        Sample period in ns.
    most : int
        Periods that are made up for at once; what is later than that is given up, so that a process that
        was stopped does not run through minutes in a burst.
    now : int
        Steady time of the first sample in ns.
    """

    def __init__(self, period_ns: int, most: int, now: int) -> None:
        self._period_ns = period_ns
        self._most = most
        self._origin = now
        self._done = 0
        self._paused_at: int | None = None

    @property
    def paused(self) -> bool:
        """Whether time stands."""
        return self._paused_at is not None

    def pause(self, now: int) -> None:
        """Let time stand; a second time does nothing."""
        if self._paused_at is None:
            self._paused_at = now

    def resume(self, now: int) -> None:
        """Let time go on where it stood."""
        if self._paused_at is not None:
            self._origin += now - self._paused_at
            self._paused_at = None

    def due(self, now: int) -> Due:
        """Periods due at a steady time in ns; they count as simulated from now on."""
        if self._paused_at is not None:
            return Due(0, 0)
        late = (now - self._origin) // self._period_ns - self._done
        given_up = max(late - self._most, 0)
        self._origin += given_up * self._period_ns
        self._done += late - given_up
        return Due(late - given_up, given_up)
