"""How the units of a combination move together."""

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
    ndarray, shape (n, n + 1)
        First column 1, the others lever arms in m.
    """
    count = len(vehicle.units)
    rows = np.zeros((count, count + 1))
    rows[:, 0] = 1.0
    for index, (rear_hitch, front_hitch) in enumerate(vehicle.hitches):
        rows[index + 1] = rows[index]
        rows[index + 1, index + 1] += rear_hitch
        rows[index + 1, index + 2] -= front_hitch
    return rows
