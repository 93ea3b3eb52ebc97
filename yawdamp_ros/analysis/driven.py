"""Measures from driven runs of the nonlinear model: tyres slide, wheels lift, brakes lock."""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from yawdamp_ros.analysis.bodies import lateral_positions
from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.analysis.lane_change import steer_axle_position
from yawdamp_ros.analysis.nonlinear_runs import Run, drive_lane_change
from yawdamp_ros.analysis.swept_path import along_guide
from yawdamp_ros.analysis.tractrix import low_speed_turn
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.nonlinear import NonlinearDynamics, Outputs, Settings
from yawdamp_ros.nonlinear.layout import STEERING
from yawdamp_ros.nonlinear.static_roll import roll_groups
from yawdamp_ros.vehicle import Vehicle, complete

STEP = 0.001
"""Time step of the motion [s]."""
EVERY = 20
"""Steps between samples; the driver looks at the road as often."""
APPROACH = 3.0
"""Straight way before a turn [m]."""
GAIN = 0.5
"""Driver's change of direction for a distance from the path [rad/m]."""
SPLIT_FRICTION = (0.5, 0.25)
"""Friction left and right: at least 0.5, and half of that (UN R13, annex 13)."""
HARD_BRAKING = 5.0
"""Deceleration demanded, the service brake's of UN R13 [m/s^2]."""
LONGEST_STOP = 30.0
"""In s."""
LOW_SPEED = 5.0 / 3.6
"""Speed of the low-speed turn [m/s]."""
FREE = 1e-3
"""Cornering stiffness of a castering axle [N/rad]."""
WALKING = 1.0
"""Speed at which a stop counts as done [m/s]."""


def steer_tyre_friction_demand(vehicle: Vehicle) -> float:
    """Largest share of the road's friction that the steered tyres use in the low-speed turn [%].

    A driver leads the outer front tyre along the path of `low_speed_turn` at 5 km/h; axles that do not steer
    resist the turn by the slip of their tyres. The wheels of an axle stand in its middle: both steered wheels
    have one angle in the model and would push against each other. Slip does not lag: what damps a carcass at
    rest would add to it at this speed.

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    float

    Raises
    ------
    AnalysisError
        If the vehicle cannot turn so.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> 0.0 < steer_tyre_friction_demand(load_vehicle("single_vehicle")) < 100.0
    True
    """
    return float(friction_use(vehicle)[1].max())


def friction_use(vehicle: Vehicle) -> tuple[FloatArray, FloatArray]:
    """Share of the road's friction that the steered tyres use along the low-speed turn.

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    way, share : ndarray, shape (m,)
        Way of the guided tyre from the beginning of the arc [m], and the share [%].

    Raises
    ------
    AnalysisError
        If the vehicle cannot turn so.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> way, share = friction_use(load_vehicle("single_vehicle"))
    >>> bool(way[0] < 0.0 < way[-1])
    True
    """
    turn, speed = low_speed_turn(vehicle), LOW_SPEED
    dynamics = NonlinearDynamics(
        _castering(vehicle), Settings(track=False, roll=False, load_shift=False, relaxation=False)
    )
    lead, place = turn.geometry[0], steer_axle_position(vehicle)
    arm = complex(place, -lead.guide)

    def steering(position: complex, yaw: float) -> float:
        point = position + arm * complex(math.cos(yaw), math.sin(yaw))
        way, inwards = along_guide(turn, np.array([point.real]), np.array([point.imag]))
        turned = min(max(float(way[0]) / turn.radius, 0.0), turn.angle)
        aim = turned - math.atan(GAIN * float(inwards[0])) - yaw
        rate = math.sin(aim) / lead.leader
        return math.atan2(lead.leader * rate, math.cos(aim) - lead.guide * rate)

    state = dynamics.initial_state(speed)
    state[0], state[1] = -APPROACH - place, lead.guide
    length = APPROACH + turn.radius * turn.angle + sum(unit.leader for unit in turn.geometry)
    gains = np.array([axle.low_speed_steering for unit in vehicle.units for axle in unit.axles])
    inputs = dynamics.inputs(speed=speed)
    out = _driven(dynamics, state, inputs, steering, length / speed, gains=gains)
    steered = [
        wheel
        for number, axle in enumerate(vehicle.units[0].axles)
        if axle.steered
        for wheel in (2 * number, 2 * number + 1)
    ]
    force = np.hypot(out.longitudinal_force[:, steered], out.lateral_force[:, steered]).sum(axis=1)
    load = out.wheel_load[:, steered].sum(axis=1)
    point = out.position[:, 0, 0] + 1j * out.position[:, 0, 1] + arm * np.exp(1j * out.yaw[:, 0])
    way, _ = along_guide(turn, point.real, point.imag)
    return way, 100.0 * force / load / (complete(vehicle).friction or 1.0)


def load_transfer_ratio(vehicle: Vehicle, speed: float) -> float:
    """Largest load transfer ratio in the lane change of SAE J2179.

    Loads of the right wheels less those of the left, over both, of the units that roll together; the steered
    axles of the lead unit do not count (RTAC, read in secondary sources). The steering is that which the path
    takes of the linear model.

    Parameters
    ----------
    vehicle : Vehicle
    speed : float
        Speed [m/s].

    Returns
    -------
    float
        1 where all wheels of one side lift.

    Raises
    ------
    AnalysisError
        If no steering leads the linear model through the lane change.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> 0.0 < load_transfer_ratio(load_vehicle("single_vehicle"), 24.0) < 0.3
    True
    """
    run = drive_lane_change(vehicle, speed)
    if run.rolled_over:
        return 1.0
    return max(float(ratio.max()) for ratio in load_transfers(vehicle, run).values())


