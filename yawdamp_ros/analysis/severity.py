"""Stability over severity: the nonlinear model linearised in ever harder steady turns."""

import math
from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

import numpy as np

from yawdamp_ros.analysis.eigenmodes import ComplexArray
from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.nonlinear import NonlinearDynamics, NonlinearError, SteadyTurn, linearise, steady_turn
from yawdamp_ros.vehicle import STANDARD_GRAVITY, Vehicle
from yawdamp_ros.vehicle.statics import supports

SLOWEST_TURN = 1e-3
"""Lateral acceleration of the first turn [m/s^2]: straight running, as far as numbers tell."""
FASTEST_MODE = 60.0
"""Undamped frequency beyond which a mode is a tyre's or the suspension's, not the combination's [rad/s]."""


class Severity(NamedTuple):
    """Steady turns from gentle to hard; m turns of n units.

    Attributes
    ----------
    vehicle : Vehicle
    speed : float
        Speed [m/s].
    lateral_acceleration : ndarray, shape (m,)
        Speed times yaw rate [m/s^2].
    braking : ndarray, shape (m,)
        Deceleration demanded of all brakes [m/s^2].
    steering : ndarray, shape (m,)
        Road-wheel steer angle [rad].
    eigenvalues : ndarray of complex, shape (m, k)
        Eigenvalues of the model linearised in each turn [1/s], by rising real part.
    handling : ndarray, shape (m, n)
        Handling diagram [rad]: for the lead unit the steer angle minus the Ackermann angle, for a towed unit
        the side slip angle at the middle of its axles.
    roll, load_transfer_ratio : ndarray, shape (m, n)
        Roll [rad].
    limit : str
        Reason that no harder turn exists; empty if the last one is the requested one.
    """

    vehicle: Vehicle
    speed: float
    lateral_acceleration: FloatArray
    braking: FloatArray
    steering: FloatArray
    eigenvalues: ComplexArray
    handling: FloatArray
    roll: FloatArray
    load_transfer_ratio: FloatArray
    limit: str

    @property
    def values(self) -> FloatArray:
        """The acceleration that rises from one to the next, of turning or else of braking, shape (m,)."""
        return self.braking if self.straight else self.lateral_acceleration

    @property
    def straight(self) -> bool:
        """True if there is no turn, but ever harder braking."""
        return bool(self.lateral_acceleration[-1] <= SLOWEST_TURN) and len(self.braking) > 1

    @property
    def stable(self) -> bool:
        """True if every turn is reached and every eigenvalue of it lies in the left half plane."""
        return not self.limit and bool((self.eigenvalues.real < 0.0).all())

    @property
    def least_damping_ratio(self) -> FloatArray:
        """Least damping ratio of each turn among the modes slower than `FASTEST_MODE`, shape (m,)."""
        size = np.abs(self.eigenvalues)
        ratio = -self.eigenvalues.real / np.where(size > 0.0, size, 1.0)
        return np.asarray(np.where(size < FASTEST_MODE, ratio, 1.0).min(axis=1))


def severity(  # noqa: PLR0913 - each is one condition of the turn
    vehicle: Vehicle,
    lateral_acceleration: float,
    *,
    speed: float | None = None,
    friction: float | None = None,
    braking: float = 0.0,
    turns: int = 21,
    progress: Callable[[Sequence[float]], Iterable[float]] = iter,
) -> Severity:
    """Linearise the nonlinear model in steady turns up to a lateral acceleration.

    Each turn is found by `scipy.optimize.root`. Braking at a constant speed is braking downhill: a grade of
    braking over gravity loads axles and tyres as the deceleration does.

    Parameters
    ----------
    vehicle : Vehicle
    lateral_acceleration : float
        Lateral acceleration of the hardest turn, to the left [m/s^2]; 0 for ever harder straight braking.
    speed : float, optional
        Speed [m/s]; the vehicle's own unless given.
    friction : float, optional
        Friction of the road; the vehicle's own unless given.
    braking : float
        Deceleration demanded of all brakes [m/s^2], the same in every turn.
    turns : int
        Number of turns, evenly apart.
    progress : callable, optional
        Function that iterates over the shares of the hardest turn and shows its progress.

    Returns
    -------
    Severity

    Raises
    ------
    AnalysisError
        If not even the gentlest turn is found.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> found = severity(load_vehicle("interlink"), 1.0, speed=20.0, turns=3)
    >>> found.stable
    True
    """
    dynamics = NonlinearDynamics(vehicle)
    chosen = vehicle.speed if speed is None else speed
    turning = lateral_acceleration > SLOWEST_TURN
    shares = np.linspace(0.0, 1.0, turns if turning or braking else 1).tolist()
    wanted = [max(share * lateral_acceleration, SLOWEST_TURN) for share in shares]
    brakings = [braking if turning else share * braking for share in shares]
    found: list[SteadyTurn] = []
    poles: list[ComplexArray] = []
    limit = ""
    for share in progress(shares):
        acceleration, deceleration = wanted[len(found)], brakings[len(found)]
        grade = -math.tan(math.asin(deceleration / STANDARD_GRAVITY))
        inputs = dynamics.inputs(friction=friction, acceleration=-deceleration, grade=grade)
        try:
            turn = steady_turn(dynamics, chosen, inputs, lateral_acceleration=acceleration)
        except NonlinearError as error:
            if not found:
                raise AnalysisError(str(error)) from error
            hardest = lateral_acceleration if turning else braking
            limit = (
                f"no steady motion at {share * hardest:.3g} m/s^2 of {'turning' if turning else 'braking'}"
            )
            break
        found.append(turn)
        matrix = linearise(dynamics, turn.state, turn.inputs).state_matrix
        values = np.linalg.eigvals(matrix).astype(np.complex128)
        poles.append(values[np.argsort(values.real, kind="stable")])
    return Severity(
        vehicle=vehicle,
        speed=chosen,
        lateral_acceleration=np.array(wanted[: len(found)]),
        braking=np.array(brakings[: len(found)]),
        steering=np.array([turn.inputs[0] for turn in found]),
        eigenvalues=np.array(poles),
        handling=np.array([_handling(vehicle, turn) for turn in found]),
        roll=np.array([turn.outputs.roll[0] for turn in found]),
        load_transfer_ratio=np.array([turn.outputs.load_transfer_ratio[0] for turn in found]),
        limit=limit,
    )


def _handling(vehicle: Vehicle, turn: SteadyTurn) -> FloatArray:
    """Handling of every unit in a turn; see `Severity`."""
    values = np.zeros(len(vehicle.units))
    for index, unit in enumerate(vehicle.units):
        forward, sideways = turn.outputs.velocity[0, index]
        yaw_rate = turn.outputs.yaw_rate[0, index]
        held = supports(unit)
        slip = -np.arctan2(sideways + held.rear * yaw_rate, forward)
        if index == 0:
            ackermann = (held.front - held.rear) * yaw_rate / forward
            values[index] = turn.inputs[0] - ackermann
        else:
            values[index] = slip
    return values
