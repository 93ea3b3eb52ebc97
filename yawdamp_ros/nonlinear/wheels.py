"""Forces of the wheels: contact velocity, slip, load, friction."""

import math

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.nonlinear.compiled import compiled
from yawdamp_ros.nonlinear.layout import (
    ACCELERATION,
    AXLE_STEERING,
    FRICTION_LEFT,
    GEAR,
    SPEED,
    STEERING,
    roll_index,
    speed_index,
)
from yawdamp_ros.nonlinear.records import (
    BRAKE_LIMIT,
    BRAKE_SHARE,
    CONTACT_X,
    CONTACT_Y,
    DRIVE_SHARE,
    FORCE_X,
    FORCE_Y,
    GRIP,
    HALF_TRACK,
    HIGHEST_DEMAND,
    LATERAL_FORCE,
    LOAD,
    LONGITUDINAL_FORCE,
    LOWEST_DEMAND,
    NOMINAL_FRICTION,
    POSITION,
    RELAXATION_LENGTH,
    ROLL_AXIS_HEIGHT,
    ROLL_DAMPING,
    ROLL_MOMENT,
    ROLL_STIFFNESS,
    ROLLING_RESISTANCE,
    SLIDE,
    SLIP,
    SPEED_GAIN,
    STEERED,
    STIFFNESS_RATE,
    STIFFNESS_SLOPE,
    TOTAL_MASS,
    TYRE_MODEL,
    TYRES,
    UNIT_BRAKE_SHARE,
    VELOCITY_X,
    VELOCITY_Y,
    WITH_ROLL,
    YAW_MOMENT,
    Parameters,
    Work,
)
from yawdamp_ros.nonlinear.tyre_laws import LIFTED, lateral_force, longitudinal_limit

LOWEST_ROLLING_SPEED = 0.1
"""Speed below which a slip without relaxation length grows no more by slowing down [m/s]."""
LARGEST_SLIP = 1.0
"""Largest lateral slip that a carcass holds, 45 degrees: every tyre slides there."""
STANDSTILL = 2.5
"""Speed above which the carcass has no damping of its own [m/s]; Pacejka (2012), section 8.6."""
CARCASS_DAMPING = 0.1
"""Time by which the carcass leads at rest [s]; damps the vehicle on its tyres."""
CARCASS_TRAVEL = 0.05
"""Longitudinal deflection at which a braked wheel begins to turn or to slide [m]."""
BRAKE_SPEED = 1.0
"""Speed above which that deflection follows in time, not in distance [m/s]."""
SLIDING_SPEED = 0.1
"""Speed below which a locked wheel is held by its carcass [m/s]."""
LOCKING = 0.05
"""Excess of the brake force over friction at which a wheel slides wholly."""
MOST_BRAKE = 2.0
"""Brake force over friction beyond which more makes no difference."""


@compiled
def driving_force(state: FloatArray, inputs: FloatArray, p: Parameters) -> float:
    """Force demanded of the driven axles [N]; negative in reverse and from the speed controller."""
    unit_table, scalars = p.units, p.scalars
    demand = inputs[GEAR] * max(inputs[ACCELERATION], 0.0)
    if not math.isnan(inputs[SPEED]):
        control = scalars[SPEED_GAIN] * (inputs[SPEED] - state[speed_index(unit_table.shape[0])])
        demand += min(max(control, scalars[LOWEST_DEMAND]), scalars[HIGHEST_DEMAND])
    return float(scalars[TOTAL_MASS] * demand)


@compiled
def standstill(speed: float) -> float:
    """Weight of what acts near rest only, 1 at rest and 0 from `STANDSTILL` on."""
    if abs(speed) >= STANDSTILL:
        return 0.0
    return 0.5 + 0.5 * math.cos(math.pi * speed / STANDSTILL)


