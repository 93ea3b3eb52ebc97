"""Moments that hitches pass on: friction, the stop, roll."""

import math

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.nonlinear.compiled import compiled
from yawdamp_ros.nonlinear.layout import roll_index
from yawdamp_ros.nonlinear.records import (
    CARRIED,
    FRONT_ARM,
    HITCH_DAMPING,
    HITCH_FRICTION,
    HITCH_ROLL_DAMPING,
    HITCH_ROLL_STIFFNESS,
    LEAN,
    MAX_ARTICULATION,
    REAR_ARM,
    ROLL_MOMENT,
    WITH_ROLL,
    YAW_MOMENT,
    Parameters,
    Work,
)

FRICTION_RATE = 0.01
"""Articulation rate at which Coulomb friction is three quarters of its largest [rad/s]."""
STOP_STIFFNESS = 5.0e6
"""Stiffness of the contact of two units past their largest articulation [N m/rad]."""
STOP_DAMPING = 2.0e5
"""Damping of that contact [N m s/rad]."""


@compiled
def hitch_moments(state: FloatArray, p: Parameters, w: Work) -> None:
    """Add the hitches' moments to those of the units."""
    unit_table, scalars, unit_work = p.units, p.scalars, w.units
    units = unit_table.shape[0]
    rolls = roll_index(units)
    for joint in range(units - 1):
        angle = state[3 + joint]
        rate = state[4 + units + joint] - state[5 + units + joint]
        moment = -unit_table[joint, HITCH_DAMPING] * rate - unit_table[joint, HITCH_FRICTION] * math.tanh(
            rate / FRICTION_RATE
        )
        past = abs(angle) - unit_table[joint, MAX_ARTICULATION]
        if past > 0.0:
            side = math.copysign(1.0, angle)
            moment -= side * max(STOP_STIFFNESS * past + STOP_DAMPING * side * rate, 0.0)
        if scalars[WITH_ROLL]:
            ahead, behind = state[rolls + joint], state[rolls + joint + 1]
            cosine, sine = math.cos(angle), math.sin(angle)
            twist = ahead - behind * cosine
            twist_rate = state[rolls + units + joint] - state[rolls + units + joint + 1] * cosine
            twist_rate += behind * sine * rate
            roll = (
                unit_table[joint, HITCH_ROLL_STIFFNESS] * twist
                + unit_table[joint, HITCH_ROLL_DAMPING] * twist_rate
            )
            load = unit_work[joint + 1, CARRIED]
            front, rear = unit_table[joint, REAR_ARM], unit_table[joint + 1, FRONT_ARM]
            unit_work[joint, ROLL_MOMENT] += load * front * unit_work[joint, LEAN] - roll
            unit_work[joint + 1, ROLL_MOMENT] += roll * cosine - load * rear * unit_work[joint + 1, LEAN]
            moment -= roll * behind * sine
        unit_work[joint, YAW_MOMENT] += moment
        unit_work[joint + 1, YAW_MOMENT] -= moment
