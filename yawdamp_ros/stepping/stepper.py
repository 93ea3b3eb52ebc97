"""The fixed step: zero-order hold by matrix exponential, exact for held steering."""

from collections.abc import Sequence
from functools import lru_cache
from typing import Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from yawdamp_ros.dynamics import LinearModel, linear_model
from yawdamp_ros.dynamics.kinematics import ComplexArray, FloatArray, coupled_positions
from yawdamp_ros.stepping.errors import SteppingError
from yawdamp_ros.stepping.propagation import (
    LARGEST_YAW,
    Propagation,
    Propagator,
    outputs_of,
    propagator,
)
from yawdamp_ros.stepping.sample import AppliedInput, Sample

KNOWN_SPEEDS = 128
"""Speeds whose matrices are kept."""


class Snapshot(NamedTuple):
    """All that the future depends on, given the model's vehicle and the inputs to come.

    Attributes
    ----------
    step : int
    speed : float
        In m/s.
    steering_angle : float
        Held road-wheel steer angle in rad.
    state : tuple of float
    yaw, yaw_remainder : float
        Of the lead unit in rad: a number and what its rounding left over.
    x, y : float
        Of the lead unit's centre of gravity in the ground frame, m.
    sampled : bool
        Whether this instant's sample was taken, and its inputs told.
    """

    step: int
    speed: float
    steering_angle: float
    state: tuple[float, ...]
    yaw: float
    yaw_remainder: float
    x: float
    y: float
    sampled: bool


class _Motion(NamedTuple):
    """One instant, or k instants: yaw and position are of the lead unit."""

    states: FloatArray
    yaw: FloatArray  # at the start of the block
    wrapped: FloatArray  # the same without whole turns
    turned: FloatArray  # since then
    position: ComplexArray

    def at(self, chosen: int | slice) -> "_Motion":
        """One of the instants, or some."""
        return _Motion(
            self.states[chosen],
            self.yaw[chosen],
            self.wrapped[chosen],
            self.turned[chosen],
            self.position[chosen],
        )


