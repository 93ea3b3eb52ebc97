"""The fixed step: zero-order hold by matrix exponential, exact for held steering."""

import math
from collections.abc import Callable

import numpy as np
from scipy.linalg import expm

from yawdamp_ros.dynamics import LinearModel
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.stepping.sample import Sample


class Stepper:
    """A linear model in time.

    The state, the yaw of the lead unit and the held steer angle form one vector, whose transition over a
    step is a matrix exponential: exact, at any step size, while the steering is held. The ground path
    is the only quadrature, by the trapezoidal rule, for it turns with the yaw.

    Parameters
    ----------
    model : LinearModel
    step_size : float
        In s.
    """

    def __init__(self, model: LinearModel, step_size: float) -> None:
        self.model = model
        self.step_size = step_size
        self.step = 0
        self._units = len(model.vehicle.units)
        self._hitches = model.vehicle.hitches
        self._transition = _transition(model, step_size)
        self._vector = np.zeros(len(self._transition))
        self._next = np.zeros_like(self._vector)
        self._x = self._y = 0.0
        self._x_rate, self._y_rate = model.speed, 0.0
        self._changes: list[tuple[int, float]] = [(0, 0.0)]

    @property
    def state(self) -> FloatArray:
        """Copy of the model's state vector, shape (2 n,)."""
        return self._vector[: 2 * self._units].copy()

    @property
    def steering_angle(self) -> float:
        """Road-wheel steer angle held over the next step, rad."""
        return float(self._vector[-1])

    def steer(self, angle: float) -> None:
        """Set the road-wheel steer angle in rad that is in force from this instant on."""
        if angle == self._vector[-1]:
            return
        self._vector[-1] = angle
        if self._changes and self._changes[-1][0] == self.step:
            self._changes.pop()
        self._changes.append((self.step, angle))

    def advance(self) -> None:
        """Take one step with the steering held."""
        np.dot(self._transition, self._vector, out=self._next)
        self._vector, self._next = self._next, self._vector
        self.step += 1
        yaw, lateral_velocity = self._vector[-2], self._vector[0]
        sine, cosine = math.sin(yaw), math.cos(yaw)
        x_rate = self.model.speed * cosine - lateral_velocity * sine
        y_rate = self.model.speed * sine + lateral_velocity * cosine
        half = 0.5 * self.step_size
        self._x += half * (self._x_rate + x_rate)
        self._y += half * (self._y_rate + y_rate)
        self._x_rate, self._y_rate = x_rate, y_rate

    def run(self, steps: int, steering: Callable[[int], float]) -> Sample:
        """Take several steps and sample the instant after them.

        Parameters
        ----------
        steps : int
            May be 0, for the sample of the first instant.
        steering : callable
            Steer angle in rad in force from a step on; asked once a step, in order.

        Returns
        -------
        Sample
        """
        if self.step == 0:
            self.steer(steering(0))
        for _ in range(steps):
            self.advance()
            self.steer(steering(self.step))
        return self.sample()

    def sample(self) -> Sample:
        """Sample of this instant; the list of steering changes starts anew."""
        count = self._units
        state = self._vector[: 2 * count]
        steering_angle = self.steering_angle
        outputs = self.model.output_matrix @ state + self.model.feedthrough * steering_angle
        yaw_rate = outputs[count : 2 * count]
        articulation = outputs[3 * count :]
        yaw = np.empty(count)
        yaw[0] = self._vector[-2]
        yaw[1:] = yaw[0] - np.cumsum(articulation)
        x, y = self._positions(yaw)
        changes, self._changes = tuple(self._changes), []
        return Sample(
            step=self.step,
            steering_angle=steering_angle,
            speed=self.model.speed,
            x=x,
            y=y,
            yaw=yaw,
            yaw_rate=yaw_rate,
            lateral_velocity=outputs[:count],
            lateral_acceleration=outputs[2 * count : 3 * count],
            articulation=articulation,
            articulation_rate=yaw_rate[:-1] - yaw_rate[1:],
            steering_changes=changes,
        )

    def _positions(self, yaw: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Centres of gravity by the true geometry of the hitches, so that units stay coupled."""
        cosine, sine = np.cos(yaw), np.sin(yaw)
        x, y = np.empty_like(yaw), np.empty_like(yaw)
        x[0], y[0] = self._x, self._y
        for index, (rear_hitch, front_hitch) in enumerate(self._hitches):
            x[index + 1] = x[index] + rear_hitch * cosine[index] - front_hitch * cosine[index + 1]
            y[index + 1] = y[index] + rear_hitch * sine[index] - front_hitch * sine[index + 1]
        return x, y


def _transition(model: LinearModel, step_size: float) -> FloatArray:
    """Transition over a step of [state, yaw of the lead unit, held steer angle]."""
    states = len(model.state_matrix)
    rates = np.zeros((states + 2, states + 2))
    rates[:states, :states] = model.state_matrix
    rates[:states, -1] = model.input_matrix
    rates[states, 1] = 1.0
    return np.asarray(expm(rates * step_size), dtype=np.float64)