def load_transfers(vehicle: Vehicle, run: Run) -> dict[str, FloatArray]:
    """Load transfer ratios of the units that roll together, over a run.

    Parameters
    ----------
    vehicle : Vehicle
    run : Run
        Run of m samples.

    Returns
    -------
    dict of str to ndarray, shape (m,)
        Ratios, 0 to 1, by the names of the units; without units that have steered axles alone.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> vehicle = load_vehicle("a_double")
    >>> list(load_transfers(vehicle, drive_lane_change(vehicle, 20.0)))
    ['tractor + semitrailer_1', 'dolly + semitrailer_2']
    """
    loads = run.outputs.wheel_load
    left, right = loads[:, 0::2], loads[:, 1::2]
    units = [unit for unit in range(len(vehicle.units)) for _ in vehicle.units[unit].axles]
    steered = [axle.steered for unit in vehicle.units for axle in unit.axles]
    found = {}
    for group in roll_groups(vehicle):
        own = [
            number
            for number, unit in enumerate(units)
            if unit in group and not (steered[number] and unit == 0)
        ]
        if own:
            moved, carried = (part[:, own].sum(axis=1) for part in (right - left, right + left))
            found[" + ".join(vehicle.unit_names[unit] for unit in group)] = np.abs(moved) / carried
    return found


def directional_stability_under_braking(vehicle: Vehicle, speed: float) -> float:
    """Width that the bodies sweep in a stop on a road whose sides differ in friction [m].

    A driver keeps the steered axle on a straight line; the demand on all brakes is 5 m/s^2. Friction is 0.5
    on the left and 0.25 on the right.

    Parameters
    ----------
    vehicle : Vehicle
    speed : float
        Speed at which braking begins [m/s].

    Returns
    -------
    float

    Raises
    ------
    AnalysisError
        If the vehicle rolls over or does not stop.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> directional_stability_under_braking(load_vehicle("interlink"), 60.0 / 3.6) < 3.0
    True
    """
    return float(np.ptp(lateral_positions(vehicle, stop_on_split_friction(vehicle, speed), 0.0)))


def stop_on_split_friction(vehicle: Vehicle, speed: float) -> Outputs:
    """Drive the stop of `directional_stability_under_braking`.

    Parameters
    ----------
    vehicle : Vehicle
    speed : float
        Speed at which braking begins [m/s].

    Returns
    -------
    Outputs
        From the beginning of braking to the stop.

    Raises
    ------
    AnalysisError
        If the vehicle rolls over or does not stop.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> stop = stop_on_split_friction(load_vehicle("single_vehicle"), 10.0)
    >>> bool(stop.velocity[-1, 0, 0] <= WALKING)
    True
    """
    dynamics = NonlinearDynamics(vehicle)
    place = steer_axle_position(vehicle)

    def steering(position: complex, yaw: float) -> float:
        aside = position.imag + place * math.sin(yaw)
        return -yaw - math.atan(GAIN * aside)

    inputs = dynamics.inputs(acceleration=-HARD_BRAKING, friction=SPLIT_FRICTION)
    stop = _driven(dynamics, dynamics.initial_state(speed), inputs, steering, LONGEST_STOP, WALKING)
    if stop.velocity[-1, 0, 0] > WALKING:
        message = f"{vehicle.name}: does not stop within {LONGEST_STOP:g} s"
        raise AnalysisError(message)
    return stop


def _castering(vehicle: Vehicle) -> Vehicle:
    """Vehicle whose self-steering axles take no lateral force."""
    units = [
        replace(
            unit,
            axles=tuple(
                replace(axle, cornering_stiffness=FREE, tyres=None, tyre="linear")
                if axle.self_steering
                else axle
                for axle in unit.axles
            ),
        )
        for unit in vehicle.units
    ]
    return replace(vehicle, units=tuple(units))


def _driven(  # noqa: PLR0913, PLR0917 - the whole of one run
    dynamics: NonlinearDynamics,
    state: FloatArray,
    inputs: FloatArray,
    steering: Callable[[complex, float], float],
    duration: float,
    slowest: float = -1.0,
    gains: FloatArray | None = None,
) -> Outputs:
    """Drive for a time, or until the speed is low, steering by position and yaw of the lead unit.

    Axles steer against the articulation of their unit's front hitch by gains, if there are any.
    """
    gained = [unit for unit, each in enumerate(dynamics.vehicle.units) for _ in each.axles]
    row, layout = inputs.copy(), dynamics.layout
    states: list[FloatArray] = []
    rows: list[FloatArray] = []
    while len(states) * EVERY * STEP < duration and state[dynamics.layout.velocity.start] > slowest:
        row[STEERING] = steering(complex(state[0], state[1]), float(state[2]))
        if gains is not None:
            articulation = np.concatenate([[0.0], state[layout.articulation]])
            row[dynamics.input_layout.axle_steering] = -gains * articulation[gained]
        taken = dynamics.steps(state, row, STEP, EVERY, EVERY)
        if taken.rolled_over:
            message = f"{dynamics.vehicle.name}: {taken.rolled_over} rolls over"
            raise AnalysisError(message)
        state = taken.states[-1]
        states.append(state)
        rows.append(row.copy())
    return dynamics.outputs(np.array(states), np.array(rows))
