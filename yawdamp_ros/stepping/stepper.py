"""The fixed step: zero-order hold by matrix exponential, exact for held steering."""

from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from yawdamp_ros.dynamics import LinearModel, linear_model, split_outputs
from yawdamp_ros.dynamics.kinematics import (
    ComplexArray,
    FloatArray,
    coupled_positions,
    coupled_velocities,
)
from yawdamp_ros.stepping.errors import SteppingError
from yawdamp_ros.stepping.ground_path import GroundPath
from yawdamp_ros.stepping.propagation import Propagation, outputs_of
from yawdamp_ros.stepping.propagators import Propagators
from yawdamp_ros.stepping.sample import AppliedInput, Sample
from yawdamp_ros.stepping.start import Start
from yawdamp_ros.stepping.yaw import Yaw, YawParts

KNOWN_SPEEDS = 4
"""Number of speeds whose matrices are kept: more would not fit into the processor's cache."""

FEW_STEPS = 100
"""Steps over which a motion within the limits cannot overflow."""
_NOTHING = nullcontext()


class _Instants(NamedTuple):
    """One instant, or k instants: yaw and position are of the lead unit."""

    states: FloatArray  # the last column is the yaw since the start of the block
    base: FloatArray  # that at the start of the block: value, remainder, and the value without whole turns
    position: ComplexArray


