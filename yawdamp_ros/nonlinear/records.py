"""The flat records that the compiled functions read and write: numbers in a few tables, nothing else.

Lengths: n units, a axles, 2 a wheels. Wheel 2 i is the left one of axle i, 2 i + 1 the right one; duals count
as one wheel. Joint k couples unit k to unit k + 1. A table has a row for each and a column for each quantity,
for compiled code reads one table faster than fifty arrays.
"""

from typing import NamedTuple

import numpy as np

from yawdamp_ros.dynamics.kinematics import FloatArray, IntArray

LINEAR, BRUSH, MAGIC_FORMULA = range(3)
"""Tyre models, as the column TYRE_MODEL holds them."""

# Columns of `Parameters.units`, for each unit.
MASS, YAW_INERTIA, ROLL_INERTIA = range(3)  # kg, kg m^2 about the centre of gravity (CG)
CG_HEIGHT, ROLL_AXIS_HEIGHT = 3, 4  # above the road, m
FRONT_HITCH, REAR_HITCH = 5, 6  # from the CG, forward positive, m; 0 where there is none
FRONT_ARM, REAR_ARM, CG_ARM = 7, 8, 9  # height of hitches and CG above the roll axis, m; 0 without roll
FRONT_HEIGHT, REAR_HEIGHT = 10, 11  # of the hitches above the road, m
BRAKE_LIMIT = 12  # largest brake force over friction; below 1 with ABS
SUPPORT_FRONT, SUPPORT_REAR = 13, 14  # where the unit's weight rests, from the CG, m
HITCH_LOAD = 15  # static vertical load on the front hitch, N
HITCH_ROLL_STIFFNESS, HITCH_ROLL_DAMPING = 16, 17  # of the rear hitch, N m/rad, N m s/rad
HITCH_FRICTION, HITCH_DAMPING = 18, 19  # Coulomb and viscous yaw friction of the rear hitch, N m, N m s/rad
MAX_ARTICULATION = 20  # of the rear hitch, rad
UNIT_COLUMNS = 21

# Columns of `Parameters.axles`, for each axle.
POSITION, HALF_TRACK = 0, 1  # from the CG, and half the track width, m
STEERED = 2  # 1 where the axle follows the steer angle
STATIC_LOAD = 3  # N
FRONT_SHARE, REAR_SHARE = 4, 5  # of the axle in its unit's supports
RELAXATION_LENGTH = 6  # m
ROLL_STIFFNESS, ROLL_DAMPING = 7, 8  # N m/rad, N m s/rad
ROLLING_RESISTANCE = 9  # over the load
DRIVE_SHARE, BRAKE_SHARE, UNIT_BRAKE_SHARE = 10, 11, 12  # of combination, combination and unit
TYRE_MODEL = 13
STIFFNESS_RATE, STIFFNESS_SLOPE = (
    14,
    15,
)  # a wheel under load F has the cornering stiffness F (rate - slope F)
TYRES = 16  # on each wheel
AXLE_COLUMNS = 17

# Elements of `Parameters.scalars`.
TOTAL_MASS = 0  # kg
DRAG, DRAG_HEIGHT = 1, 2  # N s^2/m^2, m
NOMINAL_FRICTION = 3  # at which a magic formula's own holds
SPEED_GAIN, LOWEST_DEMAND, HIGHEST_DEMAND = 4, 5, 6  # of the speed controller, 1/s, m/s^2
LOAD_SHIFT_TIME = 7  # s
WITH_ROLL, WITH_LOAD_SHIFT = 8, 9  # 1 or 0
ROLLOVER_ANGLE, SWING_SLIP = 10, 11  # rad, and the tangent of an angle
SCALARS = 12

# Columns of `Work.units`; vectors lie in the lead unit's frame unless said otherwise.
COSINE, SINE = 0, 1  # of the heading relative to the lead unit
VELOCITY_X, VELOCITY_Y = 2, 3  # of the ground point below the upright CG, in the unit's own frame, m/s
BIAS_X, BIAS_Y = 4, 5  # acceleration of the CG by rates alone, m/s^2
THROUGH_YAW_X, THROUGH_YAW_Y = 6, 7  # velocity of the rear hitch relative to the front hitch by yaw rate, m
THROUGH_ROLL_X, THROUGH_ROLL_Y = 8, 9  # and by roll rate, m
FORCE_X, FORCE_Y = 10, 11  # of tyres and air, N
YAW_MOMENT, ROLL_MOMENT = 12, 13  # of tyres, suspension and hitches, N m
CARRIED = 14  # vertical load on the front hitch, N
HITCH_FORCE_X, HITCH_FORCE_Y = 15, 16  # on the unit at its front hitch, N
ACCELERATION_X, ACCELERATION_Y = 17, 18  # of the CG, m/s^2
LEAN, UPRIGHT = 19, 20  # sine and cosine of the roll angle
UNIT_WORK = 21

# Columns of `Work.wheels`.
LOAD, SLIP, SLIDE = 0, 1, 2  # N, lateral slip, share by which a braked wheel slides
LONGITUDINAL_FORCE, LATERAL_FORCE = 3, 4  # in the wheel's frame, N
GRIP = 5  # share of the brake force that acts, forward positive
CONTACT_X, CONTACT_Y = 6, 7  # velocity in the wheel's frame, m/s
WHEEL_WORK = 8


class Parameters(NamedTuple):
    """A vehicle and the settings of a run.

    Attributes
    ----------
    units : ndarray, shape (n, UNIT_COLUMNS)
    axles : ndarray, shape (a, AXLE_COLUMNS)
    magic : ndarray, shape (a, 23)
        Coefficients of the magic formula, as `vehicle.tir.COEFFICIENTS`.
    scalars : ndarray, shape (SCALARS,)
    first_axle : ndarray of int, shape (n + 1,)
        Unit k has the axles from first_axle[k] to first_axle[k + 1] - 1.
    """

    units: FloatArray
    axles: FloatArray
    magic: FloatArray
    scalars: FloatArray
    first_axle: IntArray


class Work(NamedTuple):
    """Intermediate results of one evaluation of the equations of motion.

    Attributes
    ----------
    units : ndarray, shape (n, UNIT_WORK)
    wheels : ndarray, shape (2 a, WHEEL_WORK)
    axle_loads : ndarray, shape (a,)
        Load of each axle [N].
    mass_matrix : ndarray, shape (2 + 2 n, 2 + 2 n)
    solution : ndarray, shape (2 + 2 n,)
        Generalised forces, and then accelerations.
    """

    units: FloatArray
    wheels: FloatArray
    axle_loads: FloatArray
    mass_matrix: FloatArray
    solution: FloatArray


def make_work(units: int, axles: int) -> Work:
    """Allocate the work arrays of one evaluation.

    Examples
    --------
    >>> make_work(3, 7).wheels.shape
    (14, 8)
    """
    size = 2 + 2 * units
    return Work(
        np.zeros((units, UNIT_WORK)),
        np.zeros((2 * axles, WHEEL_WORK)),
        np.zeros(axles),
        np.zeros((size, size)),
        np.zeros(size),
    )
