"""The single lane change of ISO 14791 and SAE J2179, by inverting the model."""

import functools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from yawdamp_ros.analysis.answers import stack_of
from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.analysis.motion import free_motion, stacked_exponential
from yawdamp_ros.dynamics import LinearModel, split_outputs
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.stepping import Response
from yawdamp_ros.vehicle import Vehicle

SAMPLE_PERIOD = 0.005
"""Sample period of a run [s]; the motion is exact for any."""

DURATION = 12.0
"""Duration of a run [s], from the start of the lane change until the last unit rests in its lane."""


@dataclass(frozen=True)
class SingleLaneChange:
    """One sine period of lateral acceleration at the front axle, ``a = amplitude sin(2 pi frequency t)``.

    SAE J2179 and ISO 14791, of which only catalogue pages and secondary sources were readable.

    Attributes
    ----------
    amplitude : float
        Amplitude [m/s^2].
    frequency : float
        Frequency [Hz].

    Examples
    --------
    >>> from yawdamp_ros.analysis import SAE_J2179
    >>> SAE_J2179.frequency
    0.4
    """

    amplitude: float
    frequency: float

    @property
    def displacement(self) -> float:
        """Lateral displacement, ``amplitude / (2 pi frequency^2)`` [m]."""
        return self.amplitude / (2.0 * np.pi * self.frequency**2)

    def path(self, time: FloatArray) -> FloatArray:
        """Lateral position of the front axle in m at times in s from the beginning."""
        phase = 2.0 * np.pi * np.clip(np.asarray(time) * self.frequency, 0.0, 1.0)
        return np.asarray(self.displacement * (phase - np.sin(phase)) / (2.0 * np.pi), dtype=np.float64)


SAE_J2179 = SingleLaneChange(amplitude=0.15 * 9.81, frequency=0.4)
"""0.15 g over 2.5 s. Its printed displacement, 1.464 m, takes g as 9.81 m/s^2; it takes 61.1 m of road."""

SAE_J2179_SPEED = 88.0 / 3.6
"""In m/s."""


def steer_axle_position(vehicle: Vehicle) -> float:
    """Return the position of the foremost steered axle of the lead unit, or of each of a stack.

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    float
        Position from the centre of gravity of the unit, forward positive [m].

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> from yawdamp_ros.analysis import steer_axle_position
    >>> steer_axle_position(load_vehicle("interlink"))
    0.04
    """
    positions = [axle.position for axle in vehicle.units[0].axles if axle.steered]
    foremost: float = functools.reduce(np.maximum, positions)
    return foremost


def run_lane_change(
    model: LinearModel, change: SingleLaneChange = SAE_J2179, duration: float = DURATION
) -> Response:
    """Return the motion of a vehicle whose steer axle follows the lane change.

    Parameters
    ----------
    model : LinearModel
    change : SingleLaneChange
    duration : float
        Duration from the beginning of the lane change [s].

    Returns
    -------
    Response
        With the steer angle that it takes.

    Raises
    ------
    AnalysisError
        If the vehicle is unstable, or the units behind an axle that follows the path would swing out without
        bound (a zero of the model in the right half plane): no steering holds it on the path, then.

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> model = linear_model(load_vehicle("a_double"))
    >>> from yawdamp_ros.analysis import run_lane_change
    >>> response = run_lane_change(model)
    >>> float(abs(response.lateral_acceleration[:, 0]).max().round(2))
    1.65
    """
    run = LaneChangeRuns(stack_of(model), change, duration)
    if run.reasons:
        raise AnalysisError(run.reasons[0])
    outputs = split_outputs(run.outputs(range(len(model.output_names)))[0].T, len(model.vehicle.units))
    paths = run.paths()
    return Response(
        unit_names=model.vehicle.unit_names,
        time=run.time,
        steering_angle=run.steering()[0],
        yaw=paths.yaw[0],
        yaw_rate=outputs.yaw_rate,
        lateral_acceleration=outputs.lateral_acceleration,
        articulation=outputs.articulation,
        x=paths.x[0],
        y=paths.y[0],
    )


class Paths(NamedTuple):
    """Centres of gravity of n units of k vehicles at m instants.

    Attributes
    ----------
    yaw : ndarray, shape (k, m, n)
        Yaw angles [rad].
    x, y : ndarray, shape (k, m, n)
        Coordinates [m].
    """

    yaw: FloatArray
    x: FloatArray
    y: FloatArray


