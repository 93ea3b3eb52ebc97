"""Limits of the powertrain: start and climb on a grade, keep a speed, gain speed.

Forces act at the driven wheels. Friction limits them by the static load of the driven axles; gears change in
no time and rotating masses count for nothing, so that speeds and times are the best that it can do.
"""

import math
from collections.abc import Sequence

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.vehicle import STANDARD_GRAVITY, Vehicle, complete

AIR_DENSITY = 1.2
"""In kg/m^3."""
SLIGHT_GRADE = 0.01
"""Grade on which PBS asks for a speed."""
DISTANCE = 100.0
"""Way from rest in PBS's acceleration capability [m]."""
FASTEST = 70.0
"""In m/s."""


def startability(vehicle: Vehicle) -> float:
    """Steepest grade on which the vehicle starts [%].

    Parameters
    ----------
    vehicle : Vehicle
        Vehicle with ``start_force``.

    Returns
    -------
    float

    Raises
    ------
    AnalysisError
        If the vehicle file lacks a number that this needs; the message names it.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> round(startability(load_vehicle("interlink", ["start_force=1e5"])), 1)
    17.9
    """
    return _steepest(vehicle, _given(vehicle, "start_force", "startability"))


def gradeability(vehicle: Vehicle) -> float:
    """Steepest grade on which the vehicle keeps moving [%].

    Parameters
    ----------
    vehicle : Vehicle
        Vehicle with ``drive_force``.

    Returns
    -------
    float

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> round(gradeability(load_vehicle("interlink", ["drive_force_kN=100"])), 1)
    17.9
    """
    return _steepest(vehicle, _given(vehicle, "drive_force", "gradeability"))


def gradeability_speed(vehicle: Vehicle) -> float:
    """Highest speed on a grade of 1 % [km/h].

    Parameters
    ----------
    vehicle : Vehicle
        Vehicle with ``drive_power`` and ``drive_force``.

    Returns
    -------
    float
        0 where it does not move.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> strong = load_vehicle("interlink", ["drive_force_kN=100", "drive_power_kW=300"])
    >>> 80.0 < gradeability_speed(strong) < 120.0
    True
    """
    thrust = _Thrust(vehicle, "gradeability_speed")

    def surplus(at: float) -> float:
        return thrust.at(at) - thrust.resistance(at, SLIGHT_GRADE)

    if surplus(0.0) <= 0.0:
        return 0.0
    if surplus(FASTEST) >= 0.0:
        return 3.6 * FASTEST
    return 3.6 * float(brentq(surplus, 0.0, FASTEST, xtol=1e-9))


def acceleration_capability(vehicle: Vehicle) -> float:
    """Time for the first 100 m from rest on a level road [s].

    Parameters
    ----------
    vehicle : Vehicle
        Vehicle with ``drive_power`` and ``drive_force``.

    Returns
    -------
    float

    Raises
    ------
    AnalysisError
        If the vehicle file lacks a number, or the vehicle does not move.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> strong = load_vehicle("interlink", ["drive_force_kN=100", "drive_power_kW=300"])
    >>> 10.0 < acceleration_capability(strong) < 20.0
    True
    """
    return float(acceleration_from_rest(vehicle)[0][-1])


def acceleration_from_rest(vehicle: Vehicle) -> tuple[FloatArray, FloatArray]:
    """Motion over the first 100 m from rest on a level road.

    Parameters
    ----------
    vehicle : Vehicle
        Vehicle with ``drive_power`` and ``drive_force``.

    Returns
    -------
    time, way : ndarray, shape (m,)
        In s and m.

    Raises
    ------
    AnalysisError
        If the vehicle file lacks a number, or the vehicle does not move.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> strong = load_vehicle("interlink", ["drive_force_kN=100", "drive_power_kW=300"])
    >>> float(acceleration_from_rest(strong)[1][-1].round(6))
    100.0
    """
    thrust = _Thrust(vehicle, "acceleration_capability")

    def rates(_time: float, state: FloatArray) -> list[float]:
        return [state[1], (thrust.at(state[1]) - thrust.resistance(state[1], 0.0)) / thrust.mass]

    def there(_time: float, state: FloatArray) -> float:
        return float(state[0]) - DISTANCE

    there.terminal = True  # type: ignore[attr-defined]
    if rates(0.0, np.zeros(2))[1] <= 0.0:
        message = f"{vehicle.name}: acceleration_capability: drive_force is less than the rolling resistance"
        raise AnalysisError(message)
    solved = solve_ivp(rates, (0.0, 1e4), [0.0, 0.0], events=there, rtol=1e-9, atol=1e-9, max_step=1.0)
    return solved.t, solved.y[0]


