"""The measures that a combination is judged by: what each is, at which speed, against which level.

The levels are those of the Australian Performance-Based Standards scheme (PBS; the South African pilot has
the same) and of the Canadian RTAC study. All were read in secondary sources, none in the standard itself.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from yawdamp_ros.analysis import boundaries, offtracking
from yawdamp_ros.analysis.amplification import (
    FREQUENCIES,
    peak_amplifications,
    rearward_amplifications,
)
from yawdamp_ros.analysis.answers import Answers, stack_of
from yawdamp_ros.analysis.eigenmodes import least_damping_ratios
from yawdamp_ros.analysis.lane_change import SAE_J2179, SAE_J2179_SPEED, LaneChangeRuns
from yawdamp_ros.analysis.speed_brackets import SPEEDS
from yawdamp_ros.analysis.steady_state import understeer_gradients
from yawdamp_ros.analysis.yaw_damping import EXCITED, PULSE_WIDTH, yaw_dampings
from yawdamp_ros.dynamics import LinearModel
from yawdamp_ros.vehicle import Vehicle

PBS_DAMPING_SPEED = 80.0 / 3.6
"""In m/s."""


@dataclass(frozen=True)
class Level:
    """What a standard asks of a measure.

    Attributes
    ----------
    text : str
        As tables show it.
    limit : float
        In the measure's unit, or per g of static rollover threshold.
    kind : str
        ``least`` and ``above`` bound the value from below, ``most`` from above.
    per_srt : bool
        Whether the limit is times the static rollover threshold of the rear roll-coupled unit.
    """

    text: str
    limit: float
    kind: str = "most"
    per_srt: bool = False

    def met(self, value: float, srt: float | None) -> bool | None:
        """Whether a value meets the level; None where that takes a threshold in g that is not given."""
        if self.per_srt and srt is None:
            return None
        limit = self.limit * (srt or 1.0) if self.per_srt else self.limit
        return {"least": value >= limit, "above": value > limit, "most": value <= limit}[self.kind]


@dataclass(frozen=True)
class Measure:
    """One measure of lateral performance.

    Attributes
    ----------
    name : str
        In tables, JSON and CSV.
    unit : str
        Empty for a ratio.
    definition : str
        What is computed, and whose measure it is.
    answers : callable
        Its values for the model of a stack of vehicles.
    speed : float or None
        That its standard asks for, in m/s; None: the vehicle's own.
    levels : tuple of Level
    """

    name: str
    unit: str
    definition: str
    answers: Callable[[LinearModel], Answers]
    speed: float | None = None
    levels: tuple[Level, ...] = ()

    def value(self, model: LinearModel) -> float | None:
        """Value for one vehicle, None where there is none.

        Raises
        ------
        AnalysisError
            If the question has no answer, as that for a lane change of an unstable vehicle.
        """
        return self.answers(stack_of(model)).only()

    def speed_for(self, vehicle: Vehicle, asked: float | None = None) -> float:
        """Speed at which a vehicle, or each of a stack, is judged [m/s]: asked for, standard, or own."""
        if asked is not None:
            return asked
        return vehicle.speed if self.speed is None else self.speed


def _in_lane_change(quantity: int) -> Callable[[LinearModel], Answers]:
    """Rearward amplification of a quantity of all units, as `LinearModel.output_names` orders them."""

    def answers(model: LinearModel) -> Answers:
        units, runs = len(model.vehicle.units), LaneChangeRuns(model)
        ends = quantity * units, (quantity + 1) * units - 1
        found = rearward_amplifications(runs.outputs(ends).transpose(0, 2, 1))
        found.values[list(runs.reasons)] = np.nan
        return Answers(found.values, {**found.reasons, **runs.reasons})

    return answers


_J2179 = (
    "in the single lane change of SAE J2179 and ISO 14791, the steer axle's lateral acceleration one sine "
    f"period of {SAE_J2179.amplitude:.4g} m/s2 at {SAE_J2179.frequency:g} Hz"
)
_LOWEST, _HIGHEST = SPEEDS

_ALL = (
    Measure(
        "least_damping_ratio",
        "",
        "smallest -Re/abs of the eigenvalues of the state matrix",
        least_damping_ratios,
        levels=(Level("> 0 (stable)", 0.0, "above"),),
    ),
    Measure(
        "yaw_damping_coefficient",
        "",
        "lowest damping ratio of what swings in the last unit's yaw rate after a steering pulse of "
        f"{PULSE_WIDTH:g} s, which the mean ratio of successive same-sign peaks (PBS) tells where one mode "
        f"swings alone; modes from {100.0 * EXCITED:g} % of the largest swing on count",
        yaw_dampings,
        PBS_DAMPING_SPEED,
        (Level("PBS: >= 0.15", 0.15, "least"),),
    ),
    Measure(
        "understeer_gradient",
        "rad/(m/s2)",
        "steer angle per lateral acceleration in a steady turn, beyond the Ackermann angle; "
        "positive is understeer",
        understeer_gradients,
    ),
    Measure(
        "critical_speed",
        "m/s",
        f"lowest speed from {_LOWEST:g} to {_HIGHEST:g} m/s at which an eigenvalue crosses into Re > 0",
        boundaries.critical_speeds,
    ),
    Measure(
        "rearward_amplification",
        "",
        f"largest lateral acceleration of the last unit over that of the first, {_J2179}",
        _in_lane_change(2),
        SAE_J2179_SPEED,
        (Level("PBS: <= 5.7 SRT/g", 5.7, per_srt=True), Level("RTAC: <= 2.2", 2.2)),
    ),
    Measure(
        "rearward_amplification_yaw_rate",
        "",
        f"largest yaw rate of the last unit over that of the first, {_J2179}",
        _in_lane_change(1),
        SAE_J2179_SPEED,
    ),
    Measure(
        "rearward_amplification_peak_gain",
        "",
        "largest ratio of lateral accelerations, last unit over first, in steady sine steering up to "
        f"{FREQUENCIES[-1]:g} Hz (ISO 14791)",
        lambda model: peak_amplifications(model)[0],
    ),
    Measure(
        "rearward_amplification_peak_frequency",
        "Hz",
        "where that largest ratio is reached",
        lambda model: peak_amplifications(model)[1],
    ),
    Measure(
        "high_speed_transient_offtracking",
        "m",
        f"largest lateral distance between the paths of the last axle and of the steer axle {_J2179}",
        offtracking.lane_change_offtrackings,
        SAE_J2179_SPEED,
        (
            Level("PBS: <= 0.6, 0.8, 1.0, 1.2 for levels 1 to 4", 1.2),
            Level("RTAC: <= 0.8", 0.8),
        ),
    ),
    Measure(
        "steady_offtracking",
        "m",
        "radius of the last axle's path less that of the steer axle's on a steady curve of "
        f"{offtracking.STEADY_RADIUS:g} m; positive: outside",
        offtracking.steady_offtrackings,
    ),
)

MEASURES: Mapping[str, Measure] = MappingProxyType({measure.name: measure for measure in _ALL})
"""Every measure by its name."""

NONLINEAR = "nonlinear"
"""Name of the model that measures can be taken by besides the linear ones."""
NONLINEAR_MEASURES = (
    "least_damping_ratio",
    "yaw_damping_coefficient",
    "understeer_gradient",
    "rearward_amplification",
    "rearward_amplification_yaw_rate",
    "high_speed_transient_offtracking",
    "steady_offtracking",
)
"""Names of the measures that the nonlinear model has; the others are defined for a linear one."""