@compiled
def contact(
    vx: float, vy: float, sigma: float, held: float, deflection: float
) -> tuple[float, float, float, float]:
    """Slip and grip of one wheel, and the rates of its two deflections.

    Across, the slip s of a rolling wheel follows ``sigma s' + abs(vx) s = -vy`` (Bernard and Clover, SAE
    950311, 1995), which holds at rest; there the carcass is damped, too (Pacejka 2012, section 8.6). Along,
    the deflection of a braked wheel grows with travel up to the brake force (Dahl 1968), which holds a
    vehicle on a grade.

    Parameters
    ----------
    vx, vy : float
        Velocity in the wheel's frame [m/s].
    sigma : float
        Relaxation length [m].
    held, deflection : float
        Lateral slip and deflection of the carcass in the state.
    """
    rest = standstill(vx)
    if sigma > 0.0:
        slip = held - CARCASS_DAMPING * rest * vy / sigma
        slip_rate = -(vy + max(abs(vx), abs(vy) / LARGEST_SLIP) * held) / sigma
    else:
        slip = -vy / max(abs(vx), LOWEST_ROLLING_SPEED)
        slip_rate = 0.0
    crawl = min(max(vx, -BRAKE_SPEED), BRAKE_SPEED)
    deflection_rate = -(crawl + abs(crawl) * deflection) / CARCASS_TRAVEL
    grip = deflection - CARCASS_DAMPING * rest * vx / CARCASS_TRAVEL
    return slip, min(max(grip, -1.0), 1.0), slip_rate, deflection_rate


@compiled
def wheel_force(
    lateral: float, limit: float, drive: float, brake: float, grip: float, vx: float, vy: float
) -> tuple[float, float, float]:
    """Longitudinal and lateral force of one wheel in its own frame, and the share by which it slides.

    Friction limits the sum of both forces by an ellipse.

    Parameters
    ----------
    lateral : float
        Force without a longitudinal one [N].
    limit : float
        Largest longitudinal force [N].
    drive, brake : float
        Demanded [N].
    grip : float
        Share of the brake force that acts, forward positive.
    vx, vy : float
        Velocity in the wheel's frame [m/s].
    """
    longitudinal = drive + brake * grip
    used = abs(longitudinal) / limit
    if used >= 1.0:
        longitudinal = math.copysign(limit, longitudinal)
        lateral = 0.0
    else:
        lateral *= math.sqrt(1.0 - used * used)
    slide = min(max((brake * abs(grip) / limit - 1.0) / LOCKING, 0.0), 1.0)
    if slide > 0.0:
        square = vx * vx + vy * vy
        sliding = slide * (square / (square + SLIDING_SPEED * SLIDING_SPEED))
        per_speed = sliding * limit / math.sqrt(square + 1e-12)
        longitudinal = (1.0 - sliding) * longitudinal - per_speed * vx
        lateral = (1.0 - sliding) * lateral - per_speed * vy
    return longitudinal, lateral, slide


