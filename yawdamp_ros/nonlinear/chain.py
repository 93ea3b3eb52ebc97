"""The chain of rigid units: exact kinematics and the equations of motion.

The coordinates are the ground point of the lead unit, the yaw and the roll of every unit. The ground point
lies below the unit's centre of gravity when it stands upright; a roll angle turns the unit about its roll
axis, which stays parallel to the road. All vectors lie in the road's plane, in the lead unit's frame unless
said otherwise.
"""

import math

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.nonlinear.compiled import compiled
from yawdamp_ros.nonlinear.layout import roll_index, speed_index
from yawdamp_ros.nonlinear.records import (
    ACCELERATION_X,
    ACCELERATION_Y,
    BIAS_X,
    BIAS_Y,
    CG_ARM,
    COSINE,
    FORCE_X,
    FORCE_Y,
    FRONT_ARM,
    FRONT_HITCH,
    HITCH_FORCE_X,
    HITCH_FORCE_Y,
    LEAN,
    MASS,
    REAR_ARM,
    REAR_HITCH,
    ROLL_INERTIA,
    ROLL_MOMENT,
    SINE,
    THROUGH_ROLL_X,
    THROUGH_ROLL_Y,
    THROUGH_YAW_X,
    THROUGH_YAW_Y,
    UPRIGHT,
    VELOCITY_X,
    VELOCITY_Y,
    WITH_ROLL,
    YAW_INERTIA,
    YAW_MOMENT,
    Parameters,
    Work,
)


@compiled
def chain_kinematics(state: FloatArray, p: Parameters, w: Work) -> None:
    """Headings, velocities of the ground points and accelerations by rates alone, from front to rear."""
    unit_table, unit_work = p.units, w.units
    units = unit_table.shape[0]
    rolls = roll_index(units)
    heading = 0.0
    vx, vy = state[speed_index(units)], state[speed_index(units) + 1]
    bias_x = bias_y = 0.0
    for unit in range(units):
        yaw_rate = state[4 + units + unit]
        roll, roll_rate = state[rolls + unit], state[rolls + units + unit]
        lean, upright = math.sin(roll), math.cos(roll)
        unit_work[unit, LEAN], unit_work[unit, UPRIGHT] = lean, upright
        if unit > 0:
            heading -= state[2 + unit]
        c, s = math.cos(heading), math.sin(heading)
        unit_work[unit, COSINE], unit_work[unit, SINE] = c, s
        if unit > 0:
            # From the hitch to the ground point: -front_hitch forward, front_arm * lean to the left.
            arm, along = unit_table[unit, FRONT_ARM], -unit_table[unit, FRONT_HITCH]
            side, side_rate = arm * lean, arm * upright * roll_rate
            forward, left = -yaw_rate * side, yaw_rate * along + side_rate
            vx, vy = vx + c * forward - s * left, vy + s * forward + c * left
            forward = -yaw_rate * yaw_rate * along - 2.0 * yaw_rate * side_rate
            left = -yaw_rate * yaw_rate * side - arm * lean * roll_rate * roll_rate
            bias_x, bias_y = bias_x + c * forward - s * left, bias_y + s * forward + c * left
        unit_work[unit, VELOCITY_X] = c * vx + s * vy
        unit_work[unit, VELOCITY_Y] = c * vy - s * vx
        # From the ground point to the CG: cg_arm * lean to the right.
        arm = unit_table[unit, CG_ARM]
        forward = 2.0 * yaw_rate * arm * upright * roll_rate
        left = arm * lean * (yaw_rate * yaw_rate + roll_rate * roll_rate)
        unit_work[unit, BIAS_X] = bias_x + c * forward - s * left
        unit_work[unit, BIAS_Y] = bias_y + s * forward + c * left
        # From the ground point to the rear hitch.
        arm, along = unit_table[unit, REAR_ARM], unit_table[unit, REAR_HITCH]
        side, side_rate = -arm * lean, -arm * upright * roll_rate
        forward, left = -yaw_rate * side, yaw_rate * along + side_rate
        vx, vy = vx + c * forward - s * left, vy + s * forward + c * left
        forward = -yaw_rate * yaw_rate * along - 2.0 * yaw_rate * side_rate
        left = -yaw_rate * yaw_rate * side + arm * lean * roll_rate * roll_rate
        bias_x, bias_y = bias_x + c * forward - s * left, bias_y + s * forward + c * left
        arm, along = (
            unit_table[unit, FRONT_ARM] - unit_table[unit, REAR_ARM],
            unit_table[unit, REAR_HITCH] - unit_table[unit, FRONT_HITCH],
        )
        unit_work[unit, THROUGH_YAW_X] = -c * arm * lean - s * along
        unit_work[unit, THROUGH_YAW_Y] = c * along - s * arm * lean
        unit_work[unit, THROUGH_ROLL_X] = -s * arm * upright
        unit_work[unit, THROUGH_ROLL_Y] = c * arm * upright