class Stepper:
    """A linear model in time.

    State and yaw are exact while the steering is held; see `Propagation`. The path follows by `GroundPath`.

    Parameters
    ----------
    model : LinearModel
    step_size : float
        Step size [s].

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> from yawdamp_ros.stepping import Stepper
    >>> motion = Stepper(linear_model(load_vehicle("truck_trailer")), step_size=0.001)
    >>> sample = motion.run([0.02] * 1000)
    >>> sample.yaw_rate.round(4).tolist()
    [0.0753, 0.0552]
    """

    input_names: Sequence[str] = ("steering", "speed", "reset")
    quantity_names: Sequence[str] = ()

    def __init__(self, model: LinearModel, step_size: float) -> None:
        self.vehicle = model.vehicle
        self.state_names: Sequence[str] = model.state_names
        self.step_size = step_size
        self.step = 0
        self._model_name = model.model
        self._units = len(model.vehicle.units)
        self._hitches = model.vehicle.hitches
        self._inputs = [
            AppliedInput(0, "speed", model.speed),
            AppliedInput(0, "steering", 0.0),
        ]
        # A measured speed returns to earlier values: their matrices are computed once.
        self._at_speed = lru_cache(maxsize=KNOWN_SPEEDS)(Propagators.of(model, step_size).at)
        self._model = model
        self._motion = Propagation(self._at_speed(model.speed))
        self._yaw = Yaw()  # of the lead unit at the start of the block
        self._start = Start()
        self._path = GroundPath(step_size)
        self._set_ground_velocity()

    @property
    def speed(self) -> float:
        """Present longitudinal speed [m/s]."""
        return self._motion.propagator.speed

    @property
    def state(self) -> FloatArray:
        """Copy of the model's state vector, shape (2 n,)."""
        return self._motion.state

    @property
    def steering_angle(self) -> float:
        """Road-wheel steer angle held over the next step [rad]."""
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
        if speed != self.speed:
            at_speed = self._at_speed(speed)
            self._yaw.turn(self._motion.start_block())
            self._motion.propagator = at_speed
            self._set_ground_velocity()
            self._note("speed", speed)

    def begin(self, start: Start) -> None:
        """See `Motion`; a linear model begins straight."""
        if any(start.articulation):
            message = (
                f"initial_articulation: {list(start.articulation)}: a linear model begins straight; expected "
                "0, or model nonlinear"
            )
            raise SteppingError(message)
        self._start = start
        self._stand_at_start()

    def reset(self) -> None:
        """Return to rest at the start; time and steering stay as they are."""
        self._stand_at_start()
        self._note("reset", 0.0)

    def _stand_at_start(self) -> None:
        self._motion.stand(np.zeros(2 * self._units))
        self._yaw.set(self._start.yaw, 0.0)
        self._path.position = complex(self._start.x, self._start.y)
        self._set_ground_velocity()

    def snapshot(self) -> Mapping[str, Any]:
        """State sufficient for `restore`; a block starts here for both."""
        self._yaw.turn(self._motion.start_block())
        self._set_ground_velocity()  # from the yaw as `restore` computes it, with its rounding
        return {
            "step": self.step,
            "speed": self.speed,
            "steering_angle": self.steering_angle,
            "state": self.state.tolist(),
            "yaw": self._yaw.parts.value,
            "yaw_remainder": self._yaw.parts.remainder,
            "x": self._path.position.real,
            "y": self._path.position.imag,
            "start": list(self._start[:3]),
            "sampled": not self._inputs,
        }

    def restore(self, snapshot: Mapping[str, Any]) -> None:
        """Go on from a snapshot of the same vehicle and model; its inputs count as reported."""
        self.change_speed(snapshot["speed"])
        self.step = snapshot["step"]
        self._motion.stand(np.array(snapshot["state"]))
        self._yaw.set(snapshot["yaw"], snapshot["yaw_remainder"])
        self._motion.steering_angle = snapshot["steering_angle"]
        self._start = Start(*snapshot.get("start", ()))
        self._path.position = complex(snapshot["x"], snapshot["y"])
        self._set_ground_velocity()
        self._inputs = []

    def linearise(self) -> LinearModel:
        """Linear model at the present speed, which is the whole of this motion."""
        if self._model.speed != self.speed:
            self._model = linear_model(self.vehicle, self.speed, self._model_name)
        return self._model

    def apply(self, applied: AppliedInput) -> None:
        """Let an input act from this instant on."""
        if applied.name == "steering":
            self.steer(applied.value)
        elif applied.name == "speed":
            self.change_speed(applied.value)
        else:
            self.reset()

    def advance(self, steps: int = 1) -> None:
        """Take steps with the steering held."""
        if steps:
            angles = np.empty(steps)
            angles.fill(self.steering_angle)
            with _quiet(steps):
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
            Road-wheel steer angles [rad], finite, each in force from the instant after its step on.
        steps_per_sample : int, optional
            A divisor of k: sample every so many steps. The last instant alone unless given.
        tell_inputs : bool
            Whether the sample is to tell where the steering changed.

        Returns
        -------
        Sample
            Last instant, or k / steps_per_sample instants. An unstable motion ends in NaN.
        """
        given = np.asarray(angles, dtype=np.float64)
        if tell_inputs:
            self._note_changes(given)
        with _quiet(len(given)):
            states, blocks, positions = self._advance(given)
            if steps_per_sample is None:
                instants = _Instants(states[-1], np.array(blocks[-1][1]), positions[-1])
                return self._sample_of(np.asarray(self.step), given[-1], instants)
            chosen = slice(steps_per_sample - 1, None, steps_per_sample)
            counts, bases = zip(*blocks, strict=True)
            instants = _Instants(states[chosen], np.repeat(bases, counts, axis=0)[chosen], positions[chosen])
            steps = np.arange(self.step + 1 - len(given), self.step + 1)
            return self._sample_of(steps[chosen], given[chosen], instants)

    def sample(self) -> Sample:
        """Return the sample of this instant; the list of inputs starts anew."""
        step, angle = np.asarray(self.step), np.asarray(self.steering_angle)
        return self._sample_of(step, angle, self._now())

    def _now(self) -> _Instants:
        states = np.append(self.state, self._motion.yaw_since_block_start)
        return _Instants(states, np.array(self._yaw.parts), np.asarray(self._path.position))

    def _advance(self, angles: FloatArray) -> tuple[FloatArray, list[tuple[int, YawParts]], ComplexArray]:
        """Take a step for each of k angles.

        Returns
        -------
        states : ndarray, shape (k, 2 n + 1)
            States as in `_Instants`.
        blocks : list of (int, YawParts)
            Steps, and the yaw at the start of the block.
        positions : ndarray of complex, shape (k,)
        """
        steps = len(angles)
        if steps <= self._motion.steps_left:
            states, steps_of_blocks = self._motion.advance_within_block(angles), [(steps, 0.0)]
        else:
            states = np.empty((steps, 2 * self._units + 1))
            steps_of_blocks = self._motion.advance(angles, states)
        self.step += steps
        blocks, directions = [], []
        for taken, turned_before in steps_of_blocks:
            if turned_before:
                self._yaw.turn(turned_before)
            blocks.append((taken, self._yaw.parts))
            directions.append(self._yaw.direction)
        common = len(blocks) == 1
        direction = directions[0] if common else np.repeat(directions, [taken for taken, _ in blocks])
        return states, blocks, self._path.advance(states[:, 0], states[:, -1], direction)

    def _sample_of(self, step: npt.NDArray[np.int64], steering_angle: FloatArray, at: _Instants) -> Sample:
        states_and_angle = at.states.copy()
        states_and_angle[..., -1] = steering_angle
        outputs = split_outputs(outputs_of(self._motion.propagator, states_and_angle), self._units)
        value, remainder, wrapped = (at.base[..., part] for part in range(3))
        turned = np.empty_like(outputs.yaw_rate)
        turned[..., 0] = at.states[..., -1] + remainder
        for joint in range(self._units - 1):
            turned[..., joint + 1] = turned[..., joint] - outputs.articulation[..., joint]
        heading = _heading(wrapped[..., np.newaxis] + turned)
        positions = coupled_positions(self._hitches, at.position, heading)
        lead = self.speed, outputs.lateral_velocity[..., 0]
        velocity = coupled_velocities(self._hitches, lead, outputs.yaw_rate, heading)
        inputs, self._inputs = tuple(self._inputs), []
        return Sample(
            step=step,
            steering_angle=steering_angle,
            x=positions.real,
            y=positions.imag,
            yaw=value[..., np.newaxis] + turned,
            yaw_rate=outputs.yaw_rate,
            heading=heading,
            velocity=velocity,
            lateral_velocity=outputs.lateral_velocity,
            lateral_acceleration=outputs.lateral_acceleration,
            articulation=outputs.articulation,
            articulation_rate=outputs.yaw_rate[..., :-1] - outputs.yaw_rate[..., 1:],
            inputs=inputs,
        )

    def _note_changes(self, angles: FloatArray) -> None:
        """Note where the steering will change over the steps to come."""
        if (angles == self.steering_angle).all():
            return
        before = np.append(self.steering_angle, angles[:-1])
        for index in np.flatnonzero(angles != before).tolist():
            self._inputs.append(AppliedInput(self.step + 1 + index, "steering", float(angles[index])))

    def _note(self, name: str, value: float) -> None:
        # An input set twice at one step acts with its last value only.
        if self._inputs and self._inputs[-1][:2] == (self.step, name):
            self._inputs.pop()
        self._inputs.append(AppliedInput(self.step, name, value))

    def _set_ground_velocity(self) -> None:
        direction = self._motion.yaw_since_block_start + self._yaw.direction
        self._path.set_velocity(self.speed, float(self._motion.state[0]), direction)


def _quiet(steps: int) -> AbstractContextManager[object]:
    """Ignore overflow of an unstable motion over many steps; the caller checks its values."""
    # Entering such a context takes as long as several steps.
    return np.errstate(over="ignore", invalid="ignore") if steps > FEW_STEPS else _NOTHING


def _heading(yaw: FloatArray) -> ComplexArray:
    """``cos(yaw) + i sin(yaw)``, of each as of all: NumPy may compute the sines of many in another way."""
    exponent = np.zeros(yaw.shape, dtype=np.complex128)
    exponent.imag = yaw
    return np.exp(exponent, out=exponent)
