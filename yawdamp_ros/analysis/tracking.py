"""Tracking ability on a straight path: what a combination sweeps on a rough road with a crossfall.

The mean motion is that of the nonlinear model on the crossfall. About it the model is linear, and the road's
roughness a stationary Gaussian input (`roughness`), so that what every corner does has a spectrum, and the
percentile of the swept width follows without a run. Three ways of the road into the motion are modelled:

* an axle stands on the crossfall under its own wheels: its load pulls it down that slope;
* the axle's roll springs and dampers turn the body with that slope;
* the load of an axle varies with the height of the road, and with it the lateral force that the mean
  crossfall asks of it.

A driver aims the steered axle at the point of its line that lies `PREVIEW` ahead. Left out are roll steer,
for which the vehicle file has no key, the hop of the wheels, which is too quick to move the bodies, and what
a driver does of his own accord.
"""

import math
from typing import NamedTuple

import numpy as np
from scipy.special import ndtri

from yawdamp_ros.analysis.bodies import corners, lateral_positions, straight_places
from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.analysis.lane_change import steer_axle_position
from yawdamp_ros.analysis.roughness import track_spectra, unevenness_of
from yawdamp_ros.dynamics.kinematics import ComplexArray, FloatArray, IntArray
from yawdamp_ros.nonlinear import NonlinearDynamics, NonlinearError, linearise, steady_turn
from yawdamp_ros.nonlinear.pushes import push_response
from yawdamp_ros.nonlinear.records import (
    FRONT_ARM,
    HALF_TRACK,
    POSITION,
    REAR_ARM,
    ROLL_DAMPING,
    ROLL_STIFFNESS,
    STIFFNESS_RATE,
    STIFFNESS_SLOPE,
)
from yawdamp_ros.nonlinear.steady import SteadyTurn
from yawdamp_ros.vehicle import STANDARD_GRAVITY, Vehicle

CROSSFALL = 0.03
"""Mean crossfall of the road."""
INDEX = 0.0038
"""International Roughness Index of both wheel tracks [m/m]."""
LENGTH = 1000.0
"""Length of the road [m], and of its longest wave."""
SHORTEST = 1.0
"""Length of its shortest wave [m]: 25 Hz at 90 km/h."""
PERCENTILE = 0.99
"""Share of the road on which less is swept."""
PREVIEW = 1.0
"""Time by which the driver looks ahead [s]."""
BOUNCE, BOUNCE_DAMPING = 2.0, 0.2
"""Natural frequency [Hz] and damping ratio of the bodies on their springs: 96/53/EC, annex II, allows at most
and demands at least these of road-friendly suspensions."""

_WAVENUMBERS = math.tau * np.geomspace(1.0 / LENGTH, 1.0 / SHORTEST, 200)
_WEIGHTS = 0.5 * (
    np.diff(_WAVENUMBERS, prepend=_WAVENUMBERS[0]) + np.diff(_WAVENUMBERS, append=_WAVENUMBERS[-1])
)


class Tracking(NamedTuple):
    """Sweep of a combination on the rough road.

    Attributes
    ----------
    width : float
        Swept width [m] that `PERCENTILE` of the road is within.
    steady : float
        Swept width without roughness [m].
    mean, spread : ndarray, shape (k,)
        Mean lateral position of the k corners [m], to the left positive, and the distance from it, to one
        side, that `PERCENTILE` of the road is within.
    """

    width: float
    steady: float
    mean: FloatArray
    spread: FloatArray


def tracking_ability_on_a_straight_path(vehicle: Vehicle, speed: float) -> float:
    """Width that the bodies sweep on a straight rough road with a crossfall of 3 % [m].

    Parameters
    ----------
    vehicle : Vehicle
    speed : float
        Speed [m/s].

    Returns
    -------
    float

    Raises
    ------
    AnalysisError
        As of `tracking`.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> tracking_ability_on_a_straight_path(load_vehicle("interlink"), 25.0) > 2.55  # its width
    True
    """
    return tracking(vehicle, speed).width


