"""The consistent linear model: small-angle equations of motion of any number of units.

The assumptions are Frerichs' (2012, 4.1.1, 4.2.1, 5.1): one track, constant longitudinal speed, no
longitudinal tyre force, lateral tyre force linear in slip angle, rigid frictionless hitches, flat road.
"""

from dataclasses import dataclass

import numpy as np

from yawdamp_ros.dynamics.kinematics import FloatArray, cg_rows
from yawdamp_ros.vehicle import Vehicle


@dataclass(frozen=True)
class EquationsOfMotion:
    """``mass q'' + (1/u) damping q' - stiffness q = steering delta`` with q = [y, psi_1 .. psi_n].

    Attributes
    ----------
    mass : ndarray, shape (n + 1, n + 1)
        In kg, kg m and kg m^2.
    damping : ndarray, shape (n + 1, n + 1)
        In N/rad, N m/rad and N m^2/rad, to be divided by the speed.
    stiffness : ndarray, shape (n + 1, n + 1)
        Forces and moments by heading: a slip angle contains the yaw of its own unit.
    steering : ndarray, shape (n + 1,)
        Forces and moments by road-wheel steer angle.
    """

    mass: FloatArray
    damping: FloatArray
    stiffness: FloatArray
    steering: FloatArray


def equations_of_motion(vehicle: Vehicle) -> EquationsOfMotion:
    """Assemble the equations of motion by Lagrange's method.

    An axle at x on unit k slips sideways at ``s = y_k' + x psi_k' - u psi_k``; its slip angle is s/u,
    less delta where it is steered, and its force is minus the cornering stiffness times that.

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    EquationsOfMotion
    """
    rows = cg_rows(vehicle)
    size = rows.shape[1]
    mass, damping, stiffness = (np.zeros((size, size)) for _ in range(3))
    steering = np.zeros(size)
    for index, (unit, row) in enumerate(zip(vehicle.units, rows, strict=True)):
        heading = index + 1
        mass += unit.mass * np.outer(row, row)
        mass[heading, heading] += unit.yaw_inertia
        for axle in unit.axles:
            lever = row.copy()
            lever[heading] += axle.position
            force = axle.cornering_stiffness * lever
            damping += np.outer(force, lever)
            stiffness[:, heading] += force
            if axle.steered:
                steering += force
    return EquationsOfMotion(mass, damping, stiffness, steering)


def state_space(vehicle: Vehicle, speed: float) -> tuple[FloatArray, FloatArray]:
    """State and input matrix of the consistent model.

    With ``v = y' - u psi_1`` the absolute headings cancel but for the articulation angles
    ``theta_k = psi_k - psi_(k+1)``, so that the states are ``[v, r_1 .. r_n, theta_1 .. theta_(n-1)]``.

    Parameters
    ----------
    vehicle : Vehicle
    speed : float
        Longitudinal speed u in m/s, positive.

    Returns
    -------
    state_matrix : ndarray, shape (2 n, 2 n)
    input_matrix : ndarray, shape (2 n,)
        By road-wheel steer angle in rad.
    """
    motion = equations_of_motion(vehicle)
    count = len(vehicle.units)
    rates = count + 1
    forces = np.zeros((rates, 2 * count))
    forces[:, :rates] = -motion.damping / speed
    forces[:, 1] -= speed * motion.mass[:, 0]
    for joint in range(count - 1):
        # psi_k = psi_1 - (theta_1 + .. + theta_(k-1)): a joint turns every unit behind it.
        forces[:, rates + joint] = -motion.stiffness[:, joint + 2 :].sum(axis=1)
    state_matrix = np.zeros((2 * count, 2 * count))
    state_matrix[:rates] = np.linalg.solve(motion.mass, forces)
    joints = np.arange(count - 1)
    state_matrix[rates + joints, 1 + joints] = 1.0
    state_matrix[rates + joints, 2 + joints] = -1.0
    input_matrix = np.zeros(2 * count)
    input_matrix[:rates] = np.linalg.solve(motion.mass, motion.steering)
    return state_matrix, input_matrix
