"""Outputs of the nonlinear model by state and input."""

import math
from typing import NamedTuple

import numpy as np

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.nonlinear.compiled import compiled
from yawdamp_ros.nonlinear.layout import YAW, X, Y, roll_index
from yawdamp_ros.nonlinear.records import (
    ACCELERATION_X,
    ACCELERATION_Y,
    CARRIED,
    COSINE,
    FRONT_ARM,
    FRONT_HITCH,
    HITCH_FORCE_X,
    HITCH_FORCE_Y,
    LATERAL_FORCE,
    LOAD,
    LONGITUDINAL_FORCE,
    REAR_ARM,
    REAR_HITCH,
    SINE,
    SLIDE,
    SLIP,
    VELOCITY_X,
    VELOCITY_Y,
    Parameters,
    Work,
)


class Outputs(NamedTuple):
    """A motion at m instants; n units, a axles. Accelerations are without gravity.

    Attributes
    ----------
    position : ndarray, shape (m, n, 2)
        Position of the ground point below each upright unit's centre of gravity (CG), in the road plane [m].
    yaw : ndarray, shape (m, n)
        Yaw angles [rad].
    velocity : ndarray, shape (m, n, 2)
        Velocity of the ground points, in the unit's own frame [m/s].
    yaw_rate : ndarray, shape (m, n)
        Yaw rate [rad/s].
    acceleration : ndarray, shape (m, n, 2)
        Acceleration of the CGs along the road, in the unit's own frame [m/s^2].
    roll, roll_rate : ndarray, shape (m, n)
        Roll angle [rad] and roll rate [rad/s], positive if the unit leans to the right.
    load_transfer_ratio : ndarray, shape (m, n)
        Load of the right wheels minus load of the left wheels, over their sum; 0 for a unit without load.
    articulation : ndarray, shape (m, n - 1)
        Articulation angles [rad].
    hitch_force : ndarray, shape (m, n - 1, 3)
        Force on the towed unit, in the towing unit's frame; the third is the load that the hitch carries [N].
    wheel_load, slip, slide, longitudinal_force, lateral_force : ndarray, shape (m, 2 a)
        Values of every wheel, left before right: load [N], lateral slip, share by which a braked wheel
        slides, and forces in the wheel's frame [N].

    Examples
    --------
    >>> from yawdamp_ros.nonlinear import NonlinearDynamics
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> dynamics = NonlinearDynamics(load_vehicle("truck_trailer"))
    >>> state, inputs = dynamics.initial_state(20.0), dynamics.inputs(steering=0.02, speed=20.0)
    >>> run = dynamics.steps(state, inputs, dt=0.001, count=1000, every=100)
    >>> dynamics.outputs(run.states, inputs).yaw_rate.shape
    (10, 2)
    """

    position: FloatArray
    yaw: FloatArray
    velocity: FloatArray
    yaw_rate: FloatArray
    acceleration: FloatArray
    roll: FloatArray
    roll_rate: FloatArray
    load_transfer_ratio: FloatArray
    articulation: FloatArray
    hitch_force: FloatArray
    wheel_load: FloatArray
    slip: FloatArray
    slide: FloatArray
    longitudinal_force: FloatArray
    lateral_force: FloatArray


def empty_outputs(count: int, units: int, axles: int) -> Outputs:
    """Allocate the outputs of some instants.

    Examples
    --------
    >>> empty_outputs(5, 3, 7).hitch_force.shape
    (5, 2, 3)
    """
    each, wheels = (count, units), (count, 2 * axles)
    joints = (count, units - 1)
    shapes = [
        (*each, 2),
        each,
        (*each, 2),
        each,
        (*each, 2),
        each,
        each,
        each,
        joints,
        (*joints, 3),
        *[wheels] * 5,
    ]
    return Outputs(*(np.zeros(shape) for shape in shapes))


@compiled
def write_outputs(outputs: Outputs, place: int, state: FloatArray, p: Parameters, w: Work) -> None:
    """Write one instant, from the work arrays of its evaluation."""
    unit_table, axle_table, unit_work, wheel_work = p.units, p.axles, w.units, w.wheels
    units, axles = unit_table.shape[0], axle_table.shape[0]
    rolls = roll_index(units)
    yaw = state[YAW]
    _write_ground_points(outputs.position[place], state, p)
    for unit in range(units):
        if unit > 0:
            yaw -= state[2 + unit]
            c, s = unit_work[unit - 1, COSINE], unit_work[unit - 1, SINE]
            outputs.articulation[place, unit - 1] = state[2 + unit]
            force = outputs.hitch_force[place, unit - 1]
            along, across = unit_work[unit, HITCH_FORCE_X], unit_work[unit, HITCH_FORCE_Y]
            force[0], force[1], force[2] = (
                c * along + s * across,
                c * across - s * along,
                unit_work[unit, CARRIED],
            )
        c, s = unit_work[unit, COSINE], unit_work[unit, SINE]
        outputs.yaw[place, unit] = yaw
        outputs.velocity[place, unit, 0] = unit_work[unit, VELOCITY_X]
        outputs.velocity[place, unit, 1] = unit_work[unit, VELOCITY_Y]
        outputs.yaw_rate[place, unit] = state[4 + units + unit]
        along, across = unit_work[unit, ACCELERATION_X], unit_work[unit, ACCELERATION_Y]
        outputs.acceleration[place, unit, 0] = c * along + s * across
        outputs.acceleration[place, unit, 1] = c * across - s * along
        outputs.roll[place, unit] = state[rolls + unit]
        outputs.roll_rate[place, unit] = state[rolls + units + unit]
        both = shifted = 0.0
        for axle in range(p.first_axle[unit], p.first_axle[unit + 1]):
            left, right = wheel_work[2 * axle, LOAD], wheel_work[2 * axle + 1, LOAD]
            both += left + right
            shifted += right - left
        outputs.load_transfer_ratio[place, unit] = shifted / both if both > 0.0 else 0.0
    for wheel in range(2 * axles):
        outputs.wheel_load[place, wheel] = wheel_work[wheel, LOAD]
        outputs.slip[place, wheel] = wheel_work[wheel, SLIP]
        outputs.slide[place, wheel] = wheel_work[wheel, SLIDE]
        outputs.longitudinal_force[place, wheel] = wheel_work[wheel, LONGITUDINAL_FORCE]
        outputs.lateral_force[place, wheel] = wheel_work[wheel, LATERAL_FORCE]


@compiled
def _write_ground_points(points: FloatArray, state: FloatArray, p: Parameters) -> None:
    """Position of every unit's ground point [m], shape (n, 2), by the exact chain."""
    unit_table = p.units
    units = unit_table.shape[0]
    rolls = roll_index(units)
    x, y, heading = state[X], state[Y], state[YAW]
    points[0, 0], points[0, 1] = x, y
    for unit in range(1, units):
        c, s = math.cos(heading), math.sin(heading)
        along = unit_table[unit - 1, REAR_HITCH]
        left = -unit_table[unit - 1, REAR_ARM] * math.sin(state[rolls + unit - 1])
        x, y = x + c * along - s * left, y + s * along + c * left
        heading -= state[2 + unit]
        c, s = math.cos(heading), math.sin(heading)
        along = -unit_table[unit, FRONT_HITCH]
        left = unit_table[unit, FRONT_ARM] * math.sin(state[rolls + unit])
        x, y = x + c * along - s * left, y + s * along + c * left
        points[unit, 0], points[unit, 1] = x, y
