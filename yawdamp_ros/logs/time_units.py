"""Units of the times in a table, which rarely names them."""

from collections.abc import Sequence
from typing import NamedTuple

TELLING = 10
"""Number of samples whose mean interval determines the unit."""


class TimeUnit(NamedTuple):
    """A unit of time.

    Attributes
    ----------
    name : str
    per_second : float
    """

    name: str
    per_second: float


SECONDS = TimeUnit("s", 1.0)
UNITS = (TimeUnit("ms", 1e3), TimeUnit("us", 1e6), TimeUnit("ns", 1e9))

_LATEST = 1e11
"""Time since 1970 that is beyond any log [s]: the year 5138."""
_LONGEST = 2.0
"""Mean interval that is beyond any log of steering [s]."""


def time_unit(column: str, times: Sequence[float]) -> TimeUnit:
    """Tell the unit of times by the name of their column, else by their size.

    Times since 1970 tell it by themselves, others by their mean interval: steering is sampled faster than
    every two seconds.

    Parameters
    ----------
    column : str
        Name of the column, as in ``time_ms``.
    times : sequence of float
        First times of the table, not decreasing.

    Returns
    -------
    TimeUnit

    Examples
    --------
    >>> time_unit("time", [10_000.0 * step for step in range(100)]).name  # 100 Hz
    'us'
    """
    by_name = next((unit for unit in UNITS if column.endswith(f"_{unit.name}")), None)
    if by_name is not None or column.endswith("_s"):
        return by_name or SECONDS
    interval = (times[-1] - times[0]) / (len(times) - 1) if len(times) >= TELLING else 0.0
    # The finest unit in which the times are too large for the next coarser one.
    too_large = [
        unit
        for coarser, unit in zip((SECONDS, *UNITS), UNITS, strict=False)
        if times[0] / coarser.per_second > _LATEST or interval / coarser.per_second >= _LONGEST
    ]
    return too_large[-1] if too_large else SECONDS
