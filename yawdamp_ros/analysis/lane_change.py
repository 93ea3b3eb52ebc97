"""The single lane change of ISO 14791 and SAE J2179, by inverting the model."""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import cumulative_trapezoid
from scipy.linalg import expm

from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.analysis.motion import free_motion
from yawdamp_ros.dynamics import LinearModel, split_outputs
from yawdamp_ros.dynamics.kinematics import FloatArray, coupled_positions
from yawdamp_ros.stepping import Response
from yawdamp_ros.vehicle import Axle, Vehicle

SAMPLE_PERIOD = 0.005
"""Of a run in s; the motion is exact at any."""

DURATION = 12.0
"""Of a run in s, from the beginning of the lane change until the last unit has come to rest in its lane."""


@dataclass(frozen=True)
class SingleLaneChange:
    """One sine period of lateral acceleration at the front axle, ``a = amplitude sin(2 pi frequency t)``.

    SAE J2179 and ISO 14791, of which only catalogue pages and secondary sources were readable.

    Attributes
    ----------
    amplitude : float
        In m/s^2.
    frequency : float
        In Hz.
    """

    amplitude: float
    frequency: float

    @property
    def displacement(self) -> float:
        """Sideways, ``amplitude / (2 pi frequency^2)``, in m."""
        return self.amplitude / (2.0 * np.pi * self.frequency**2)

    def path(self, time: FloatArray) -> FloatArray:
        """Lateral position of the front axle in m at times in s from the beginning."""
        phase = 2.0 * np.pi * np.clip(np.asarray(time) * self.frequency, 0.0, 1.0)
        return np.asarray(self.displacement * (phase - np.sin(phase)) / (2.0 * np.pi), dtype=np.float64)


SAE_J2179 = SingleLaneChange(amplitude=0.15 * 9.81, frequency=0.4)
"""0.15 g over 2.5 s. Its printed displacement, 1.464 m, takes g as 9.81 m/s^2; it takes 61.1 m of road."""

SAE_J2179_SPEED = 88.0 / 3.6
"""In m/s."""


def steer_axle(vehicle: Vehicle) -> Axle:
    """Foremost steered axle of the lead unit."""
    return max((axle for axle in vehicle.units[0].axles if axle.steered), key=lambda axle: axle.position)


def run_lane_change(
    model: LinearModel, change: SingleLaneChange = SAE_J2179, duration: float = DURATION
) -> Response:
    """Motion of a vehicle whose steer axle follows the lane change.

    The lateral acceleration of a steered axle contains the steer angle directly, so that the model can be
    solved for the angle that a given acceleration takes. Sine, states and yaw form one linear system, whose
    motion is exact at every sample; the ground path is the only quadrature.

    Parameters
    ----------
    model : LinearModel
    change : SingleLaneChange
    duration : float
        In s, from the beginning of the lane change.

    Returns
    -------
    Response
        With the steer angle that it takes.

    Raises
    ------
    AnalysisError
        If the vehicle is unstable, or the units behind an axle that follows the path would swing out without
        bound (a zero of the model in the right half plane): no steering holds it on the path, then.
    """
    system = _Inverse.of(model)
    system.check(model)
    instants = round(duration / SAMPLE_PERIOD) + 1
    time: FloatArray = np.arange(instants, dtype=np.float64) * SAMPLE_PERIOD
    period = 1.0 / change.frequency
    turning = min(int(np.floor(period / SAMPLE_PERIOD)) + 1, instants)

    start = np.zeros(system.size)
    start[-1] = change.amplitude
    matrix = system.matrix(2.0 * np.pi * change.frequency)
    driven = free_motion(matrix, start, SAMPLE_PERIOD, turning)
    # From the end of the sine, which need not be at a sample, the axle keeps its lane.
    end = np.asarray(expm(matrix * period), dtype=np.float64) @ start
    end[-2:] = 0.0
    coasting = np.asarray(expm(matrix * (turning * SAMPLE_PERIOD - period)), dtype=np.float64) @ end
    vectors = np.concatenate([driven, free_motion(matrix, coasting, SAMPLE_PERIOD, instants - turning)])
    return _response(model, time, vectors, system.steering(vectors))


