"""The consistent linear model: small-angle equations of motion of any number of units.

The assumptions are Frerichs' (2012, 4.1.1, 4.2.1, 5.1): one track, constant longitudinal speed, no
longitudinal tyre force, lateral tyre force linear in slip angle, rigid frictionless hitches, flat road.
A stack of vehicles is assembled at once: leading axes of every array are those of the stack.
"""

from dataclasses import dataclass

import numpy as np

from yawdamp_ros.dynamics.kinematics import FloatArray, cg_rows
from yawdamp_ros.dynamics.solving import solve
from yawdamp_ros.vehicle import Vehicle


@dataclass(frozen=True)
class EquationsOfMotion:
    """``mass q'' + (1/u) damping q' - stiffness q = steering delta`` with q = [y, psi_1 .. psi_n].

    Attributes
    ----------
    mass : ndarray, shape (n + 1, n + 1)
        Mass matrix [kg, kg m, kg m^2].
    damping : ndarray, shape (n + 1, n + 1)
        Damping matrix [N/rad, N m/rad, N m^2/rad], to be divided by the speed.
    stiffness : ndarray, shape (n + 1, n + 1)
        Forces and moments by heading: a slip angle contains the yaw of its own unit.
    steering : ndarray, shape (n + 1,)
        Forces and moments by road-wheel steer angle.

    Examples
    --------
    >>> from yawdamp_ros.dynamics import equations_of_motion
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> equations = equations_of_motion(load_vehicle("interlink"))
    >>> bool((equations.mass == equations.mass.T).all())
    True
    """

    mass: FloatArray
    damping: FloatArray
    stiffness: FloatArray
    steering: FloatArray


def equations_of_motion(vehicle: Vehicle) -> EquationsOfMotion:
    """Assemble the equations of motion by Lagrange's method.

    An axle at x on unit k slips sideways at ``s = y_k' + x psi_k' - u psi_k``; its slip angle is s/u,
    minus delta if it is steered, and its force is minus the cornering stiffness times that.

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    EquationsOfMotion

    Examples
    --------
    >>> from yawdamp_ros.dynamics import equations_of_motion
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> equations_of_motion(load_vehicle("interlink")).mass.shape
    (4, 4)
    """
    rows = cg_rows(vehicle)
    size = rows.shape[-1]
    headings = np.eye(size)[1:]
    mass, damping, stiffness = (np.zeros((size, size)) for _ in range(3))
    steering = np.zeros(size)
    for unit, row, heading in zip(vehicle.units, np.moveaxis(rows, -2, 0), headings, strict=True):
        mass = mass + _each(unit.mass, 2) * _outer(row, row)
        mass = mass + _each(unit.yaw_inertia, 2) * _outer(heading, heading)
        forces = np.zeros(size)
        for axle in unit.axles:
            lever = row + _each(axle.position, 1) * heading
            force = _each(axle.cornering_stiffness, 1) * lever
            damping = damping + _outer(force, lever)
            forces = forces + force
            if axle.steered:
                steering = steering + force
        stiffness = stiffness + _outer(forces, heading)
    return EquationsOfMotion(mass, damping, stiffness, steering)


def state_space(vehicle: Vehicle, speed: float) -> tuple[FloatArray, FloatArray]:
    """State and input matrix of the consistent model.

    With ``v = y' - u psi_1`` the absolute headings cancel but for the articulation angles
    ``theta_k = psi_k - psi_(k+1)``, so that the states are ``[v, r_1 .. r_n, theta_1 .. theta_(n-1)]``.

    Parameters
    ----------
    vehicle : Vehicle
    speed : float
        Longitudinal speed u [m/s], positive; of a stack, one for all or for each.

    Returns
    -------
    state_matrix : ndarray, shape (..., 2 n, 2 n)
        State matrix; for a stack, one matrix for each vehicle.
    input_matrix : ndarray, shape (..., 2 n)
        Input matrix for the road-wheel steer angle [rad].
    """
    motion = equations_of_motion(vehicle)
    count = len(vehicle.units)
    rates = count + 1
    damping = motion.damping / _each(speed, 2)
    inertia = _each(speed, 1) * motion.mass[..., 0]
    stack = np.broadcast_shapes(damping.shape[:-2], inertia.shape[:-1], motion.stiffness.shape[:-2])
    forces = np.zeros((*stack, rates, 2 * count))
    forces[..., :rates] = -damping
    forces[..., 1] -= inertia
    for joint in range(count - 1):
        # psi_k = psi_1 - (theta_1 + .. + theta_(k-1)): a joint turns every unit behind it.
        forces[..., rates + joint] = -motion.stiffness[..., joint + 2 :].sum(axis=-1)
    state_matrix = np.zeros((*stack, 2 * count, 2 * count))
    state_matrix[..., :rates, :] = solve(motion.mass, forces)
    joints = np.arange(count - 1)
    state_matrix[..., rates + joints, 1 + joints] = 1.0
    state_matrix[..., rates + joints, 2 + joints] = -1.0
    input_matrix = np.zeros((*stack, 2 * count))
    # NumPy 1 takes a single right-hand side of stacked systems for vectors.
    steering = np.broadcast_to(motion.steering, (*stack, rates))
    input_matrix[..., :rates] = solve(motion.mass, steering[..., np.newaxis])[..., 0]
    return state_matrix, input_matrix


def _each(value: float, axes: int) -> float | FloatArray:
    """Number of one vehicle, or of each vehicle of a stack, shaped to multiply vectors or matrices."""
    # A product with a Python number takes half the time of one with an array of a single element.
    return value[(..., *[np.newaxis] * axes)] if isinstance(value, np.ndarray) else value


def _outer(left: FloatArray, right: FloatArray) -> FloatArray:
    return left[..., :, np.newaxis] * right[..., np.newaxis, :]
