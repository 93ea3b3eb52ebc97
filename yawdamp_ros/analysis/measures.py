"""The measures of a combination, with definition and speed.

`MEASURES` are those of a linear model, whole stacks of vehicles at once; `VEHICLE_MEASURES` take one vehicle
at a time, by its geometry, its powertrain or the nonlinear model. Limits are data: see `schemes`.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib import import_module
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
from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.analysis.lane_change import SAE_J2179, SAE_J2179_SPEED, LaneChangeRuns
from yawdamp_ros.analysis.speed_brackets import SPEEDS
from yawdamp_ros.analysis.steady_state import understeer_gradients
from yawdamp_ros.analysis.yaw_damping import EXCITED, PULSE_WIDTH, yaw_dampings
from yawdamp_ros.dynamics import LinearModel
from yawdamp_ros.errors import YawdampError
from yawdamp_ros.vehicle import Vehicle

PBS_DAMPING_SPEED = 80.0 / 3.6
"""In m/s."""


@dataclass(frozen=True)
class Measure:
    """One measure of lateral performance.

    Attributes
    ----------
    name : str
        Name in tables, JSON and CSV.
    unit : str
        Unit of the value; empty for a ratio.
    definition : str
        Definition of the measure, and its author.
    answers : callable
        Function from the model of a stack of vehicles to the values.
    speed : float or None
        Speed that the standard asks for [m/s]; None for the vehicle's own.

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> model = linear_model(load_vehicle("a_double"))
    >>> from yawdamp_ros.analysis import MEASURES
    >>> round(MEASURES["rearward_amplification"].value(model), 1)
    1.7
    """

    name: str
    unit: str
    definition: str
    answers: Callable[[LinearModel], Answers]
    speed: float | None = None

    def value(self, model: LinearModel) -> float | None:
        """Value for one vehicle, None where there is none.

        Raises
        ------
        AnalysisError
            If the question has no answer, as that for a lane change of an unstable vehicle.
        """
        return self.answers(stack_of(model)).only()

    def speed_for(self, vehicle: Vehicle, asked: float | None = None) -> float:
        """Speed at which a vehicle, or each of a stack, is judged [m/s]: requested, standard, or own."""
        if asked is not None:
            return asked
        return vehicle.speed if self.speed is None else self.speed


@dataclass(frozen=True)
class VehicleMeasure:
    """A measure that is taken of one vehicle at a time.

    Attributes
    ----------
    name, unit, definition : str
        Name, unit and definition, as in `Measure`.
    value_of : callable
        Value of a vehicle at a speed [m/s]; None where it does not apply, as
        the swing of trailers to a truck.
    speed : float or None
        Speed that its standard asks for [m/s]; None for the vehicle's own.
    fixed : bool
        Whether the manoeuvre has its own speed, which no request changes.
    assumes : str
        Assumptions of value and verdict that the standard, or what was readable of it, does not settle.

    Examples
    --------
    >>> from yawdamp_ros.analysis.measures import VEHICLE_MEASURES
    >>> VEHICLE_MEASURES["tail_swing"].unit
    'm'
    """

    name: str
    unit: str
    definition: str
    value_of: Callable[[Vehicle, float], float | None]
    speed: float | None = None
    fixed: bool = False
    assumes: str = ""

    def speed_for(self, vehicle: Vehicle, asked: float | None = None) -> float:
        """Speed at which a vehicle is judged [m/s]: requested, standard, or own."""
        if asked is not None and not self.fixed:
            return asked
        return vehicle.speed if self.speed is None else self.speed


def _later(module: str, function: str, *, at_speed: bool = False) -> Callable[[Vehicle, float], float | None]:
    """Value by a function of this room, which loads on first use: some need the compiled model."""

    def value(vehicle: Vehicle, speed: float) -> float | None:
        of_vehicle = getattr(import_module(f"yawdamp_ros.analysis.{module}"), function)
        try:
            found: float | None = of_vehicle(vehicle, speed) if at_speed else of_vehicle(vehicle)
        except YawdampError as error:  # the compiled model's own loads with it
            raise AnalysisError(str(error)) from error
        return found

    return value


def _in_lane_change(quantity: int) -> Callable[[LinearModel], Answers]:
    """Rearward amplification of a quantity of all units, as `LinearModel.output_names` orders them."""

    def answers(model: LinearModel) -> Answers:
        units, runs = len(model.vehicle.units), LaneChangeRuns(model)
        ends = quantity * units, (quantity + 1) * units - 1
        found = rearward_amplifications(runs.outputs(ends).transpose(0, 2, 1))
        found.values[list(runs.reasons)] = np.nan
        return Answers(found.values, {**found.reasons, **runs.reasons})

    return answers


def _over_steer_axle(model: LinearModel) -> Answers:
    """Rearward amplification over the steer axle, whose acceleration the lane change prescribes."""
    last, runs = 3 * len(model.vehicle.units) - 1, LaneChangeRuns(model)
    values = np.abs(runs.outputs([last])[:, 0]).max(axis=1) / SAE_J2179.amplitude
    values[list(runs.reasons)] = np.nan
    return Answers(values, runs.reasons)


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
    ),
    Measure(
        "yaw_damping_coefficient",
        "",
        "lowest damping ratio of what swings in the last unit's yaw rate after a steering pulse of "
        f"{PULSE_WIDTH:g} s, which the mean ratio of successive same-sign peaks (PBS) tells where one mode "
        f"swings alone; modes from {100.0 * EXCITED:g} % of the largest swing on count",
        yaw_dampings,
        PBS_DAMPING_SPEED,
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
    ),
    Measure(
        "rearward_amplification_steer_axle",
        "",
        f"largest lateral acceleration of the last unit over that of the steer axle, {_J2179}",
        _over_steer_axle,
        SAE_J2179_SPEED,
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
    ),
    Measure(
        "steady_offtracking",
        "m",
        "radius of the last axle's path less that of the steer axle's on a steady curve of "
        f"{offtracking.STEADY_RADIUS:g} m; positive: outside",
        offtracking.steady_offtrackings,
    ),
)

_TURN = (
    "in a turn of 90 degrees at walking speed, the outer wall of the outer front tyre on a radius of 12.5 m "
    "(PBS); units on their tractrices"
)
_LOW_SPEED = 5.0 / 3.6
_STEADY_ROLL = (
    "highest lateral acceleration of a steady turn in which the static roll of the nonlinear model finds an "
    "equilibrium: springs, lifting wheels, hitches that couple roll (PBS)"
)

_AT_REST = "its forces at the driven wheels, limited by friction under the driven axles at rest (PBS)"

_OF_VEHICLES = (
    VehicleMeasure(
        "startability",
        "%",
        f"steepest grade on which the vehicle starts, by start_force: {_AT_REST}",
        _later("traction", "startability"),
        0.0,
        fixed=True,
    ),
    VehicleMeasure(
        "gradeability",
        "%",
        f"steepest grade on which the vehicle keeps moving, by drive_force: {_AT_REST}",
        _later("traction", "gradeability"),
        0.0,
        fixed=True,
    ),
    VehicleMeasure(
        "gradeability_speed",
        "km/h",
        f"highest speed on a grade of 1 %, by drive_power and drive_force: {_AT_REST}",
        _later("traction", "gradeability_speed"),
        0.0,
        fixed=True,
    ),
    VehicleMeasure(
        "acceleration_capability",
        "s",
        "time for the first 100 m from rest, gears changed in no time, by drive_power and drive_force: "
        f"{_AT_REST}",
        _later("traction", "acceleration_capability"),
        0.0,
        fixed=True,
    ),
    VehicleMeasure(
        "low_speed_swept_path",
        "m",
        f"largest width swept across the path of the guided tyre {_TURN}",
        _later("swept_path", "low_speed_swept_path"),
        _LOW_SPEED,
        fixed=True,
    ),
    VehicleMeasure(
        "frontal_swing",
        "m",
        f"how far the lead unit's front corner swings out of the path of the guided tyre {_TURN}",
        _later("swept_path", "frontal_swing"),
        _LOW_SPEED,
        fixed=True,
    ),
    VehicleMeasure(
        "frontal_swing_maximum_of_differences",
        "m",
        "by how much a trailer's front corner swings out further than that of the unit ahead at one place "
        f"{_TURN}",
        _later("swept_path", "frontal_swing_maximum_of_differences"),
        _LOW_SPEED,
        fixed=True,
    ),
    VehicleMeasure(
        "frontal_swing_difference_of_maxima",
        "m",
        "by how much a trailer's front corner swings out further than that of the unit ahead, at most "
        f"{_TURN}",
        _later("swept_path", "frontal_swing_difference_of_maxima"),
        _LOW_SPEED,
        fixed=True,
    ),
    VehicleMeasure(
        "tail_swing",
        "m",
        f"how far a rear corner swings out of the straight way that it came {_TURN}",
        _later("swept_path", "tail_swing"),
        _LOW_SPEED,
        fixed=True,
    ),
    VehicleMeasure(
        "static_rollover_threshold",
        "g",
        f"{_STEADY_ROLL}; of the units that roll over first",
        _later("rollover", "static_rollover_threshold"),
        0.0,
        fixed=True,
    ),
    VehicleMeasure(
        "rear_static_rollover_threshold",
        "g",
        f"{_STEADY_ROLL}; of the last units that roll together",
        _later("rollover", "rear_static_rollover_threshold"),
        0.0,
        fixed=True,
    ),
    VehicleMeasure(
        "steer_tyre_friction_demand",
        "%",
        "largest share of the road's friction that the steered tyres use, by the nonlinear model at 5 km/h "
        "in the turn of low_speed_swept_path (PBS)",
        _later("driven", "steer_tyre_friction_demand"),
        _LOW_SPEED,
        fixed=True,
    ),
    VehicleMeasure(
        "load_transfer_ratio",
        "",
        "largest load of the right wheels less that of the left over both, by the nonlinear model, of units "
        f"that roll together, steered axles of the lead unit left out (RTAC); {_J2179}",
        _later("driven", "load_transfer_ratio", at_speed=True),
        SAE_J2179_SPEED,
    ),
    VehicleMeasure(
        "tracking_ability_on_a_straight_path",
        "m",
        "width that the bodies sweep at 90 km/h on a straight road of 1 km, 99th percentile: crossfall 3 %, "
        "both wheel tracks of a roughness index (IRI) of 3.8 m/km, the nonlinear model linearised about its "
        "steady motion there (PBS)",
        _later("tracking", "tracking_ability_on_a_straight_path", at_speed=True),
        90.0 / 3.6,
        assumes="the driver aims the steered axle at its line 1 s ahead and adds nothing of his own; axles "
        "have no roll steer; an isotropic road of ISO 8608's spectrum",
    ),
    VehicleMeasure(
        "directional_stability_under_braking",
        "m",
        "width that the bodies sweep in a stop from 60 km/h by all brakes, friction 0.5 on the left and 0.25 "
        "on the right, a driver keeping the steered axle on its line; by the nonlinear model (PBS)",
        _later("driven", "directional_stability_under_braking", at_speed=True),
        60.0 / 3.6,
        assumes="the driver is ideal; the friction of the road and, for the limit, the lane",
    ),
)

MEASURES: Mapping[str, Measure] = MappingProxyType({measure.name: measure for measure in _ALL})
"""Every measure of a linear model by its name."""
VEHICLE_MEASURES: Mapping[str, VehicleMeasure] = MappingProxyType(
    {measure.name: measure for measure in _OF_VEHICLES}
)
"""Every measure of a single vehicle by its name."""
ALL_MEASURES: Mapping[str, Measure | VehicleMeasure] = MappingProxyType({**MEASURES, **VEHICLE_MEASURES})

NONLINEAR = "nonlinear"
"""Name of the model for measures besides the linear ones."""
NONLINEAR_MEASURES = (
    "least_damping_ratio",
    "yaw_damping_coefficient",
    "understeer_gradient",
    "rearward_amplification",
    "rearward_amplification_steer_axle",
    "rearward_amplification_yaw_rate",
    "high_speed_transient_offtracking",
    "steady_offtracking",
)
"""Names of the measures that the nonlinear model has; the others are defined for a linear one."""
