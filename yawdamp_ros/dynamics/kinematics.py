"""Kinematics of the units of a combination."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from yawdamp_ros.vehicle import Vehicle

FloatArray = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]
IntArray = npt.NDArray[np.int64]


def cg_rows(vehicle: Vehicle) -> FloatArray:
    """Lateral position of every centre of gravity in terms of the generalised coordinates.

    For small angles unit k lies at ``y_k = rows[k] @ [y, psi_1 .. psi_n]``.

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    ndarray, shape (..., n, n + 1)
        First column 1, the others lever arms [m]; of a stack whose hitches differ, one matrix a vehicle.
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
    hitches: Sequence[tuple[float, float]], lead: ComplexArray, heading: ComplexArray
) -> ComplexArray:
    """Centres of gravity by the true geometry of the hitches, so that units stay coupled.

    Parameters
    ----------
    hitches : sequence of (float, float)
        Hitches, as in `Vehicle.hitches`.
    lead : ndarray of complex, shape (...)
        ``x + i y`` of the lead unit's centre of gravity in the ground frame, m.
    heading : ndarray of complex, shape (..., n)
        ``cos(yaw) + i sin(yaw)`` of every unit.

    Returns
    -------
    ndarray of complex, shape (..., n)
        ``x + i y`` of every unit, m.
    """
    positions = np.empty_like(heading)
    headings, place = _by_unit(heading), complex(lead) if heading.ndim == 1 else lead
    positions[..., 0] = place
    for index, (rear_hitch, front_hitch) in enumerate(hitches):
        hitch = place + rear_hitch * headings[index]
        place = hitch - front_hitch * headings[index + 1]
        positions[..., index + 1] = place
    return positions


def coupled_velocities(
    hitches: Sequence[tuple[float, float]],
    lead: tuple[FloatArray | float, FloatArray],
    yaw_rate: FloatArray,
    heading: ComplexArray,
) -> ComplexArray:
    """Velocities of the centres of gravity by the true geometry of the hitches, each in its unit's own frame.

    They are the rates of `coupled_positions`, at any articulation.

    Parameters
    ----------
    hitches : sequence of (float, float)
        Hitches, as in `Vehicle.hitches`.
    lead : (float or ndarray, ndarray)
        Longitudinal and lateral velocity of the lead unit, m/s, shape (...); the first may be common to all.
    yaw_rate : ndarray, shape (..., n)
        rad/s.
    heading : ndarray of complex, shape (..., n)
        ``cos(yaw) + i sin(yaw)`` of every unit.

    Returns
    -------
    ndarray of complex, shape (..., n)
        Longitudinal and lateral velocity as real and imaginary part [m/s].
    """
    velocities = np.empty_like(heading)
    along, across = velocities.real, velocities.imag
    forward, sideways = lead[0], float(lead[1]) if heading.ndim == 1 else lead[1]
    along[..., 0], across[..., 0] = forward, sideways
    # No products of two complex numbers: NumPy rounds them differently at the end of an array.
    east, north, rates = _by_unit(heading.real), _by_unit(heading.imag), _by_unit(yaw_rate)
    for index, (rear_hitch, front_hitch) in enumerate(hitches):
        ahead, behind = index, index + 1
        cosine = east[ahead] * east[behind] + north[ahead] * north[behind]
        sine = north[ahead] * east[behind] - east[ahead] * north[behind]
        at_hitch = sideways + rear_hitch * rates[ahead]
        forward, sideways = (
            forward * cosine - at_hitch * sine,
            forward * sine + at_hitch * cosine - front_hitch * rates[behind],
        )
        along[..., behind], across[..., behind] = forward, sideways
    return velocities


def _by_unit(values: Any) -> Any:  # noqa: ANN401 - numbers or arrays, of which the arithmetic is the same
    """Values of each unit; of one instant as Python's numbers, which take a fraction of the time."""
    return values.tolist() if values.ndim == 1 else np.moveaxis(values, -1, 0)
