"""Static rollover thresholds, by the static roll of the nonlinear model."""

from functools import lru_cache

from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.nonlinear import NonlinearError
from yawdamp_ros.nonlinear.static_roll import RollGroup, static_rollover
from yawdamp_ros.vehicle import Vehicle


def static_rollover_threshold(vehicle: Vehicle) -> float:
    """Static rollover threshold of the group of units that rolls over first [g].

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    float

    Raises
    ------
    AnalysisError
        If no equilibrium is found.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> 0.3 < static_rollover_threshold(load_vehicle("interlink")) < 0.5
    True
    """
    return min(group.threshold for group in _groups(vehicle))


def rear_static_rollover_threshold(vehicle: Vehicle) -> float:
    """Static rollover threshold of the last group of units that roll together [g].

    Parameters
    ----------
    vehicle : Vehicle
        As for `static_rollover_threshold`.

    Returns
    -------
    float

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> nordic = load_vehicle("nordic_combination")
    >>> rear_static_rollover_threshold(nordic) == static_rollover_threshold(nordic)
    True
    """
    return _groups(vehicle)[-1].threshold


@lru_cache(maxsize=256)
def _groups(vehicle: Vehicle) -> tuple[RollGroup, ...]:
    try:
        return static_rollover(vehicle)
    except NonlinearError as error:
        raise AnalysisError(str(error)) from error