class LaneChangeRuns:
    """Runs of a stack of vehicles, each along the path that its steer axle follows.

    The lateral acceleration of a steered axle contains the steer angle directly, so that the model can be
    solved for the angle that a given acceleration takes. Sine, states and yaw form one linear system, whose
    motion is exact at every sample; the ground path is the only quadrature.

    Parameters
    ----------
    model : LinearModel
        Model of a stack of k vehicles.
    change : SingleLaneChange
    duration : float
        Duration from the beginning of the lane change [s].

    Attributes
    ----------
    time : ndarray, shape (m,)
        Time [s].
    reasons : dict of int to str
        Reasons for missing runs by index of the vehicle; the values of such a run have no meaning.
    """

    def __init__(
        self, model: LinearModel, change: SingleLaneChange = SAE_J2179, duration: float = DURATION
    ) -> None:
        self._model = model
        self._count, self._size = model.input_matrix.shape
        instants = round(duration / SAMPLE_PERIOD) + 1
        self.time: FloatArray = np.arange(instants, dtype=np.float64) * SAMPLE_PERIOD
        position = np.asarray(steer_axle_position(model.vehicle), dtype=np.float64)[..., np.newaxis]
        output = 2 * len(model.vehicle.units)
        # a_y + x r' of the lead unit
        self._row = model.output_matrix[:, output] + position * model.state_matrix[:, 1]
        self._direct = model.feedthrough[:, output, np.newaxis] + position * model.input_matrix[:, 1:2]
        self._inputs = model.input_matrix / self._direct
        closed = model.state_matrix - self._inputs[:, :, np.newaxis] * self._row[:, np.newaxis]
        self.reasons = self._refusals(closed)
        self._rates = self._system(closed, 2.0 * np.pi * change.frequency)
        # A vehicle that cannot be held on the path would overflow.
        self._rates[list(self.reasons)] = 0.0
        period = 1.0 / change.frequency
        self._turning = min(int(np.floor(period / SAMPLE_PERIOD)) + 1, instants)
        self._start = np.zeros((self._count, self._size + 3))
        self._start[:, -1] = change.amplitude
        # The axle keeps its lane from the end of the sine on; that end need not be at a sample.
        end = (stacked_exponential(self._rates * period) @ self._start[..., np.newaxis])[..., 0]
        end[:, -2:] = 0.0
        rest = stacked_exponential(self._rates * (self._turning * SAMPLE_PERIOD - period))
        self._coasting = (rest @ end[..., np.newaxis])[..., 0]

    def outputs(self, indices: Sequence[int]) -> FloatArray:
        """Some of the model's outputs, shape (k, len(indices), m)."""
        chosen = list(indices)
        known = self._model.output_matrix[:, chosen]
        through = self._model.feedthrough[:, chosen]
        return self._motion(self._rows(known, through))

    def steering(self) -> FloatArray:
        """Road-wheel steer angles [rad], shape (k, m)."""
        none = np.zeros((self._count, 1, self._size))
        return self._motion(self._rows(none, np.ones((self._count, 1))))[:, 0]

    def paths(self) -> Paths:
        """Ground paths, which begin along x."""
        units = len(self._model.vehicle.units)
        needed = np.zeros((self._count, units + 1, self._size + 3))
        needed[:, 0, 0] = 1.0  # lateral velocity of the lead unit
        needed[:, 1, self._size] = 1.0  # its yaw
        needed[:, 2:, units + 1 : self._size] = np.eye(units - 1)
        motion = self._motion(needed)
        yaw = motion[:, 1:].copy()
        for unit in range(1, units):
            yaw[:, unit] = yaw[:, unit - 1] - motion[:, unit + 1]
        cosine, sine = np.cos(yaw), np.sin(yaw)
        speed = np.broadcast_to(self._model.speed, self._count)[:, np.newaxis]
        x, y = np.empty_like(yaw), np.empty_like(yaw)
        x[:, 0] = _summed(speed * cosine[:, 0] - motion[:, 0] * sine[:, 0])
        y[:, 0] = _summed(speed * sine[:, 0] + motion[:, 0] * cosine[:, 0])
        for unit, hitches in enumerate(self._model.vehicle.hitches):
            rear, front = (np.asarray(hitch, dtype=np.float64)[..., np.newaxis] for hitch in hitches)
            for places, parts in ((x, cosine), (y, sine)):
                places[:, unit + 1] = places[:, unit] + rear * parts[:, unit] - front * parts[:, unit + 1]
        return Paths(*(part.transpose(0, 2, 1) for part in (yaw, x, y)))

    def _motion(self, rows: FloatArray) -> FloatArray:
        driven = free_motion(self._rates, self._start, SAMPLE_PERIOD, self._turning, rows)
        left = len(self.time) - self._turning
        if not left:
            return driven
        coasting = free_motion(self._rates, self._coasting, SAMPLE_PERIOD, left, rows)
        return np.concatenate([driven, coasting], axis=2)

    def _rows(self, known: FloatArray, through: FloatArray) -> FloatArray:
        """Rows, by states and acceleration, of outputs by states and steering."""
        rows = np.zeros((*known.shape[:2], self._size + 3))
        # Steering that gives the acceleration.
        by_angle = through / self._direct
        rows[..., : self._size] = known - by_angle[..., np.newaxis] * self._row[:, np.newaxis]
        rows[..., -2] = by_angle
        return rows

    def _system(self, closed: FloatArray, frequency: float) -> FloatArray:
        """Rates of [states, yaw of the lead unit, acceleration, its quarter turn]."""
        states = self._size
        rates = np.zeros((self._count, states + 3, states + 3))
        rates[:, :states, :states] = closed
        rates[:, :states, -2] = self._inputs
        rates[:, states, 1] = 1.0
        rates[:, -2, -1], rates[:, -1, -2] = frequency, -frequency
        return rates

    def _refusals(self, closed: FloatArray) -> dict[int, str]:
        """Reasons why no steering leads a vehicle through a lane change."""
        unstable = np.linalg.eigvals(self._model.state_matrix).real.max(axis=1) >= 0.0
        zeros = np.linalg.eigvals(closed).real.max(axis=1)
        speeds = np.broadcast_to(self._model.speed, self._count)
        reasons = {}
        for index in np.flatnonzero(unstable | (zeros >= 0.0)).tolist():
            name = f"{self._model.vehicle.name} at {speeds[index]:.4g} m/s"
            reasons[index] = (
                f"{name}: unstable: there is no lane change to measure"
                if unstable[index]
                else f"{name}: its steer axle cannot be held on a lane change: a zero at "
                f"{zeros[index]:.4g} 1/s lets the vehicle swing out behind it"
            )
        return reasons


def _summed(velocity: FloatArray) -> FloatArray:
    """Distance from the start, by the trapezoidal rule, shape (k, m) [m]."""
    way = np.zeros_like(velocity)
    np.cumsum(0.5 * SAMPLE_PERIOD * (velocity[:, 1:] + velocity[:, :-1]), axis=1, out=way[:, 1:])
    return way
