"""Limits beyond which a motion has no meaning."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from yawdamp_ros.dynamics import MODELS as LINEAR_MODELS
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.simulation.settings import SimParameters
from yawdamp_ros.stepping import Sample

MEANINGLESS = "where the model means nothing"


class Limits(NamedTuple):
    """Largest magnitudes at which a run goes on.

    Attributes
    ----------
    lateral_acceleration : float
        Largest lateral acceleration of any unit [m/s^2].
    articulation : float
        Largest articulation angle of any joint [rad].

    Examples
    --------
    >>> from yawdamp_ros.simulation import Limits
    >>> Limits(lateral_acceleration=4.0, articulation=0.2).articulation
    0.2
    """

    lateral_acceleration: float
    articulation: float

    @classmethod
    def of(cls, settings: SimParameters) -> "Limits":
        """Limits of the settings."""
        return cls(settings.max_lateral_acceleration, settings.max_articulation)

    @classmethod
    def warning(cls, settings: SimParameters) -> "Limits":
        """Warning levels of the settings, at which a truck leaves the range of a linear model."""
        if settings.model not in LINEAR_MODELS:
            return cls(math.inf, math.inf)
        return cls(settings.warn_lateral_acceleration, settings.warn_articulation)


class Stop(NamedTuple):
    """Reason why a run was stopped before its end.

    Attributes
    ----------
    step : int
        First step that is not part of the run.
    key : str
        Quantity that passed its limit, or name of the event.
    where : str
        Unit, joint or wheel.
    reason : str
        Sentence for a user.

    Examples
    --------
    >>> from yawdamp_ros.simulation import Stop
    >>> Stop(step=120, key="articulation", where="truck and trailer", reason="articulation past 1 rad").key
    'articulation'
    """

    step: int
    key: str
    where: str
    reason: str


def limit_violation(
    sample: Sample, unit_names: Sequence[str], limits: Limits, consequence: str = MEANINGLESS
) -> tuple[int, Stop] | None:
    """First instant of a sample at which it exceeds a limit, and how; None if it never does.

    Parameters
    ----------
    sample : Sample
        Sample of one or more instants.
    unit_names : sequence of str
    limits : Limits
    consequence : str
        End of the reason.
    """
    if _within(sample.lateral_acceleration, limits.lateral_acceleration) and _within(
        sample.articulation, limits.articulation
    ):
        return None
    steps = np.atleast_1d(sample.step)
    parts = (sample.lateral_acceleration, sample.articulation)
    table = np.abs(np.hstack([_of_instants(part, steps) for part in parts]))
    most = [limits.lateral_acceleration] * len(unit_names) + [limits.articulation] * (len(unit_names) - 1)
    instant, column = (int(index) for index in np.argwhere(~(table <= most))[0])
    if column < len(unit_names):
        value = _of_instants(sample.lateral_acceleration, steps)[instant, column]
        key, where = "lateral_acceleration", unit_names[column]
        what = f"lateral acceleration of {where} {value:.4g} m/s^2, past {limits.lateral_acceleration:g}"
    else:
        joint = column - len(unit_names)
        value = _of_instants(sample.articulation, steps)[instant, joint]
        key, where = "articulation", f"articulation_{joint + 1}"
        what = f"{where} {value:.4g} rad, past {limits.articulation:g}"
    return instant, Stop(int(steps[instant]), key, where, f"{what}, {consequence}")


def _within(values: FloatArray, limit: float) -> bool:
    """Return whether every magnitude is within a limit; NaN is not."""
    if values.ndim == 1:  # NumPy takes longer for a few units
        return all(abs(value) <= limit for value in values.tolist())
    return bool((np.abs(values) <= limit).all())


def _of_instants(values: FloatArray, steps: npt.NDArray[np.int64]) -> FloatArray:
    return np.reshape(values, (len(steps), -1))