class Stepper:
    """A linear model in time.

    State and yaw are exact while the steering is held; see `Propagation`. The ground path is the only
    quadrature, by the trapezoidal rule, for it turns with the yaw.

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
        self._inputs = [
            AppliedInput(0, "speed", model.speed),
            AppliedInput(0, "steering", 0.0),
        ]
        # A measured speed comes back to values it had: their matrices are computed once.
        self._at_speed = lru_cache(maxsize=KNOWN_SPEEDS)(self._propagator)
        self._motion = Propagation(propagator(model, step_size))
        self._position = 0.0j
        self._velocity = complex(model.speed)

    @property
    def model(self) -> LinearModel:
        """The model at the speed of now."""
        return self._motion.propagator.model

    @property
    def state(self) -> FloatArray:
        """Copy of the model's state vector, shape (2 n,)."""
        return self._motion.state

    @property
    def steering_angle(self) -> float:
        """Road-wheel steer angle held over the next step, rad."""
        return self._motion.steering_angle

    def steer(self, angle: float) -> None:
        """Set the road-wheel steer angle in rad that is in force from this instant on."""
        if angle != self.steering_angle:
            self._motion.steering_angle = angle
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
            at_speed = self._at_speed(speed)
            self._motion.start_block()
            self._motion.propagator = at_speed
            self._set_ground_velocity()
            self._note("speed", speed)

    def reset(self) -> None:
        """Return to rest at the origin; time and steering stay as they are."""
        self._motion.stand(np.zeros(2 * self._units), 0.0, 0.0)
        self._position = 0.0j
        self._set_ground_velocity()
        self._note("reset", 0.0)

    def snapshot(self) -> Snapshot:
        """What `restore` needs to go on from this instant, at which a block starts for both."""
        self._motion.start_block()
        return Snapshot(
            step=self.step,
            speed=self.model.speed,
            steering_angle=self.steering_angle,
            state=tuple(self.state.tolist()),
            yaw=self._motion.start.yaw,
            yaw_remainder=self._motion.start.remainder,
            x=self._position.real,
            y=self._position.imag,
            sampled=not self._inputs,
        )

    def restore(self, snapshot: Snapshot) -> None:
        """Go on from a snapshot of the same vehicle and model; its inputs count as told."""
        self.change_speed(snapshot.speed)
        self.step = snapshot.step
        self._motion.stand(np.array(snapshot.state), snapshot.yaw, snapshot.yaw_remainder)
        self._motion.steering_angle = snapshot.steering_angle
        self._position = complex(snapshot.x, snapshot.y)
        self._set_ground_velocity()
        self._inputs = []

    def apply(self, applied: AppliedInput) -> None:
        """Let a recorded input act from this instant on."""
        if applied.name == "steering":
            self.steer(applied.value)
        elif applied.name == "speed":
            self.change_speed(applied.value)
        else:
            self.reset()

    def advance(self, steps: int = 1) -> None:
        """Take steps with the steering held.

        Raises
        ------
        SteppingError
            If the motion has grown beyond all numbers.
        """
        if not steps:
            return
        angles = np.empty(steps)
        angles.fill(self.steering_angle)
        self._advance(angles)

    def run(
        self,
        angles: Sequence[float] | FloatArray,
        steps_per_sample: int | None = None,
        *,
        tell_inputs: bool = True,
    ) -> Sample:
        """Take a step for every steer angle, and sample.

        Parameters
        ----------
        angles : array_like, shape (k,)
            Road-wheel steer angles in rad, finite, each in force from the instant after its step on.
        steps_per_sample : int, optional
            A divisor of k: sample every so many steps. The last instant alone unless given.
        tell_inputs : bool
            Whether the sample is to tell where the steering changed.

        Returns
        -------
        Sample
            Of the last instant, or of k / steps_per_sample instants.

        Raises
        ------
        SteppingError
            If the motion has grown beyond all numbers.
        """
        given = np.asarray(angles, dtype=np.float64)
        if tell_inputs:
            self._note_changes(given)
        motion = self._advance(given)
        chosen: int | slice = -1
        if steps_per_sample is not None:
            chosen = slice(steps_per_sample - 1, None, steps_per_sample)
        steps = np.arange(self.step + 1 - len(given), self.step + 1)
        return self._sample_of(steps[chosen], given[chosen], motion.at(chosen))

    def sample(self) -> Sample:
        """Sample of this instant; the list of inputs starts anew."""
        step, angle = np.asarray(self.step), np.asarray(self.steering_angle)
        return self._sample_of(step, angle, self._now())

    def _now(self) -> _Motion:
        start = self._motion.start
        states = self._motion.now()
        return _Motion(
            states,
            np.asarray(start.yaw),
            np.asarray(start.wrapped),
            np.asarray(states[-1] + start.remainder),
            np.asarray(self._position),
        )

    def _advance(self, angles: FloatArray) -> _Motion:
        """Take a step for each of k angles."""
        states = np.empty((len(angles), 2 * self._units + 1))
        starts = self._motion.advance(angles, states)
        if not abs(states[-1, -1]) <= LARGEST_YAW:  # so that no number is none, either
            grown = int(np.argmin(np.abs(states[:, -1]) <= LARGEST_YAW))
            time = (self.step + 1 + grown) * self.step_size
            message = f"{self._vehicle.name}: unstable, beyond all numbers at {time:g} s"
            raise SteppingError(message)
        self.step += len(angles)
        yaw, wrapped, turned = np.empty(len(angles)), np.empty(len(angles)), states[:, -1]
        done = 0
        for start in starts:
            steps = slice(done, done + start.steps)
            yaw[steps], wrapped[steps] = start.yaw, start.wrapped
            turned[steps] += start.remainder
            done += start.steps
        velocities = np.empty(len(angles) + 1, dtype=np.complex128)
        velocities[0] = self._velocity
        velocities[1:] = _ground_velocity(self.model.speed, states[:, 0], wrapped + turned)
        positions = np.empty_like(velocities)
        positions[0] = self._position
        np.multiply(velocities[:-1] + velocities[1:], 0.5 * self.step_size, out=positions[1:])
        np.add.accumulate(positions, out=positions)
        self._position, self._velocity = complex(positions[-1]), complex(velocities[-1])
        return _Motion(states, yaw, wrapped, turned, positions[1:])

    def _sample_of(self, step: npt.NDArray[np.int64], steering_angle: FloatArray, motion: _Motion) -> Sample:
        count = self._units
        states_and_angle = motion.states.copy()
        states_and_angle[..., -1] = steering_angle
        outputs = outputs_of(self._motion.propagator, states_and_angle)
        yaw_rate, articulation = outputs[..., count : 2 * count], outputs[..., 3 * count :]
        turned = np.empty_like(yaw_rate)
        turned[..., 0] = motion.turned
        for joint in range(count - 1):
            turned[..., joint + 1] = turned[..., joint] - articulation[..., joint]
        heading = _heading(motion.wrapped[..., np.newaxis] + turned)
        positions = coupled_positions(self._vehicle.hitches, motion.position, heading)
        inputs, self._inputs = tuple(self._inputs), []
        return Sample(
            step=step,
            steering_angle=steering_angle,
            speed=self.model.speed,
            x=positions.real,
            y=positions.imag,
            yaw=motion.yaw[..., np.newaxis] + turned,
            yaw_rate=yaw_rate,
            heading=heading,
            lateral_velocity=outputs[..., :count],
            lateral_acceleration=outputs[..., 2 * count : 3 * count],
            articulation=articulation,
            articulation_rate=yaw_rate[..., :-1] - yaw_rate[..., 1:],
            inputs=inputs,
        )

    def _note_changes(self, angles: FloatArray) -> None:
        """Note where the steering will change over the steps to come."""
        before = np.append(self.steering_angle, angles[:-1])
        for index in np.flatnonzero(angles != before).tolist():
            self._inputs.append(AppliedInput(self.step + 1 + index, "steering", float(angles[index])))

    def _note(self, name: Literal["steering", "speed", "reset"], value: float) -> None:
        # Of what is set twice at one step only the last ever acted.
        if self._inputs and self._inputs[-1][:2] == (self.step, name):
            self._inputs.pop()
        self._inputs.append(AppliedInput(self.step, name, value))

    def _propagator(self, speed: float) -> Propagator:
        return propagator(linear_model(self._vehicle, speed, self._model_name), self.step_size)

    def _set_ground_velocity(self) -> None:
        now = self._now()
        yaw = np.reshape(now.wrapped + now.turned, 1)
        self._velocity = complex(_ground_velocity(self.model.speed, now.states[:1], yaw)[0])


def _ground_velocity(speed: float, lateral_velocity: FloatArray, yaw: FloatArray) -> ComplexArray:
    """Velocity over ground, shape (k,)."""
    # Never a product of two numbers that are both complex: NumPy rounds it otherwise at the end of an array.
    heading = _heading(yaw)
    sideways = heading * lateral_velocity
    sideways *= 1j
    heading *= speed
    heading += sideways
    return heading


def _heading(yaw: FloatArray) -> ComplexArray:
    """``cos(yaw) + i sin(yaw)``, of each as of all: NumPy may compute the sines of many in another way."""
    exponent = np.zeros(yaw.shape, dtype=np.complex128)
    exponent.imag = yaw
    return np.exp(exponent, out=exponent)
