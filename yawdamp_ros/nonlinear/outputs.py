"""Outputs of the nonlinear model by state and input."""

from typing import NamedTuple

import numpy as np

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.nonlinear.layout import StateLayout, roll_index
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
        Of the ground point below each upright unit's centre of gravity (CG), in the plane of the road [m].
    yaw : ndarray, shape (m, n)
        In rad.
    velocity : ndarray, shape (m, n, 2)
        Of the ground points, in the unit's own frame [m/s].
    yaw_rate : ndarray, shape (m, n)
        In rad/s.
    acceleration : ndarray, shape (m, n, 2)
        Of the CGs along the road, in the unit's own frame [m/s^2].
    roll, roll_rate : ndarray, shape (m, n)
        In rad and rad/s, positive where the unit leans to the right.
    load_transfer_ratio : ndarray, shape (m, n)
        Loads of the right wheels less those of the left over both; 0 of a unit that carries no load.
    articulation : ndarray, shape (m, n - 1)
        In rad.
    hitch_force : ndarray, shape (m, n - 1, 3)
        On the towed unit, in the towing unit's frame; the third is the load that the hitch carries [N].
    wheel_load, slip, slide, longitudinal_force, lateral_force : ndarray, shape (m, 2 a)
        Of every wheel, left before right: load [N], lateral slip, share by which a braked wheel slides, and
        forces in the wheel's frame [N].
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


def write_outputs(outputs: Outputs, place: int, state: FloatArray, p: Parameters, w: Work) -> None:
    """Write one instant, from the work arrays of its evaluation."""
    units = len(p.units)
    layout = StateLayout(units, len(p.axles))
    c, s = w.units[:, COSINE], w.units[:, SINE]
    yaw = state[2] - np.concatenate([[0.0], np.cumsum(state[layout.articulation])])
    outputs.yaw[place] = yaw
    outputs.position[place] = ground_points(state, p)
    outputs.velocity[place] = w.units[:, [VELOCITY_X, VELOCITY_Y]]
    outputs.yaw_rate[place] = state[layout.yaw_rate]
    outputs.acceleration[place] = _turned(w.units[:, [ACCELERATION_X, ACCELERATION_Y]], c, s)
    outputs.roll[place] = state[layout.roll]
    outputs.roll_rate[place] = state[layout.roll_rate]
    left, right = w.wheels[0::2, LOAD], w.wheels[1::2, LOAD]
    both = np.add.reduceat(left + right, p.first_axle[:-1])
    shifted = np.add.reduceat(right - left, p.first_axle[:-1])
    outputs.load_transfer_ratio[place] = np.divide(shifted, both, out=np.zeros(units), where=both > 0.0)
    outputs.articulation[place] = state[layout.articulation]
    outputs.hitch_force[place, :, :2] = _turned(w.units[1:, [HITCH_FORCE_X, HITCH_FORCE_Y]], c[:-1], s[:-1])
    outputs.hitch_force[place, :, 2] = w.units[1:, CARRIED]
    outputs.wheel_load[place] = w.wheels[:, LOAD]
    outputs.slip[place] = w.wheels[:, SLIP]
    outputs.slide[place] = w.wheels[:, SLIDE]
    outputs.longitudinal_force[place] = w.wheels[:, LONGITUDINAL_FORCE]
    outputs.lateral_force[place] = w.wheels[:, LATERAL_FORCE]


def ground_points(state: FloatArray, p: Parameters) -> FloatArray:
    """Position of every unit's ground point [m], shape (n, 2), by the exact chain."""
    units = len(p.units)
    rolls = roll_index(units)
    lean = np.sin(state[rolls : rolls + units])
    points = np.zeros(units, dtype=np.complex128)
    points[0] = complex(state[0], state[1])
    heading = state[2]
    for unit in range(1, units):
        ahead = np.exp(1j * heading)
        heading -= state[2 + unit]
        own = np.exp(1j * heading)
        points[unit] = (
            points[unit - 1]
            + (p.units[unit - 1, REAR_HITCH] - 1j * p.units[unit - 1, REAR_ARM] * lean[unit - 1]) * ahead
            - (p.units[unit, FRONT_HITCH] - 1j * p.units[unit, FRONT_ARM] * lean[unit]) * own
        )
    return np.column_stack([points.real, points.imag])


def _turned(vectors: FloatArray, c: FloatArray, s: FloatArray) -> FloatArray:
    """Vectors of the lead unit's frame in frames turned against it."""
    return np.column_stack([c * vectors[:, 0] + s * vectors[:, 1], c * vectors[:, 1] - s * vectors[:, 0]])