def _response(model: LinearModel, time: FloatArray, vectors: FloatArray, steering: FloatArray) -> Response:
    size = len(model.state_matrix)
    states = vectors[:, :size]
    outputs = split_outputs(
        states @ model.output_matrix.T + np.outer(steering, model.feedthrough), len(model.vehicle.units)
    )
    lead_yaw = vectors[:, size, np.newaxis]
    yaw = np.hstack([lead_yaw, lead_yaw - outputs.articulation.cumsum(axis=1)])
    heading = np.exp(1j * yaw)
    velocity = (model.speed + 1j * outputs.lateral_velocity[:, 0]) * heading[:, 0]
    lead = cumulative_trapezoid(velocity, dx=SAMPLE_PERIOD, initial=0.0)
    positions = coupled_positions(model.vehicle.hitches, lead, heading)
    return Response(
        unit_names=model.vehicle.unit_names,
        time=time,
        steering_angle=steering,
        yaw=yaw,
        yaw_rate=outputs.yaw_rate,
        lateral_acceleration=outputs.lateral_acceleration,
        articulation=outputs.articulation,
        x=positions.real,
        y=positions.imag,
    )


@dataclass(frozen=True)
class _Inverse:
    """The model solved for its steering: of ``a = row x + direct delta`` at the steer axle, delta by a."""

    state_matrix: FloatArray
    input_matrix: FloatArray
    row: FloatArray
    direct: float

    @classmethod
    def of(cls, model: LinearModel) -> "_Inverse":
        position = steer_axle(model.vehicle).position
        output = model.output_names.index(f"{model.vehicle.unit_names[0]}/lateral_acceleration")
        # a_y + x r' of the lead unit
        row = model.output_matrix[output] + position * model.state_matrix[1]
        direct = float(model.feedthrough[output] + position * model.input_matrix[1])
        return cls(model.state_matrix, model.input_matrix, row, direct)

    @property
    def size(self) -> int:
        """Length of the vector [states, yaw of the lead unit, acceleration, its quarter turn]."""
        return len(self.state_matrix) + 3

    @property
    def closed(self) -> FloatArray:
        """State matrix of the vehicle whose steer axle keeps its acceleration."""
        return self.state_matrix - np.outer(self.input_matrix, self.row) / self.direct

    def matrix(self, frequency: float) -> FloatArray:
        """Rates of that vector for an acceleration that is a sine of a frequency in rad/s."""
        states = len(self.state_matrix)
        rates = np.zeros((self.size, self.size))
        rates[:states, :states] = self.closed
        rates[:states, -2] = self.input_matrix / self.direct
        rates[states, 1] = 1.0
        rates[-2, -1], rates[-1, -2] = frequency, -frequency
        return rates

    def steering(self, vectors: FloatArray) -> FloatArray:
        """Steer angle in rad that the accelerations take."""
        states = vectors[:, : len(self.state_matrix)]
        return np.asarray((vectors[:, -2] - states @ self.row) / self.direct, dtype=np.float64)

    def check(self, model: LinearModel) -> None:
        """Refuse what no steering can lead through a lane change."""
        name = f"{model.vehicle.name} at {model.speed:.4g} m/s"
        if np.linalg.eigvals(self.state_matrix).real.max() >= 0.0:
            message = f"{name}: unstable: there is no lane change to measure"
            raise AnalysisError(message)
        zero = np.linalg.eigvals(self.closed).real.max()
        if zero >= 0.0:
            message = (
                f"{name}: its steer axle cannot be held on a lane change: a zero at {zero:.4g} 1/s "
                "lets the vehicle swing out behind it"
            )
            raise AnalysisError(message)