def tracking(vehicle: Vehicle, speed: float, index: float = INDEX) -> Tracking:
    """Sweep of a combination on a straight rough road.

    Corners pass a place one after the other; the width there lies between the outermost of them. Its
    percentile is taken as that of the two corners for which it is largest.

    Parameters
    ----------
    vehicle : Vehicle
    speed : float
        Speed [m/s].
    index : float
        International Roughness Index of both wheel tracks [m/m].

    Returns
    -------
    Tracking

    Raises
    ------
    AnalysisError
        If there is no steady motion at that speed, or the driver cannot hold the line.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> found = tracking(load_vehicle("interlink"), 25.0)
    >>> bool(found.width > found.steady)
    True
    """
    dynamics = NonlinearDynamics(vehicle)
    try:
        steady = steady_turn(dynamics, speed, dynamics.inputs(crossfall=CROSSFALL), lateral_acceleration=0.0)
    except NonlinearError as error:
        raise AnalysisError(str(error)) from error
    forward, sideways = steady.outputs.velocity[0, 0]
    mean = lateral_positions(vehicle, steady.outputs, math.atan2(sideways, forward))[0]
    track = 2.0 * float(dynamics.parameters.axles[:, HALF_TRACK].mean())
    height, crossfall = track_spectra(unevenness_of(index), _WAVENUMBERS, track)
    moved = corner_response(dynamics, steady, _WAVENUMBERS)

    spectra = np.column_stack([crossfall, height]) * _WEIGHTS[:, np.newaxis]
    covariance = np.einsum("imk,jmk,mk->ij", moved, moved.conj(), spectra).real
    variance = np.diag(covariance)
    apart = variance[:, np.newaxis] + variance - 2.0 * covariance
    quantile = float(ndtri(PERCENTILE))
    widths = mean[:, np.newaxis] - mean + quantile * np.sqrt(np.maximum(apart, 0.0))
    return Tracking(float(widths.max()), float(np.ptp(mean)), mean, quantile * np.sqrt(variance))


def corner_response(dynamics: NonlinearDynamics, steady: SteadyTurn, wavenumbers: FloatArray) -> ComplexArray:
    """Lateral amplitude of every corner where it passes the lead unit's centre of gravity's place.

    Parameters
    ----------
    dynamics : NonlinearDynamics
    steady : SteadyTurn
        Straight motion about which the response is taken.
    wavenumbers : ndarray, shape (m,)
        Wavenumbers of the road [rad/m].

    Returns
    -------
    ndarray of complex, shape (k, m, 2)
        For k corners, by the local crossfall [m] and by the height of the road [1].

    Raises
    ------
    AnalysisError
        If the driver cannot hold the line.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> car = NonlinearDynamics(load_vehicle("single_vehicle"))
    >>> straight = steady_turn(car, 25.0, car.inputs(), lateral_acceleration=0.0)
    >>> corner_response(car, straight, np.array([0.1, 1.0])).shape
    (4, 2, 2)
    """
    vehicle, layout = dynamics.vehicle, dynamics.layout
    speed = float(steady.state[layout.velocity.start])
    matrix, free = _with_driver(dynamics, steady, speed)
    if np.linalg.eigvals(matrix).real.max() >= 0.0:
        message = (
            f"{vehicle.name}: no driver who looks {PREVIEW:g} s ahead holds it on a line at {speed:.4g} m/s"
        )
        raise AnalysisError(message)
    places = straight_places(vehicle)
    rates = (1j * speed * wavenumbers).astype(np.complex128)
    inputs = np.zeros((len(rates), len(matrix), 2), dtype=complex)
    inputs[:, : len(free)] = road_rates(dynamics, steady, rates, places / speed)[:, free]
    states = np.linalg.solve(rates[:, np.newaxis, np.newaxis] * np.eye(len(matrix)) - matrix, inputs)
    rolls = [int(np.flatnonzero(free == index)[0]) for index in range(layout.roll.start, layout.roll.stop)]
    arms = dynamics.parameters.units
    moved = []
    for unit, corner in corners(vehicle):
        place = places[unit] + corner.real
        row = np.zeros(len(matrix))
        row[-2], row[-1] = 1.0, place
        for joint in range(unit):
            # All behind a joint turns about it, and stands aside as roll moves both its parts.
            row[joint] = places[joint] + vehicle.hitches[joint][0] - place
            row[rolls[joint]] -= arms[joint, REAR_ARM]
            row[rolls[joint + 1]] += arms[joint + 1, FRONT_ARM]
        passing = np.exp(-1j * wavenumbers * place)
        moved.append(passing[:, np.newaxis] * np.einsum("k,mki->mi", row, states))
    return np.array(moved)