@compiled
def wheel_forces(state: FloatArray, inputs: FloatArray, p: Parameters, w: Work, out: FloatArray) -> None:
    """Forces of all wheels, summed by unit in the unit's own frame; rates of their slips into ``out``."""
    unit_table, axle_table, scalars, unit_work, wheel_work = p.units, p.axles, p.scalars, w.units, w.wheels
    units, axles = unit_table.shape[0], axle_table.shape[0]
    rolls = roll_index(units)
    slips = rolls + 3 * units
    carcasses = slips + 2 * axles
    with_roll = scalars[WITH_ROLL] > 0.0
    driving = driving_force(state, inputs, p)
    braking = scalars[TOTAL_MASS] * max(-inputs[ACCELERATION], 0.0)
    demands = AXLE_STEERING + axles
    for unit in range(units):
        yaw_rate, roll, roll_rate = state[4 + units + unit], state[rolls + unit], state[rolls + units + unit]
        demand, moment = max(inputs[demands + unit], 0.0), inputs[demands + units + unit]
        height, brake_limit = unit_table[unit, ROLL_AXIS_HEIGHT], unit_table[unit, BRAKE_LIMIT]
        force_x = force_y = yaw_moment = roll_moment = 0.0
        for axle in range(p.first_axle[unit], p.first_axle[unit + 1]):
            x, half = axle_table[axle, POSITION], axle_table[axle, HALF_TRACK]
            angle = axle_table[axle, STEERED] * inputs[STEERING] + inputs[AXLE_STEERING + axle]
            cosine, sine = math.cos(angle), math.sin(angle)
            drive = 0.5 * axle_table[axle, DRIVE_SHARE] * driving
            own_share = axle_table[axle, UNIT_BRAKE_SHARE]
            brake = 0.5 * (axle_table[axle, BRAKE_SHARE] * braking + own_share * demand)
            one_sided = own_share * abs(moment) / half if half > 0.0 else 0.0
            load = w.axle_loads[axle]
            sprung = axle_table[axle, ROLL_STIFFNESS] * roll + axle_table[axle, ROLL_DAMPING] * roll_rate
            leftward = unit_work[unit, VELOCITY_Y] + x * yaw_rate
            tyres, model = axle_table[axle, TYRES], axle_table[axle, TYRE_MODEL]
            rate, slope = axle_table[axle, STIFFNESS_RATE], axle_table[axle, STIFFNESS_SLOPE]
            sigma = axle_table[axle, RELAXATION_LENGTH]
            for place in range(2):
                wheel = 2 * axle + place
                forward = unit_work[unit, VELOCITY_X] - (1.0 - 2.0 * place) * half * yaw_rate
                vx, vy = cosine * forward + sine * leftward, cosine * leftward - sine * forward
                slip, grip, out[slips + wheel], out[carcasses + wheel] = contact(
                    vx, vy, sigma, state[slips + wheel], state[carcasses + wheel]
                )
                wheel_work[wheel, SLIP], wheel_work[wheel, GRIP] = slip, grip
                wheel_work[wheel, CONTACT_X], wheel_work[wheel, CONTACT_Y] = vx, vy
            # First with the load shifted by the springs, then also with that shifted by the roll centre: the
            # sum of both wheels' lateral forces hardly depends on it.
            shift = along = across = turning = 0.0
            for _ in range(2 if with_roll else 1):
                if with_roll:
                    shift = 0.5 * (sprung + height * across) / half
                    shift = min(max(shift, -0.5 * load), 0.5 * load)
                along = across = turning = 0.0
                for place in range(2):
                    wheel, side = 2 * axle + place, 1.0 - 2.0 * place
                    wheel_load = 0.5 * load - side * shift
                    resistance = brake + axle_table[axle, ROLLING_RESISTANCE] * wheel_load
                    if side * moment > 0.0:
                        resistance += one_sided
                    friction = inputs[FRICTION_LEFT + place]
                    ahead = left = slide = 0.0
                    if wheel_load > LIFTED and friction > 0.0:
                        scale = friction / scalars[NOMINAL_FRICTION]
                        limit = longitudinal_limit(model, wheel_load, friction, tyres, scale, p.magic, axle)
                        stiffness = wheel_load * max(rate - slope * wheel_load, 0.0)
                        slip = wheel_work[wheel, SLIP]
                        left = lateral_force(
                            model, slip, wheel_load, friction, stiffness, tyres, scale, side, p.magic, axle
                        )
                        ahead, left, slide = wheel_force(
                            left, limit, drive, min(resistance, brake_limit * limit), wheel_work[wheel, GRIP],
                            wheel_work[wheel, CONTACT_X], wheel_work[wheel, CONTACT_Y],
                        )  # fmt: skip
                    wheel_work[wheel, LOAD], wheel_work[wheel, SLIDE] = wheel_load, slide
                    wheel_work[wheel, LONGITUDINAL_FORCE], wheel_work[wheel, LATERAL_FORCE] = ahead, left
                    own_along = cosine * ahead - sine * left
                    along += own_along
                    across += sine * ahead + cosine * left
                    turning -= side * half * own_along
            force_x += along
            force_y += across
            yaw_moment += x * across + turning
            if with_roll:
                roll_moment += height * across - 2.0 * shift * half
        unit_work[unit, FORCE_X], unit_work[unit, FORCE_Y] = force_x, force_y
        unit_work[unit, YAW_MOMENT], unit_work[unit, ROLL_MOMENT] = yaw_moment, roll_moment
