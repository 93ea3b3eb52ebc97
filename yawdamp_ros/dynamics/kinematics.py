"""How the units of a combination move together."""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from yawdamp_ros.vehicle import Vehicle

FloatArray = npt.NDArray[np.float64]


def cg_rows(vehicle: Vehicle) -> FloatArray:
    """Lateral position of every centre of gravity in terms of the generalised coordinates.

    For small angles unit k lies at ``y_k = rows[k] @ [y, psi_1 .. psi_n]``.

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    ndarray, shape (..., n, n + 1)
        First column 1, the others lever arms in m; of a stack whose hitches differ, one matrix a vehicle.
    """
    count = len(vehicle.units)
    stack = np.broadcast_shapes(*(np.shape(hitch) for pair in vehicle.hitches for hitch in pair))
    rows = np.zeros((*stack, count, count + 1))
    rows[..., 0] = 1.0
    for index, (rear_hitch, front_hitch) in enumerate(vehicle.hitches):
        rows[..., index + 1, :] = rows[..., index, :]
        rows[..., index + 1, index + 1] += rear_hitch
        rows[..., index + 1, index + 2] -= front_hitch
    return rows


def coupled_positions(
    hitches: Sequence[tuple[float, float]], x: FloatArray | float, y: FloatArray | float, yaw: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Centres of gravity by the true geometry of the hitches, so that units stay coupled.

    Parameters
    ----------
    hitches : sequence of (float, float)
        As `Vehicle.hitches`.
    x, y : float or ndarray, shape (...)
        Centre of gravity of the lead unit in the ground frame, m.
    yaw : ndarray, shape (..., n)
        In rad.

    Returns
    -------
    x, y : ndarray, shape (..., n)
        In m.
    """
    cosine, sine = np.cos(yaw), np.sin(yaw)
    xs, ys = np.empty_like(yaw), np.empty_like(yaw)
    xs[..., 0], ys[..., 0] = x, y
    for index, (rear_hitch, front_hitch) in enumerate(hitches):
        for places, turn in ((xs, cosine), (ys, sine)):
            places[..., index + 1] = (
                places[..., index] + rear_hitch * turn[..., index] - front_hitch * turn[..., index + 1]
            )
    return xs, ys