def road_rates(
    dynamics: NonlinearDynamics, steady: SteadyTurn, rates: ComplexArray, leads: FloatArray
) -> ComplexArray:
    """Rates of the state by the local crossfall and by the height of the road.

    Parameters
    ----------
    dynamics : NonlinearDynamics
    steady : SteadyTurn
        Straight motion on the mean crossfall.
    rates : ndarray of complex, shape (m,)
        Exponents ``s`` of the road's ``exp(s t)`` under the lead unit's centre of gravity [1/s].
    leads : ndarray, shape (n,)
        Times by which the centre of gravity of each unit reaches a place earlier [s].

    Returns
    -------
    ndarray of complex, shape (m, k, 2)
        For k elements of the state, per unit of crossfall and per metre of height.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> car = NonlinearDynamics(load_vehicle("single_vehicle"))
    >>> straight = steady_turn(car, 25.0, car.inputs(), lateral_acceleration=0.0)
    >>> road_rates(car, straight, np.array([0j, 1j]), np.zeros(1)).shape == (2, car.layout.size, 2)
    True
    """
    response = push_response(dynamics, steady.state, steady.inputs)
    speed, axles = float(steady.state[dynamics.layout.velocity.start]), dynamics.parameters.axles
    force, loads = (
        wheels[0].reshape(-1, 2).sum(axis=1)
        for wheels in (steady.outputs.lateral_force, steady.outputs.wheel_load)
    )
    frequency = math.tau * BOUNCE
    link = 2.0 * BOUNCE_DAMPING * frequency * rates + frequency**2
    bounce = rates**2 * link / (rates**2 + link) / STANDARD_GRAVITY
    found = np.zeros((len(rates), dynamics.layout.size, 2), dtype=complex)
    for unit, lead in enumerate(leads):
        for place in range(*dynamics.parameters.first_axle[unit : unit + 2]):
            axle = axles[place]
            sideways = response[:, unit, 0] + axle[POSITION] * response[:, unit, 1]
            turning = (axle[ROLL_STIFFNESS] + rates * axle[ROLL_DAMPING])[:, np.newaxis] * response[
                :, unit, 2
            ]
            softer = axle[STIFFNESS_SLOPE] * 0.5 * loads[place]
            varied = force[place] * (axle[STIFFNESS_RATE] - 2.0 * softer) / (axle[STIFFNESS_RATE] - softer)
            passing = np.exp(rates * (lead + axle[POSITION] / speed))[:, np.newaxis]
            found[..., 0] += passing * (turning - loads[place] * sideways)
            found[..., 1] += passing * bounce[:, np.newaxis] * varied * sideways
    return found


def _with_driver(
    dynamics: NonlinearDynamics, steady: SteadyTurn, speed: float
) -> tuple[FloatArray, IntArray]:
    """State matrix with position and yaw of the lead unit as its last states, steered by the driver."""
    linear = linearise(dynamics, steady.state, steady.inputs)
    layout, ahead = dynamics.layout, speed * PREVIEW
    count = len(linear.states)
    matrix = np.zeros((count + 2, count + 2))
    matrix[:count, :count] = linear.state_matrix
    matrix[:count, count] = -linear.input_matrix / ahead
    matrix[:count, -1] = -linear.input_matrix * (1.0 + steer_axle_position(dynamics.vehicle) / ahead)
    matrix[count, :count][linear.states == layout.velocity.start + 1] = 1.0
    matrix[count, -1] = speed
    matrix[-1, :count][linear.states == layout.yaw_rate.start] = 1.0
    return matrix, linear.states