def force_balance(
    vehicle: Vehicle, speeds: FloatArray, grades: Sequence[float]
) -> tuple[FloatArray, list[FloatArray]]:
    """Largest force at the driven wheels, and what grades ask of it.

    Parameters
    ----------
    vehicle : Vehicle
        Vehicle with ``drive_power`` and ``drive_force``.
    speeds : ndarray, shape (m,)
        Speeds [m/s].
    grades : sequence of float
        Rise of the road.

    Returns
    -------
    force : ndarray, shape (m,)
        In N.
    resistances : list of ndarray, shape (m,)
        Resistance on each grade [N].

    Raises
    ------
    AnalysisError
        If the vehicle file lacks a number that this needs.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> strong = load_vehicle("interlink", ["drive_force_kN=100", "drive_power_kW=300"])
    >>> force, (level,) = force_balance(strong, np.array([0.0, 30.0]), [0.0])
    >>> bool(force[0] > level[0])
    True
    """
    thrust = _Thrust(vehicle, "the balance of forces")
    listed = speeds.tolist()
    return (
        np.array([thrust.at(speed) for speed in listed]),
        [np.array([thrust.resistance(speed, grade) for speed in listed]) for grade in grades],
    )


class _Thrust:
    """Forces along a vehicle."""

    def __init__(self, vehicle: Vehicle, measure: str) -> None:
        full = complete(vehicle)
        self._force = min(_given(vehicle, "drive_force", measure), _grip(full))
        self._power = _given(vehicle, "drive_power", measure)
        self.mass = sum(unit.mass for unit in full.units)
        self._drag = 0.5 * AIR_DENSITY * (full.drag_area or 0.0)
        self._rolling = _rolling(full)

    def at(self, speed: float) -> float:
        """Largest force at the driven wheels [N]."""
        return min(self._force, self._power / speed) if speed > 0.0 else self._force

    def resistance(self, speed: float, grade: float) -> float:
        """Force that a speed on a grade takes [N]."""
        weight = STANDARD_GRAVITY * self.mass / math.hypot(1.0, grade)
        return (
            self._rolling * weight / (STANDARD_GRAVITY * self.mass) + weight * grade + self._drag * speed**2
        )


def _steepest(vehicle: Vehicle, force: float) -> float:
    """Steepest grade that a force at the driven wheels holds, or friction does [%]."""
    full = complete(vehicle)
    weight = STANDARD_GRAVITY * sum(unit.mass for unit in full.units)
    rolling = _rolling(full) / weight
    # weight (sin + rolling cos) = force, and on the limit of friction the driven load, too, goes with cos.
    share = force / (weight * math.hypot(1.0, rolling))
    by_force = math.tan(math.asin(share) - math.atan(rolling)) if share < 1.0 else math.inf
    return 100.0 * max(min(by_force, _grip(full) / weight - rolling), 0.0)


def _grip(full: Vehicle) -> float:
    """Friction of the driven axles at rest [N]."""
    driven = (axle.static_load or 0.0 for unit in full.units for axle in unit.axles if axle.driven)
    return (full.friction or 0.0) * sum(driven)


def _rolling(full: Vehicle) -> float:
    """Rolling resistance on a level road [N]."""
    axles = (axle for unit in full.units for axle in unit.axles)
    return sum((axle.rolling_resistance or 0.0) * (axle.static_load or 0.0) for axle in axles)


def _given(vehicle: Vehicle, key: str, measure: str) -> float:
    value: float | None = getattr(vehicle, key)
    if value is None:
        message = f"{measure} needs {key}, which the vehicle file does not give"
        raise AnalysisError(message)
    return value
