"""Range in which a truck follows the linear model."""

from collections.abc import Callable, Sequence

from yawdamp_ros.simulation.limits import Limits, Stop, limit_violation
from yawdamp_ros.stepping import Sample

BEYOND = "where tyres saturate and a truck may roll over: the model is linear, and shows too little"


class LinearRange:
    """A sink that reports when a run exceeds the levels of a warning; the run goes on.

    Parameters
    ----------
    unit_names : sequence of str
    levels : Limits
        Limits of the linear range; they may be replaced during a run.
    tell : callable, optional
        Function that receives the first instant past a level.

    Attributes
    ----------
    first : Stop or None
        First instant past a level.
    latest : Stop or None
        Newest one since `look`.

    Examples
    --------
    >>> from yawdamp_ros.simulation import Limits, LinearRange
    >>> from yawdamp_ros.simulation import make_motion
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> motion = make_motion(load_vehicle("truck_trailer"), "consistent", speed=20.0, step_size=0.001)
    >>> watched = LinearRange(["truck", "trailer"], Limits(lateral_acceleration=1.0, articulation=0.2))
    >>> watched.write(motion.run([0.05] * 1000))
    >>> watched.first.where
    'truck'
    """

    def __init__(
        self, unit_names: Sequence[str], levels: Limits, tell: Callable[[Stop], None] = lambda _: None
    ) -> None:
        self.levels = levels
        self.first: Stop | None = None
        self.latest: Stop | None = None
        self._unit_names = tuple(unit_names)
        self._tell = tell

    @property
    def sentence(self) -> str:
        """Sentence on a run that left the range; empty if it stayed within."""
        return "" if self.first is None else self.first.reason

    def look(self) -> Stop | None:
        """Newest instant past a level since the last call; None without one."""
        latest, self.latest = self.latest, None
        return latest

    def write(self, sample: Sample) -> None:
        """Take a sample of one or more instants."""
        if found := limit_violation(sample, self._unit_names, self.levels, BEYOND):
            self.latest = found[1]
            if self.first is None:
                self.first = self.latest
                self._tell(self.latest)

    def close(self) -> None:
        """Do nothing: there is nothing to close."""
