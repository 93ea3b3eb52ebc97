"""Measures by the nonlinear model, each at the manoeuvre of its standard."""

from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np

from yawdamp_ros.analysis.amplification import rearward_amplification
from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.analysis.lane_change import steer_axle_position
from yawdamp_ros.analysis.measures import MEASURES
from yawdamp_ros.analysis.nonlinear_runs import GRID, Run, drive, drive_lane_change
from yawdamp_ros.analysis.offtracking import STEADY_RADIUS, high_speed_transient_offtracking
from yawdamp_ros.analysis.severity import severity
from yawdamp_ros.analysis.yaw_damping import PULSE_WIDTH, damping_of_peaks
from yawdamp_ros.manoeuvres import Pulse
from yawdamp_ros.nonlinear import NonlinearDynamics, NonlinearError, steady_turn
from yawdamp_ros.stepping import Response
from yawdamp_ros.vehicle import STANDARD_GRAVITY, Vehicle

PULSE_ANGLE = 0.05
"""Steer angle of the pulse [rad]: some 0.3 g of a laden combination at 80 km/h."""
DECAY = 12.0
"""Seconds of the decay that follows it."""
UNDERSTEER_AT = 0.1 * STANDARD_GRAVITY
"""Lateral acceleration up to which the understeer gradient is the mean slope [m/s^2]."""


def nonlinear_measure(name: str, vehicle: Vehicle, speed: float | None = None) -> float:
    """Value of a measure by the nonlinear model.

    The lane change is steered as the linear model says that the path takes it; amplification compares units
    of the same run, and so does offtracking.

    Parameters
    ----------
    name : str
        One of `yawdamp_ros.analysis.measures.NONLINEAR_MEASURES`.
    vehicle : Vehicle
    speed : float, optional
        Speed [m/s]; the default is the measure's own, else the vehicle's.

    Returns
    -------
    float

    Raises
    ------
    AnalysisError
        If the manoeuvre ends in a rollover or cannot be driven.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> 1.0 < nonlinear_measure("rearward_amplification", load_vehicle("interlink")) < 1.5
    True
    """
    chosen = MEASURES[name].speed_for(vehicle, speed)
    try:
        return _VALUES[name](vehicle, chosen)
    except NonlinearError as error:
        raise AnalysisError(str(error)) from error


def _response(vehicle: Vehicle, run: Run) -> Response:
    """Motion of a run that no rollover ends."""
    if run.rolled_over:
        message = f"{vehicle.name}: rollover of {run.rolled_over} at {run.time[-1]:.2f} s"
        raise AnalysisError(message)
    outputs = run.outputs
    return Response(
        unit_names=vehicle.unit_names,
        time=run.time,
        steering_angle=run.steering,
        yaw=outputs.yaw,
        yaw_rate=outputs.yaw_rate,
        lateral_acceleration=outputs.acceleration[..., 1],
        articulation=outputs.articulation,
        x=outputs.position[..., 0],
        y=outputs.position[..., 1],
    )


def _lane_change(vehicle: Vehicle, speed: float) -> Response:
    return _response(vehicle, drive_lane_change(vehicle, speed))


def _amplification(vehicle: Vehicle, speed: float) -> float:
    return rearward_amplification(_lane_change(vehicle, speed).lateral_acceleration)


def _amplification_over_steer_axle(vehicle: Vehicle, speed: float) -> float:
    response = _lane_change(vehicle, speed)
    turning = np.gradient(response.yaw_rate[:, 0], response.time)
    axle = response.lateral_acceleration[:, 0] + steer_axle_position(vehicle) * turning
    return rearward_amplification(np.column_stack([axle, response.lateral_acceleration[:, -1]]))


def _yaw_rate_amplification(vehicle: Vehicle, speed: float) -> float:
    return rearward_amplification(_lane_change(vehicle, speed).yaw_rate)


def _offtracking(vehicle: Vehicle, speed: float) -> float:
    return high_speed_transient_offtracking(vehicle, _lane_change(vehicle, speed))


def _yaw_damping(vehicle: Vehicle, speed: float) -> float:
    pulse = Pulse(PULSE_ANGLE, start=0.0, width=PULSE_WIDTH)
    steps = GRID.samples_in(PULSE_WIDTH + DECAY) * GRID.steps_per_sample
    times = GRID.seconds(np.arange(steps + 1))
    run = drive(vehicle, speed, np.array([pulse(time) for time in times.tolist()]))
    response = _response(vehicle, run)
    return float(damping_of_peaks(response.yaw_rate[response.time > PULSE_WIDTH, -1]))


def _least_damping_ratio(vehicle: Vehicle, speed: float) -> float:
    return float(severity(vehicle, 0.0, speed=speed).least_damping_ratio[0])


def _understeer(vehicle: Vehicle, speed: float) -> float:
    found = severity(vehicle, UNDERSTEER_AT, speed=speed, turns=2)
    return float(np.diff(found.handling[:, 0])[0] / np.diff(found.lateral_acceleration)[0])


def _steady_offtracking(vehicle: Vehicle, speed: float) -> float:
    dynamics = NonlinearDynamics(vehicle)
    turn = steady_turn(dynamics, speed, dynamics.inputs(), lateral_acceleration=speed**2 / STEADY_RADIUS)
    last = len(vehicle.units) - 1
    position = min(axle.position for axle in vehicle.units[last].axles)
    yaw_rate = float(turn.outputs.yaw_rate[0, 0])

    def radius(unit: int, place: float) -> float:
        forward, sideways = turn.outputs.velocity[0, unit]
        return float(np.hypot(forward, sideways + place * yaw_rate)) / yaw_rate

    return radius(last, position) - radius(0, steer_axle_position(vehicle))


_VALUES: Mapping[str, Callable[[Vehicle, float], float]] = MappingProxyType(
    {
        "least_damping_ratio": _least_damping_ratio,
        "yaw_damping_coefficient": _yaw_damping,
        "understeer_gradient": _understeer,
        "rearward_amplification": _amplification,
        "rearward_amplification_steer_axle": _amplification_over_steer_axle,
        "rearward_amplification_yaw_rate": _yaw_rate_amplification,
        "high_speed_transient_offtracking": _offtracking,
        "steady_offtracking": _steady_offtracking,
    }
)
