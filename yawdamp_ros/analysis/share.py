"""Many vehicles against a scheme: which share meets a level, and what decides."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from yawdamp_ros.analysis.assessment import ROLLOVER
from yawdamp_ros.analysis.points import Points
from yawdamp_ros.analysis.schemes import Requirement, Scheme
from yawdamp_ros.analysis.study import Study
from yawdamp_ros.dynamics.kinematics import FloatArray


@dataclass(frozen=True)
class SchemeStudy:
    """A `Study` of every measure of a scheme, which can be sent to another process as it is.

    Attributes
    ----------
    studies : tuple of Study
        Studies of one vehicle and its varied keys, one for each measure of the scheme.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import vehicle_text
    >>> keys = (("units.2.mass",),)
    >>> study = Study(vehicle_text("interlink"), "interlink", (), "consistent", keys, "tail_swing")
    >>> SchemeStudy((study,)).evaluate(np.array([[2e4], [3e4]])).shape
    (2, 1)
    """

    studies: tuple[Study, ...]

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the measures."""
        return tuple(study.measure for study in self.studies)

    @property
    def chunk(self) -> int:
        """Points that are worth a message to another process."""
        return min(study.chunk for study in self.studies)

    @property
    def threads(self) -> bool:
        """False: the work holds Python's lock."""
        return False

    def check(self, points: Points) -> None:
        """Refuse points that are no valid vehicles."""
        self.studies[0].check(points)

    def evaluate(self, points: FloatArray) -> FloatArray:
        """Values of the measures at many points, shape (k, m); NaN where there is none."""
        return np.column_stack([study.evaluate(points)[:, -1] for study in self.studies])


@dataclass(frozen=True)
class Share:
    """Shares of k vehicles that meet a level.

    Attributes
    ----------
    count : int
    meeting : float
        Share that fails no limit.
    failing : mapping of str to float
        Share that fails a measure.
    alone : mapping of str to float
        Share that fails this measure and no other.
    reaching : mapping of str to float
        Share that reaches each level or a harder one.
    unknown : tuple of str
        Measures with a limit that have no value for some vehicle.
    """

    count: int
    meeting: float
    failing: Mapping[str, float]
    alone: Mapping[str, float]
    reaching: Mapping[str, float]
    unknown: tuple[str, ...]


def share_of(
    scheme: Scheme,
    columns: tuple[str, ...],
    values: FloatArray,
    level: str | None = None,
    srt: float | None = None,
) -> Share:
    """Judge many vehicles.

    Parameters
    ----------
    scheme : Scheme
    columns : tuple of str
        Measures of the columns.
    values : ndarray, shape (k, m)
        NaN where there is none.
    level : str, optional
        Level of the scheme; the easiest unless given.
    srt : float, optional
        Static rollover threshold in g, in place of the computed one.

    Returns
    -------
    Share

    Examples
    --------
    >>> from yawdamp_ros.analysis.schemes import load_scheme
    >>> rtac = load_scheme("rtac")
    >>> share_of(rtac, ("load_transfer_ratio",), np.array([[0.5], [0.7], [0.8], [0.2]])).meeting
    0.5
    """
    by_name = {name: values[:, place] for place, name in enumerate(columns)}
    if srt is not None:
        by_name |= dict.fromkeys(ROLLOVER, np.full(len(values), srt))
    places = range(len(scheme.levels))
    chosen = places[-1] if level is None else scheme.level(level)
    failed = np.array([[_failed(scheme.of(name), by_name, place) for name in columns] for place in places])
    wrong = failed[chosen].T
    limited = [place for place, name in enumerate(columns) if scheme.of(name)]
    only = wrong.sum(axis=1) == 1
    return Share(
        len(values),
        float((~wrong.any(axis=1)).mean()),
        {columns[place]: float(wrong[:, place].mean()) for place in limited},
        {columns[place]: float((wrong[:, place] & only).mean()) for place in limited},
        {
            name: float((~failed[: place + 1].any(axis=1)).any(axis=0).mean())
            for place, name in enumerate(scheme.levels)
            if name
        },
        tuple(columns[place] for place in limited if np.isnan(by_name[columns[place]]).any()),
    )


def _failed(
    requirements: tuple[Requirement, ...], values: Mapping[str, FloatArray], level: int
) -> "np.ndarray[tuple[int, ...], np.dtype[np.bool_]]":
    """Return the vehicles that fail a measure; an unknown value does not fail."""
    count = len(next(iter(values.values())))
    wrong = np.zeros(count, dtype=bool)
    for each in requirements:
        limit = np.full(count, each.limits[min(level, len(each.limits) - 1)])
        if each.times:
            limit = limit * values.get(each.times, np.full(count, np.nan))
        value = values[each.measure]
        known = np.isfinite(value) & np.isfinite(limit)
        met = {"most": value <= limit, "least": value >= limit, "above": value > limit}[each.kind]
        wrong |= known & ~met
    return wrong
