"""The linear model of an interlink as Frerichs (2012) printed it, kept so that his tables can be reproduced.

The matrices are those of his Appendix B, term by term, slips included: they are **not** the equations of
motion of the vehicle in his Tables 4 and 5. At trailer 1's hitches e and f are exchanged, the articulation
columns are divided by the speed, trailer 2's inertia terms have wrong signs, and a moment lacks its lever
arm. `docs/report_reproduction.md` shows what follows from that; `yawdamp_ros.dynamics.consistent` is the
model to use for anything else.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from yawdamp_ros.dynamics.errors import DynamicsError
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.vehicle import Vehicle

Number = float | FloatArray

AXLES = (3, 2, 2)
"""Axles of truck, trailer 1 and trailer 2, which the printed matrices are written for."""


@dataclass(frozen=True)
class PublishedMatrices:
    """``mass x' = rates x + steering delta`` with x = [v, r1, r2, r3, theta1, theta2] (Appendix B).

    Attributes
    ----------
    mass : ndarray, shape (6, 6)
        M of the report.
    rates : ndarray, shape (6, 6)
        K of the report, at one speed.
    steering : ndarray, shape (6,)
        B1 of the report, by road-wheel steer angle [rad].
    """

    mass: FloatArray
    rates: FloatArray
    steering: FloatArray


def published_matrices(vehicle: Vehicle, speed: float) -> PublishedMatrices:
    """Fill the printed matrices from a vehicle of the interlink's shape.

    Parameters
    ----------
    vehicle : Vehicle
        Vehicle whose positions become the distances a to j of Table 4.
    speed : float
        Longitudinal speed u [m/s], positive.

    Returns
    -------
    PublishedMatrices

    Raises
    ------
    DynamicsError
        If the vehicle is not of the interlink's shape.
    """
    _check_shape(vehicle)
    truck, trailer_1, trailer_2 = vehicle.units
    (rear_1, front_2), (rear_2, front_3) = vehicle.hitches
    x1, x2, x3, x4, x5, x6, x7 = (axle.position for unit in vehicle.units for axle in unit.axles)
    c1, c2, c3, c4, c5, c6, c7 = (axle.cornering_stiffness for unit in vehicle.units for axle in unit.axles)
    m1, m2, m3 = (unit.mass for unit in vehicle.units)
    i1, i2, i3 = truck.yaw_inertia, trailer_1.yaw_inertia, trailer_2.yaw_inertia
    u = speed
    # Table 4: every one a distance, positive for the interlink.
    a, b, c, d = x1, -rear_1, -x2, x2 - x3
    e, f, g = front_2, -rear_2, x4 - x5
    h, i, j = front_3, -x6, x6 - x7

    t = f * c4 + (f + g) * c5 + e * (c6 + c7)
    r = (h + i) * c6 + (h + i + j) * c7
    s = c1 + c2 + c3 + c4 + c5 + c6 + c7
    trailers = c4 + c5 + c6 + c7

    mass = _array(
        [
            [b * m1, i1, 0, 0, 0, 0],
            [m1 + m2 + m3, -b * (m2 + m3), -f * (m2 + m3) - m3 * e, m3 * h, 0, 0],
            [f * m1 - e * m3, e * m3 * b, m3 * e * (f + e) + i2, m3 * e * h, 0, 0],
            [h * m3, m3 * b * h, m3 * h * (f + e), m3 * h**2 - i3, 0, 0],
            [0, 0, 0, 0, 1, 0],
            [0, 0, 0, 0, 0, 1],
        ]
    )
    rates = _array(
        [
            [
                -((a + b) * c1 + (b - c) * c2 + (b - c - d) * c3) / u,
                -((a + b) * a * c1 - (b - c) * c * c2 - (b - c - d) * (c + d) * c3) / u - b * m1 * u,
                0,
                0,
                0,
                0,
            ],
            [
                -s / u,
                -(a * c1 - c * c2 - (c + d) * c3 - b * trailers) / u - (m1 + m2 + m3) * u,
                (2 * f * c4 + (2 * f + g) * c5 + (e + f) * (c6 + c7)) / u,
                r / u,
                -trailers / u,
                -(c6 + c7) / u,
            ],
            [
                -(f * (c1 + c2 + c3) - t) / u,
                -(f * (a * c1 - c * c2 - (c + d) * c3) + t * b) / u - (f * m1 - e * m3) * u,
                -(2 * f**2 * c4 + (f + g) * (2 * f + g) * c5 + e * (e + f) * (c6 + c7)) / u,
                -e * r / u,
                t / u,
                e * (c6 + c7) / u,
            ],
            [
                -r / u,
                b * r / u - m3 * u,
                (e + f) * r / u,
                ((h + i) ** 2 * c6 + (h + i + j) ** 2 * c7) / u,
                -r / u,
                -r / u,
            ],
            [0, 1, -1, 0, 0, 0],
            [0, 0, 1, -1, 0, 0],
        ]
    )
    steering = _array([[(a + b) * c1, c1, f * c1, 0, 0, 0]])[..., 0, :]
    return PublishedMatrices(mass, rates, steering)


def state_space(vehicle: Vehicle, speed: float) -> tuple[FloatArray, FloatArray]:
    """State and input matrix of the published model, ``A = M^-1 K`` and ``B = M^-1 B1``.

    Parameters
    ----------
    vehicle : Vehicle
        Vehicle with the interlink's layout.
    speed : float
        Longitudinal speed u [m/s], positive.

    Returns
    -------
    state_matrix : ndarray, shape (6, 6)
    input_matrix : ndarray, shape (6,)
        Input matrix for the road-wheel steer angle [rad].

    Raises
    ------
    DynamicsError
        If the vehicle is not of the interlink's shape, or the printed mass matrix cannot be inverted, as
        no true one could be.
    """
    matrices = published_matrices(vehicle, speed)
    try:
        solution = np.linalg.solve(matrices.mass, _beside(matrices.rates, matrices.steering))
    except np.linalg.LinAlgError as error:
        message = f"model: published: its mass matrix is singular for {vehicle.name} with these values"
        raise DynamicsError(message) from error
    solved: FloatArray = np.asarray(solution, dtype=np.float64)
    return solved[..., :-1], solved[..., -1]


def _check_shape(vehicle: Vehicle) -> None:
    axles = tuple(len(unit.axles) for unit in vehicle.units)
    steered = [axle.steered for unit in vehicle.units for axle in unit.axles]
    if axles != AXLES:
        found = f"{vehicle.name} has {len(axles)} unit{'s'[: len(axles) != 1]} with {_listed(axles)} axles"
        expected = f"expected {len(AXLES)} units with {_listed(AXLES)} axles, as the interlink has"
    elif steered != [True, *[False] * (len(steered) - 1)]:
        found = f"{vehicle.name} steers another axle than the foremost"
        expected = "expected the foremost axle alone to be steered"
    elif np.any(vehicle.units[1].axles[0].position != np.asarray(vehicle.units[1].rear_hitch)):
        trailer = vehicle.units[1]
        place = _first(trailer.axles[0].position)
        found = f"{trailer.name} has its rear hitch at {_first(trailer.rear_hitch)} m"
        expected = f"expected it at its first axle, {place} m, where the report has it"
    else:
        return
    message = f"model: published: {found}; {expected}"
    raise DynamicsError(message)


def _array(rows: Sequence[Sequence[Number]]) -> FloatArray:
    """Matrix of numbers, each of one vehicle or with one value for each vehicle of a stack."""
    entries = np.broadcast_arrays(*(entry for row in rows for entry in row))
    matrix = np.stack(entries, axis=-1).astype(np.float64)
    return matrix.reshape(*matrix.shape[:-1], len(rows), len(rows[0]))


def _beside(matrix: FloatArray, column: FloatArray) -> FloatArray:
    stack = np.broadcast_shapes(matrix.shape[:-1], column.shape)
    columns = np.broadcast_to(column, stack)[..., np.newaxis]
    return np.concatenate([np.broadcast_to(matrix, (*stack, matrix.shape[-1])), columns], axis=-1)


def _first(number: Number | None) -> str:
    return f"{np.ravel(np.asarray(number, dtype=np.float64))[0]:g}"


def _listed(counts: tuple[int, ...]) -> str:
    return ", ".join(map(str, counts))
