"""A recorded steering signal."""

from bisect import bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from yawdamp_ros.logs.errors import LogError

LARGEST_ANGLE = 1e4
"""Largest angle of a road wheel or a hand wheel [rad]; a larger one is no steering and would overflow."""

LONGEST_LOG = 1e9
"""Longest log [s], as for the node; a longer one shows a clock that was set, not a drive."""


@dataclass(frozen=True)
class SteeringLog:
    """Steering samples, each in force until the next.

    Attributes
    ----------
    source : str
        File it came from.
    times : sequence of float
        Times from the start of the log [s], not decreasing.
    angles : sequence of float
        Angles, left positive [rad].
    start_time : int
        Time of the first sample [ns], if the log has it; else 0.
    warning : str
        Fault of the file that did not prevent reading; else empty.
    inputs : mapping of str to (sequence of float, sequence of float)
        Times in s and values of every other input beside it, by name; each value is in force until the next.

    Examples
    --------
    >>> from yawdamp_ros.logs import SteeringLog
    >>> SteeringLog("made", times=[0.0, 1.0], angles=[0.0, 0.02]).angles
    [0.0, 0.02]
    """

    source: str
    times: Sequence[float]
    angles: Sequence[float]
    start_time: int = 0
    warning: str = ""
    inputs: Mapping[str, tuple[Sequence[float], Sequence[float]]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.duration > LONGEST_LOG:
            raise LogError(self.source, f"it lasts {self.duration:g} s; expected at most {LONGEST_LOG:g} s")

    def __call__(self, time: float) -> float:
        """Angle in force at a time [s], that of the newest sample [rad]; 0 before the first."""
        index = bisect_right(self.times, time) - 1
        return self.angles[index] if index >= 0 else 0.0

    @property
    def duration(self) -> float:
        """Time of the last sample [s]."""
        return self.times[-1]

    def divided(self, ratio: float) -> "SteeringLog":
        """The same log in road-wheel angles, where it holds those of the hand wheel."""
        return replace(self, angles=[angle / ratio for angle in self.angles])