@compiled
def equations_of_motion(
    state: FloatArray, pull_x: float, pull_y: float, fall: float, p: Parameters, w: Work
) -> None:
    """Assemble the mass matrix and the generalised forces, from rear to front, by d'Alembert's principle.

    ``M = sum_k m_k J_k' J_k`` with the Jacobian of each CG, which for a unit ahead is the same whatever the
    unit behind: sums over the units behind suffice.

    Parameters
    ----------
    state : ndarray
    pull_x, pull_y, fall : float
        Gravity along the road, in the lead unit's frame, and into it [m/s^2].
    p, w
    """
    unit_table, scalars, unit_work = p.units, p.scalars, w.units
    units = unit_table.shape[0]
    rolls = roll_index(units)
    size = 2 + 2 * units if scalars[WITH_ROLL] else 2 + units
    m, q = w.mass_matrix, w.solution
    mass = force_x = force_y = inertia_x = inertia_y = 0.0  # of the units behind
    for back in range(units):
        unit = units - 1 - back
        own = unit_table[unit, MASS]
        roll_rate = state[rolls + units + unit]
        lean, upright = unit_work[unit, LEAN], unit_work[unit, UPRIGHT]
        c, s = unit_work[unit, COSINE], unit_work[unit, SINE]
        along, front, arm = (
            -unit_table[unit, FRONT_HITCH],
            unit_table[unit, FRONT_ARM],
            unit_table[unit, CG_ARM],
        )
        # Velocity of the CG and of the ground point relative to the front hitch, by each of the rates.
        side = (front - arm) * lean
        cg_yaw_x, cg_yaw_y = -c * side - s * along, c * along - s * side
        side = front * lean
        ground_yaw_x, ground_yaw_y = -c * side - s * along, c * along - s * side
        through_yaw_x, through_yaw_y = unit_work[unit, THROUGH_YAW_X], unit_work[unit, THROUGH_YAW_Y]
        own_x, own_y = own * (unit_work[unit, BIAS_X] - pull_x), own * (unit_work[unit, BIAS_Y] - pull_y)
        fx, fy = unit_work[unit, FORCE_X], unit_work[unit, FORCE_Y]
        yaw = 2 + unit
        yaw_x, yaw_y = own * cg_yaw_x + mass * through_yaw_x, own * cg_yaw_y + mass * through_yaw_y
        m[yaw, yaw] = (
            own * (cg_yaw_x * cg_yaw_x + cg_yaw_y * cg_yaw_y)
            + mass * (through_yaw_x * through_yaw_x + through_yaw_y * through_yaw_y)
            + unit_table[unit, YAW_INERTIA]
        )
        m[yaw, 0], m[yaw, 1] = yaw_x, yaw_y
        q[yaw] = (
            unit_work[unit, YAW_MOMENT]
            + ground_yaw_x * fx + ground_yaw_y * fy
            - cg_yaw_x * own_x - cg_yaw_y * own_y
            + through_yaw_x * (force_x - inertia_x) + through_yaw_y * (force_y - inertia_y)
        )  # fmt: skip
        for ahead in range(unit):
            m[yaw, 2 + ahead] = (
                unit_work[ahead, THROUGH_YAW_X] * yaw_x + unit_work[ahead, THROUGH_YAW_Y] * yaw_y
            )
        if scalars[WITH_ROLL]:
            across = (front - arm) * upright
            cg_roll_x, cg_roll_y = -s * across, c * across
            across = front * upright
            ground_roll_x, ground_roll_y = -s * across, c * across
            through_roll_x, through_roll_y = unit_work[unit, THROUGH_ROLL_X], unit_work[unit, THROUGH_ROLL_Y]
            turn = 2 + units + unit
            roll_x = own * cg_roll_x + mass * through_roll_x
            roll_y = own * cg_roll_y + mass * through_roll_y
            m[turn, turn] = (
                own * (cg_roll_x * cg_roll_x + cg_roll_y * cg_roll_y)
                + mass * (through_roll_x * through_roll_x + through_roll_y * through_roll_y)
                + unit_table[unit, ROLL_INERTIA]
                + own * arm * arm * lean * lean
            )
            m[turn, 0], m[turn, 1] = roll_x, roll_y
            m[turn, yaw] = (
                own * (cg_yaw_x * cg_roll_x + cg_yaw_y * cg_roll_y)
                + mass * (through_yaw_x * through_roll_x + through_yaw_y * through_roll_y)
            )  # fmt: skip
            for ahead in range(unit):
                m[turn, 2 + ahead] = (
                    unit_work[ahead, THROUGH_YAW_X] * roll_x + unit_work[ahead, THROUGH_YAW_Y] * roll_y
                )
                m[turn, 2 + units + ahead] = (
                    unit_work[ahead, THROUGH_ROLL_X] * roll_x + unit_work[ahead, THROUGH_ROLL_Y] * roll_y
                )
                m[2 + units + ahead, yaw] = (
                    unit_work[ahead, THROUGH_ROLL_X] * yaw_x + unit_work[ahead, THROUGH_ROLL_Y] * yaw_y
                )
            q[turn] = (
                unit_work[unit, ROLL_MOMENT]
                + own * arm * lean * (fall - arm * upright * roll_rate * roll_rate)
                + ground_roll_x * fx + ground_roll_y * fy
                - cg_roll_x * own_x - cg_roll_y * own_y
                + through_roll_x * (force_x - inertia_x) + through_roll_y * (force_y - inertia_y)
            )  # fmt: skip
        mass += own
        force_x, force_y = force_x + fx, force_y + fy
        inertia_x, inertia_y = inertia_x + own_x, inertia_y + own_y
    m[0, 0] = m[1, 1] = mass
    m[1, 0] = 0.0
    q[0], q[1] = force_x - inertia_x, force_y - inertia_y
    solve_in_place(m, q, size)


