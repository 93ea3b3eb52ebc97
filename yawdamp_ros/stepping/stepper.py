"""The fixed step: zero-order hold by matrix exponential, exact for held steering."""

import math
from collections.abc import Callable
from functools import lru_cache
from typing import Literal, NamedTuple

import numpy as np
from scipy.linalg import expm

from yawdamp_ros.dynamics import LinearModel, linear_model
from yawdamp_ros.dynamics.kinematics import FloatArray, coupled_positions
from yawdamp_ros.stepping.sample import AppliedInput, Sample

KNOWN_SPEEDS = 1024
"""Speeds whose matrices are kept."""


class Snapshot(NamedTuple):
    """All that the future depends on, given the model's vehicle and the inputs to come.

    Attributes
    ----------
    step : int
    speed : float
        In m/s.
    vector : tuple of float
        State, yaw of the lead unit, held steer angle.
    x, y : float
        Of the lead unit's centre of gravity in the ground frame, m.
    sampled : bool
        Whether this instant's sample was taken, and its inputs told.
    """

    step: int
    speed: float
    vector: tuple[float, ...]
    x: float
    y: float
    sampled: bool


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
        self.step_size = step_size
        self.step = 0
        self._vehicle, self._model_name = model.vehicle, model.model
        self._units = len(model.vehicle.units)
        self._hitches = model.vehicle.hitches
        self._inputs = [
            AppliedInput(0, "speed", model.speed),
            AppliedInput(0, "steering", 0.0),
        ]
        # A measured speed comes back to values it had: their matrices are computed once.
        self._at_speed = lru_cache(maxsize=KNOWN_SPEEDS)(self._matrices)
        self.model, self._transition = self._at_speed(model.speed)
        self._vector = np.zeros(len(self._transition))
        self._next = np.zeros_like(self._vector)
        self._stand_at_the_origin()

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
        if angle != self._vector[-1]:
            self._vector[-1] = angle
            self._note("steering", angle)

    def change_speed(self, speed: float) -> None:
        """Set the longitudinal speed in m/s from this instant on; the state stays as it is.

        The model follows a changing speed quasi-statically: at each speed it is the one of that speed.

        Raises
        ------
        DynamicsError
            If the speed is not positive and finite.
        """
        if speed != self.model.speed:
            self.model, self._transition = self._at_speed(speed)
            self._set_ground_speed()
            self._note("speed", speed)

    def reset(self) -> None:
        """Return to rest at the origin; time and steering stay as they are."""
        self._vector[:-1] = 0.0
        self._stand_at_the_origin()
        self._note("reset", 0.0)

    def snapshot(self) -> Snapshot:
        """What `restore` needs to go on from this instant."""
        vector = tuple(self._vector.tolist())
        return Snapshot(self.step, self.model.speed, vector, self._x, self._y, not self._inputs)

    def restore(self, snapshot: Snapshot) -> None:
        """Go on from a snapshot of the same vehicle and model; its inputs count as told."""
        self.change_speed(snapshot.speed)
        self.step = snapshot.step
        self._vector[:] = snapshot.vector
        self._x, self._y = snapshot.x, snapshot.y
        self._set_ground_speed()
        self._inputs = []

    def apply(self, applied: AppliedInput) -> None:
        """Let a recorded input act from this instant on."""
        if applied.name == "steering":
            self.steer(applied.value)
        elif applied.name == "speed":
            self.change_speed(applied.value)
        else:
            self.reset()

    def advance(self) -> None:
        """Take one step with the steering held."""
        np.dot(self._transition, self._vector, out=self._next)
        self._vector, self._next = self._next, self._vector
        self.step += 1
        x_rate, y_rate = self._x_rate, self._y_rate
        self._set_ground_speed()
        half = 0.5 * self.step_size
        self._x += half * (x_rate + self._x_rate)
        self._y += half * (y_rate + self._y_rate)

    def run(self, steps: int, drive: Callable[["Stepper"], None]) -> Sample:
        """Take several steps and sample the instant after them.

        Parameters
        ----------
        steps : int
            0 for the first instant of a run.
        drive : callable
            Asked once at every step, in order, to set what acts on the model from that step on.

        Returns
        -------
        Sample
        """
        if steps == 0:
            drive(self)
        for _ in range(steps):
            self.advance()
            drive(self)
        return self.sample()

    def sample(self) -> Sample:
        """Sample of this instant; the list of inputs starts anew."""
        count = self._units
        state = self._vector[: 2 * count]
        steering_angle = self.steering_angle
        outputs = self.model.output_matrix @ state + self.model.feedthrough * steering_angle
        yaw_rate = outputs[count : 2 * count]
        articulation = outputs[3 * count :]
        yaw = np.empty(count)
        yaw[0] = self._vector[-2]
        yaw[1:] = yaw[0] - np.cumsum(articulation)
        x, y = coupled_positions(self._hitches, self._x, self._y, yaw)
        inputs, self._inputs = tuple(self._inputs), []
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
            inputs=inputs,
        )

    def _note(self, name: Literal["steering", "speed", "reset"], value: float) -> None:
        # Of what is set twice at one step only the last ever acted.
        if self._inputs and self._inputs[-1][:2] == (self.step, name):
            self._inputs.pop()
        self._inputs.append(AppliedInput(self.step, name, value))

    def _matrices(self, speed: float) -> tuple[LinearModel, FloatArray]:
        model = linear_model(self._vehicle, speed, self._model_name)
        return model, _transition(model, self.step_size)

    def _stand_at_the_origin(self) -> None:
        self._x = self._y = 0.0
        self._set_ground_speed()

    def _set_ground_speed(self) -> None:
        yaw, lateral_velocity = self._vector[-2], self._vector[0]
        sine, cosine = math.sin(yaw), math.cos(yaw)
        self._x_rate = self.model.speed * cosine - lateral_velocity * sine
        self._y_rate = self.model.speed * sine + lateral_velocity * cosine


def _transition(model: LinearModel, step_size: float) -> FloatArray:
    """Transition over a step of [state, yaw of the lead unit, held steer angle]."""
    states = len(model.state_matrix)
    rates = np.zeros((states + 2, states + 2))
    rates[:states, :states] = model.state_matrix
    rates[:states, -1] = model.input_matrix
    rates[states, 1] = 1.0
    return np.asarray(expm(rates * step_size), dtype=np.float64)
