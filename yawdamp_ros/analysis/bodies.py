"""Corners of the bodies of a combination, and what they sweep on a straight road."""

import numpy as np

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.nonlinear import Outputs
from yawdamp_ros.vehicle import Vehicle, complete
from yawdamp_ros.vehicle.shape import extent


def corners(vehicle: Vehicle) -> tuple[tuple[int, complex], ...]:
    """Corners of every body: the unit's index, and the place from its centre of gravity, x + i y [m].

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    tuple of (int, complex)

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> len(corners(load_vehicle("interlink")))
    12
    """
    found = []
    for index, unit in enumerate(complete(vehicle).units):
        tail, nose = extent(unit)
        for end in (nose + (unit.front_overhang or 0.0), tail - (unit.rear_overhang or 0.0)):
            found += [(index, complex(end, side * (unit.width or 0.0))) for side in (-0.5, 0.5)]
    return tuple(found)


def straight_places(vehicle: Vehicle) -> FloatArray:
    """Places of the centres of gravity along a straight combination, from the lead unit's.

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    ndarray, shape (n,)
        In m, to the front positive.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> places = straight_places(load_vehicle("interlink"))
    >>> bool(places[0] == 0.0 > places[1] > places[2])
    True
    """
    return np.cumsum([0.0, *(rear - front for rear, front in vehicle.hitches)])


def lateral_positions(vehicle: Vehicle, found: Outputs, direction: float) -> FloatArray:
    """Lateral positions of all corners across a direction.

    Parameters
    ----------
    vehicle : Vehicle
    found : Outputs
        Outputs of m instants.
    direction : float
        Angle of the direction from X [rad].

    Returns
    -------
    ndarray, shape (m, corners)
        In m, to the left positive.

    Examples
    --------
    >>> from yawdamp_ros.analysis.nonlinear_runs import drive
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> car = load_vehicle("single_vehicle")
    >>> straight = drive(car, 20.0, np.zeros(101)).outputs
    >>> float(np.ptp(lateral_positions(car, straight, 0.0)[-1]).round(3))
    1.7
    """
    across = []
    for index, corner in corners(vehicle):
        centre = found.position[:, index, 0] + 1j * found.position[:, index, 1]
        point = centre + corner * np.exp(1j * found.yaw[:, index])
        across.append((point * np.exp(-1j * direction)).imag)
    return np.array(across).T
