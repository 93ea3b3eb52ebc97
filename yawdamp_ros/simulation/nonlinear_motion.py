"""The nonlinear model as a motion that a run can follow."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt

from yawdamp_ros.dynamics import LOWEST_SPEED, LinearModel, linear_model
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.nonlinear import Event as NonlinearEvent
from yawdamp_ros.nonlinear import EventKind, NonlinearDynamics, Outputs
from yawdamp_ros.nonlinear.layout import ACCELERATION, FRICTION_LEFT, FRICTION_RIGHT, GEAR, SPEED, STEERING
from yawdamp_ros.stepping import AppliedInput, Event, Sample, Start
from yawdamp_ros.vehicle import Vehicle

QUANTITIES: Mapping[str, Callable[[Outputs], FloatArray]] = {
    "roll": lambda outputs: outputs.roll,
    "load_transfer_ratio": lambda outputs: outputs.load_transfer_ratio,
    "longitudinal_acceleration": lambda outputs: outputs.acceleration[..., 0],
    "hitch_force_x": lambda outputs: outputs.hitch_force[..., 0],
    "hitch_force_y": lambda outputs: outputs.hitch_force[..., 1],
    "hitch_force_z": lambda outputs: outputs.hitch_force[..., 2],
    "load": lambda outputs: outputs.wheel_load,
    "lateral_slip": lambda outputs: outputs.slip,
    "slide": lambda outputs: outputs.slide,
    "longitudinal_force": lambda outputs: outputs.longitudinal_force,
    "lateral_force": lambda outputs: outputs.lateral_force,
}
"""Quantities of a sample that only this motion has, each with its source in the outputs."""


class NonlinearMotion:
    """A `Motion` of the nonlinear model, by Runge-Kutta steps of fourth order.

    It begins straight at its speed, which a controller holds until ``acceleration`` is demanded.

    Parameters
    ----------
    vehicle : Vehicle
    speed : float or None
        Longitudinal speed [m/s], 0 or negative, too; None: the vehicle's own.
    step_size : float
        Step size [s].

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> motion = NonlinearMotion(load_vehicle("interlink"), 20.0, 0.001)
    >>> sample = motion.run([0.02] * 1000)
    >>> bool(sample.yaw_rate[0] > 0.05)  # to the left, rad/s
    True
    """

    def __init__(self, vehicle: Vehicle, speed: float | None, step_size: float) -> None:
        self._dynamics = NonlinearDynamics(vehicle)
        self._step_size = step_size
        self._first_speed = vehicle.speed if speed is None else speed
        self._inputs = self._dynamics.inputs(speed=self._first_speed)
        self._first = self._dynamics.initial_state(self._first_speed)
        self._state = self._first
        self._noted = self._dynamics.no_events()
        self._step = 0
        self._masses = {unit.name: unit.mass for unit in vehicle.units}
        self._places = self._input_places()
        self._told = [
            AppliedInput(0, "speed", self._first_speed),
            AppliedInput(0, "steering", 0.0),
        ]

    @property
    def vehicle(self) -> Vehicle:
        """The vehicle that moves."""
        return self._dynamics.vehicle

    @property
    def step(self) -> int:
        """Steps since the start."""
        return self._step

    @property
    def input_names(self) -> Sequence[str]:
        """Inputs that `apply` takes."""
        return (*self._places, "reset")

    @property
    def state_names(self) -> Sequence[str]:
        """Names of the elements of the state."""
        return self._dynamics.layout.names(self.vehicle.unit_names)

    @property
    def quantity_names(self) -> Sequence[str]:
        """Quantities in `Sample.extra`."""
        return tuple(QUANTITIES)

    @property
    def speed(self) -> float:
        """Present longitudinal velocity of the lead unit [m/s]."""
        return float(self._state[self._dynamics.layout.velocity.start])

    @property
    def steering_angle(self) -> float:
        """Road-wheel steer angle in force from this instant on [rad]."""
        return float(self._inputs[STEERING])

    def begin(self, start: Start) -> None:
        """See `Motion`."""
        pose = start.x, start.y, start.yaw
        self._first = self._dynamics.initial_state(self._first_speed, pose, start.articulation)
        self._state = self._first

    def apply(self, applied: AppliedInput) -> None:
        """Let an input act from this instant on.

        A speed and an acceleration replace each other: the newer one counts.
        """
        if applied.name == "reset":
            self._state = self._first
            self._noted = self._dynamics.no_events()
        else:
            places, scale = self._places[applied.name]
            value = scale * applied.value
            if applied.name != "acceleration" and np.all(self._inputs[places] == value):
                return
            self._inputs[places] = value
            if applied.name == "speed":
                self._inputs[ACCELERATION] = 0.0
            elif applied.name == "acceleration":
                self._inputs[SPEED] = np.nan
        self._tell(AppliedInput(self._step, applied.name, applied.value))

    def advance(self, steps: int = 1) -> None:
        """Take steps with the inputs held."""
        if steps:
            self._take(np.tile(self._inputs, (steps, 1)), steps)

    def run(self, angles: Sequence[float] | FloatArray, steps_per_sample: int | None = None) -> Sample:
        """Take a step for every steer angle, and sample; see `Motion`."""
        given = np.asarray(angles, dtype=np.float64)
        rows = np.empty((len(given), len(self._inputs)))
        rows[:] = self._inputs
        rows[1:, STEERING] = given[:-1]
        if (given != self.steering_angle).any():
            for index in np.flatnonzero(given != rows[:, STEERING]).tolist():
                self._tell(AppliedInput(self._step + 1 + index, "steering", float(given[index])))
        every = len(given) if steps_per_sample is None else steps_per_sample
        self._inputs[STEERING] = given[-1]
        states, events = self._take(rows, every)
        at = given[every - 1 :: every]
        steps = np.arange(self._step - len(given) + every, self._step + 1, every)
        after = np.empty((len(at), len(self._inputs)))
        after[:] = self._inputs
        after[:, STEERING] = at
        sample = self._sample_of(steps, at, states, after, events)
        return sample if steps_per_sample is not None else _single(sample)

    def sample(self) -> Sample:
        """Return the sample of this instant; the lists of events and inputs start anew."""
        step, angle = np.array([self._step]), np.array([self.steering_angle])
        return _single(self._sample_of(step, angle, self._state[np.newaxis], self._inputs[np.newaxis], ()))

    def snapshot(self) -> Mapping[str, Any]:
        """State sufficient for `restore`; None replaces NaN (no held speed), which JSON lacks."""
        return {
            "step": self._step,
            "first": self._first.tolist(),
            "state": self._state.tolist(),
            "inputs": [None if np.isnan(value) else value for value in self._inputs.tolist()],
            "events": self._noted.tolist(),
            "sampled": not self._told,
        }

    def restore(self, snapshot: Mapping[str, Any]) -> None:
        """Go on from a snapshot of the same vehicle; its inputs count as reported."""
        self._step = snapshot["step"]
        self._first = np.array(snapshot["first"])
        self._first_speed = float(self._first[self._dynamics.layout.velocity.start])
        self._state = np.array(snapshot["state"])
        self._inputs = np.array([np.nan if value is None else value for value in snapshot["inputs"]])
        self._noted = np.array(snapshot["events"], dtype=self._noted.dtype)
        self._told = []

    def linearise(self) -> LinearModel:
        """Linear model that this motion approaches for small steering, `consistent`, at the present speed.

        A motion that has ended is linearised at its first speed. The model bears the name of this motion.
        """
        speed = self.speed if np.isfinite(self.speed) else self._first_speed
        return replace(linear_model(self.vehicle, max(abs(speed), LOWEST_SPEED)), model="nonlinear")

    def _take(self, rows: FloatArray, every: int) -> tuple[FloatArray, tuple[Event, ...]]:
        """Take a step for each row of inputs; states after a motion that has ended are NaN."""
        found = self._dynamics.try_steps(
            self._state, rows, self._step_size, every=every, first=self._step, event_steps=self._noted
        )
        states = np.full((len(rows) // every, len(self._state)), np.nan)
        states[: len(found.states)] = found.states
        self._step += len(rows)
        self._state = states[-1]
        events = [_event(each) for each in found.events]
        if found.diverged:
            step = self._step - len(rows) + found.taken
            events.append(Event(step, "divergence", found.diverged, final=True))
        return states, tuple(events)

    def _sample_of(
        self,
        steps: npt.NDArray[np.int64],
        angles: FloatArray,
        states: FloatArray,
        inputs: FloatArray,
        events: tuple[Event, ...],
    ) -> Sample:
        outputs = self._dynamics.outputs(states, inputs)
        velocity = outputs.velocity[..., 0] + 1j * outputs.velocity[..., 1]
        told, self._told = tuple(self._told), []
        return Sample(
            step=steps,
            steering_angle=angles,
            x=outputs.position[..., 0],
            y=outputs.position[..., 1],
            yaw=outputs.yaw,
            yaw_rate=outputs.yaw_rate,
            heading=np.exp(1j * outputs.yaw),
            velocity=velocity,
            lateral_velocity=velocity.imag,
            lateral_acceleration=outputs.acceleration[..., 1],
            articulation=outputs.articulation,
            articulation_rate=outputs.yaw_rate[..., :-1] - outputs.yaw_rate[..., 1:],
            inputs=told,
            extra={name: value(outputs) for name, value in QUANTITIES.items()},
            events=events,
        )

    def _tell(self, applied: AppliedInput) -> None:
        # An input set twice at one step acts with its last value only.
        if self._told and self._told[-1][:2] == applied[:2]:
            self._told.pop()
        self._told.append(applied)

    def _input_places(self) -> dict[str, tuple[slice | list[int], float]]:
        """Place of each input in the input vector, and its factor."""
        layout = self._dynamics.input_layout
        places: dict[str, tuple[slice | list[int], float]] = {
            "steering": (slice(STEERING, STEERING + 1), 1.0),
            "speed": (slice(SPEED, SPEED + 1), 1.0),
            "acceleration": (slice(ACCELERATION, ACCELERATION + 1), 1.0),
            "friction": (slice(FRICTION_LEFT, FRICTION_RIGHT + 1), 1.0),
            "gear": (slice(GEAR, GEAR + 1), 1.0),
        }
        first = layout.axle_steering.start
        for unit, (name, mass) in enumerate(self._masses.items()):
            brake, moment = layout.brake.start + unit, layout.yaw_moment.start + unit
            places[f"{name}/brake"] = slice(brake, brake + 1), mass
            places[f"{name}/yaw_moment"] = slice(moment, moment + 1), 1.0
            axles = self.vehicle.units[unit].axles
            commanded = [first + place for place, axle in enumerate(axles) if axle.commanded]
            if commanded:
                places[f"{name}/steering"] = commanded, 1.0
            first += len(axles)
        return places


def _event(found: NonlinearEvent) -> Event:
    where = found.unit
    if found.axle is not None:
        where = f"{found.unit}, axle {found.axle + 1}, {found.side}"
    return Event(found.step, str(found.kind), where, final=found.kind is EventKind.ROLLOVER)


def _single(sample: Sample) -> Sample:
    """Return a sample in the shapes of one instant, from a sample of several that holds only one."""
    single = {
        name: value[0]
        for name, value in sample._asdict().items()
        if isinstance(value, np.ndarray) and name != "step"
    }
    extra = {name: value[0] for name, value in sample.extra.items()}
    return sample._replace(**single, step=np.asarray(sample.step[0]), extra=extra)