@compiled
def solve_in_place(matrix: FloatArray, vector: FloatArray, size: int) -> None:
    """Solve by the Cholesky decomposition of a symmetric positive definite matrix, given below its diagonal.

    Parameters
    ----------
    matrix : ndarray, shape (>= size, >= size)
        Overwritten by the factor below its diagonal.
    vector : ndarray, shape (>= size,)
        Overwritten by the solution; NaN where the matrix is not positive definite.
    size : int
    """
    for row in range(size):
        for column in range(row):
            total = matrix[row, column]
            for k in range(column):
                total -= matrix[row, k] * matrix[column, k]
            matrix[row, column] = total / matrix[column, column]
        total = matrix[row, row]
        for k in range(row):
            total -= matrix[row, k] * matrix[row, k]
        matrix[row, row] = math.sqrt(total) if total > 0.0 else math.nan
        total = vector[row]
        for k in range(row):
            total -= matrix[row, k] * vector[k]
        vector[row] = total / matrix[row, row]
    for back in range(size):
        row = size - 1 - back
        total = vector[row]
        for k in range(row + 1, size):
            total -= matrix[k, row] * vector[k]
        vector[row] = total / matrix[row, row]


@compiled
def unit_accelerations(pull_x: float, pull_y: float, p: Parameters, w: Work) -> None:
    """Accelerations of the CGs from the solution, and the forces in the hitches."""
    unit_table, scalars, unit_work = p.units, p.scalars, w.units
    units = unit_table.shape[0]
    q = w.solution
    ax, ay = q[0], q[1]
    for unit in range(units):
        lean, upright = unit_work[unit, LEAN], unit_work[unit, UPRIGHT]
        c, s = unit_work[unit, COSINE], unit_work[unit, SINE]
        along, arm = -unit_table[unit, FRONT_HITCH], unit_table[unit, FRONT_ARM] - unit_table[unit, CG_ARM]
        side = arm * lean
        yaw = q[2 + unit]
        roll = q[2 + units + unit] if scalars[WITH_ROLL] else 0.0
        across = arm * upright * roll
        unit_work[unit, ACCELERATION_X] = (
            ax + unit_work[unit, BIAS_X] + (-c * side - s * along) * yaw - s * across
        )
        unit_work[unit, ACCELERATION_Y] = (
            ay + unit_work[unit, BIAS_Y] + (c * along - s * side) * yaw + c * across
        )
        ax += unit_work[unit, THROUGH_YAW_X] * yaw + unit_work[unit, THROUGH_ROLL_X] * roll
        ay += unit_work[unit, THROUGH_YAW_Y] * yaw + unit_work[unit, THROUGH_ROLL_Y] * roll
    force_x = force_y = 0.0
    for back in range(units):
        unit = units - 1 - back
        force_x += (
            unit_table[unit, MASS] * (unit_work[unit, ACCELERATION_X] - pull_x) - unit_work[unit, FORCE_X]
        )
        force_y += (
            unit_table[unit, MASS] * (unit_work[unit, ACCELERATION_Y] - pull_y) - unit_work[unit, FORCE_Y]
        )
        unit_work[unit, HITCH_FORCE_X], unit_work[unit, HITCH_FORCE_Y] = force_x, force_y
