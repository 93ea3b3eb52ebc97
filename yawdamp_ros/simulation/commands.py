"""Commands on their way to the model: accepted or rejected, limited, timed out, lagged."""

from collections import deque
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any

from yawdamp_ros.manoeuvres import make_manoeuvre
from yawdamp_ros.simulation.errors import SimulationError
from yawdamp_ros.simulation.friction_route import FrictionRoute
from yawdamp_ros.simulation.inputs import LONGITUDINAL, held_inputs, input_of
from yawdamp_ros.simulation.settings import SimParameters
from yawdamp_ros.simulation.steering_messages import LongitudinalDemand
from yawdamp_ros.stepping import (
    AppliedInput,
    Command,
    DelayedDemand,
    Motion,
    SteeringActuator,
    SteeringInput,
    TimeGrid,
    Verdict,
)
from yawdamp_ros.stepping.time_grid import SECOND, nanoseconds

ACCEPTED = frozenset({Verdict.ACCEPTED, Verdict.CLAMPED})

SAMPLES_AT_ONCE = 1000
"""Instants that are computed at once if nothing waits for each."""
Signal = tuple[Sequence[float], Sequence[float]]
"""Times in s, and values that hold until the next."""
NO_SIGNALS: Mapping[str, Signal] = MappingProxyType({})


class Commands:
    """Source of a run driven by a manoeuvre, a log, or calls of `steer` and `demand`.

    Parameters
    ----------
    settings : SimParameters
    grid : TimeGrid
    motion : Motion
        Motion that takes the commands.
    log : (sequence of float, sequence of float), optional
        Times in s and commanded angles in rad, each in force until the next.
    inputs : mapping of str to (sequence of float, sequence of float), optional
        Times and values of other inputs, by name, whatever `longitudinal_source` says.

    Attributes
    ----------
    steering_input : SteeringInput
    held : dict of str to HeldInput
        Inputs besides steering, by the names that the motion takes.
    samples_at_once : int
        Most samples that the run may take at once; 1 if an input depends on the motion.

    Raises
    ------
    ManoeuvreError
        If the settings' manoeuvre cannot be.
    SimulationError
        If the model does not take one of the inputs, or there is no reading `friction_file`.

    Examples
    --------
    >>> from yawdamp_ros.simulation import Commands, SimParameters, make_motion
    >>> from yawdamp_ros.stepping import TimeGrid
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> motion = make_motion(load_vehicle("truck_trailer"), "consistent", speed=20.0, step_size=0.001)
    >>> settings = SimParameters(manoeuvre="step", amplitude=0.02)
    >>> source = Commands(settings, TimeGrid.of(0.001, 0.01), motion)
    >>> sorted(source.held)
    ['speed']
    """

    def __init__(
        self,
        settings: SimParameters,
        grid: TimeGrid,
        motion: Motion,
        log: Signal | None = None,
        inputs: Mapping[str, Signal] = NO_SIGNALS,
    ) -> None:
        self.steering_input = SteeringInput(ratio=settings.steering_ratio, **_limits(settings, grid))
        self.held = held_inputs(motion)
        self._actuator = SteeringActuator(
            grid.step_size, settings.steering_time_constant, settings.steering_rate_limit
        )
        self._grid = grid
        self._motion = motion
        if settings.speed is not None and settings.longitudinal_source == "parameter":
            self.held["speed"].value = settings.speed
        self._applied: dict[str, float | None] = {"speed": motion.speed}
        self._speed_rate = 0.0
        self._lag: DelayedDemand | None = None
        if settings.acceleration_dead_time or settings.acceleration_time_constant:
            self._lag = DelayedDemand(settings.acceleration_dead_time, settings.acceleration_time_constant)
        self._delayed = deque([0.0] * self._steps_in(settings.steering_dead_time))
        self._settings = settings
        self._reset = False
        self._route = FrictionRoute.read(Path(settings.friction_file)) if settings.friction_file else None
        self._distance = 0.0
        self._last = motion.step, motion.speed
        self.samples_at_once = SAMPLES_AT_ONCE if self._route is None and self._lag is None else 1
        self._received: list[Command] = []
        self._command = self._command_source(settings, log)
        self._by_topic = settings.manoeuvre == "none" and log is None
        if missing := sorted(inputs.keys() - self.held.keys()):
            known = ", ".join(self.held)
            message = f"{missing[0]}: model {settings.model} does not take it; expected one of {known}"
            raise SimulationError(message)
        self._ahead = deque(
            sorted(
                (time, name, value)
                for name, signal in inputs.items()
                for time, value in zip(*signal, strict=True)
            )
        )

    def steer(self, angle: float, age: float | None = None, message: object = None) -> Verdict:
        """Accept or reject a steering command, which acts from the next step on.

        Parameters
        ----------
        angle : float
            Commanded angle [rad].
        age : float, optional
            Age of its time stamp [s]; None without a time stamp.
        message : object, optional
            Message that held it, to be recorded.
        """
        return self._offer(angle, self._motion.step, age, message)

    def demand(self, name: str, value: float) -> Verdict:
        """Accept or reject a value of another input, which acts from the next step on.

        Parameters
        ----------
        name : str
            One of `held`.
        value : float
            Value in SI units.
        """
        if name in LONGITUDINAL and name != self._settings.longitudinal_source:
            return self.held[name].reject(Verdict.NOT_SOURCE)
        if name == "friction" and self._route is not None:
            return self.held[name].reject(Verdict.NOT_SOURCE)
        return self.held[name].offer(value, self._motion.step)

    def follow(self, demand: LongitudinalDemand) -> tuple[str, float, Verdict]:
        """Accept or reject the longitudinal motion that a steering message demands.

        Parameters
        ----------
        demand : LongitudinalDemand

        Returns
        -------
        name : str
            Input that it is for: ``acceleration`` where the message holds one and the model takes it.
        value : float
        verdict : Verdict
        """
        name, value = "speed", demand.speed
        if demand.acceleration is not None and "acceleration" in self.held:
            name, value = "acceleration", demand.acceleration
        verdict = self.held[name].offer(value, self._motion.step)
        if name == "speed" and verdict in ACCEPTED:
            self._speed_rate = demand.rate
        return name, value, verdict

    @property
    def by_steering(self) -> bool:
        """True if the speed or acceleration of the steering messages counts."""
        return self._settings.longitudinal_source == "steering"

    @property
    def silent(self) -> list[str]:
        """Inputs besides steering that were commanded, but not for longer than the timeout."""
        step, timeout = self._motion.step, self.steering_input.timeout_steps
        source = self._settings.longitudinal_source
        return [
            name
            for name, held in self.held.items()
            if (age := held.steps_since_command(step)) is not None
            and age > timeout
            and held.value is not None
            and ((kind := input_of(name)) is None or kind.repeated)
            and (name not in LONGITUDINAL or source in {name, "steering"})
        ]

    @property
    def commanded(self) -> bool:
        """True if a command has been accepted."""
        step = self._motion.step
        if self.steering_input.steps_since_command(step) is not None:
            return True
        return any(held.steps_since_command(step) is not None for held in self.held.values())

    def reset(self) -> None:
        """Return to the start at the next step."""
        self._reset = True

    def change(self, settings: SimParameters) -> None:
        """Apply other settings from now on, as far as they can change during a run."""
        for name, value in _limits(settings, self._grid).items():
            setattr(self.steering_input, name, value)
        speed = self.held["speed"]
        if settings.longitudinal_source == "parameter" and settings.speed not in {None, self._settings.speed}:
            speed.value = settings.speed
        elif settings.longitudinal_source != self._settings.longitudinal_source:
            self._speed_rate = 0.0
            if self._settings.longitudinal_source in {"acceleration", "steering"}:
                speed.value = self._motion.speed  # nothing else demands it
        self._settings = settings

    def inputs(self, steps: range) -> Sequence[AppliedInput]:
        """See `Source`."""
        found = []
        if self._reset:
            self._reset = False
            found.append(AppliedInput(steps[0], "reset", 0.0))
            self._distance = 0.0
        self._follow_route()
        found += self._new(steps[0])
        while self._ahead and self._ahead[0][0] <= self._grid.seconds(steps[-1]):
            due, name, value = self._ahead.popleft()
            step = max(self._step_at(due), steps[0])
            self.held[name].offer(value, step - 1)
            found += self._new(step)
        return found

    def _follow_route(self) -> None:
        """Let the friction of the present place act; backwards the distance decreases."""
        if self._route is None:
            return
        (since, before), now = self._last, (self._motion.step, self._motion.speed)
        self._last = now
        self._distance += 0.5 * (before + now[1]) * self._grid.seconds(now[0] - since)
        if (friction := self._route.at(self._distance)) is not None:
            self.held["friction"].value = friction

    def _new(self, step: int) -> list[AppliedInput]:
        """Inputs that differ from the applied ones, from a step on."""
        found = []
        for name, held in self.held.items():
            value = held.value
            if name == "speed":
                value = self._approached(value)
            elif name == "acceleration" and self._lag is not None:
                value = self._lagged(value, step)
            if value is not None and value != self._applied.get(name):
                self._applied[name] = value
                found.append(AppliedInput(step, name, value))
                self._end_other(name)
        return found

    def _lagged(self, acceleration: float | None, step: int) -> float | None:
        """Acceleration to apply from a step on [m/s^2]."""
        assert self._lag is not None  # noqa: S101 - only then it is called
        if acceleration is None:
            self._lag.clear()
            return None
        return self._lag.follow(self._grid.seconds(step), acceleration)

    def _approached(self, speed: float | None) -> float | None:
        """Speed to apply in this period on the way to a target [m/s]."""
        if speed is None or not self._speed_rate:
            return speed
        before = self._applied["speed"]
        before = self._motion.speed if before is None else before
        most = self._speed_rate * self._grid.period_ns / SECOND
        return min(max(speed, before - most), before + most)

    def _end_other(self, name: str) -> None:
        """Use the newer of speed and acceleration; the other one acts when it arrives again."""
        for other in LONGITUDINAL:
            if name in LONGITUDINAL and other != name and other in self.held:
                self.held[other].value = self._applied[other] = None

    def _steps_in(self, time: float) -> int:
        return nanoseconds(time) // self._grid.step_ns

    def _step_at(self, time: float) -> int:
        """First step at a time in s or after it."""
        step = nanoseconds(time) // self._grid.step_ns
        return step if self._grid.seconds(step) >= time else step + 1

    def steering(self, steps: range) -> Sequence[float]:
        """See `Source`."""
        commands = self._commands(steps)
        if self._delayed:
            self._delayed.extend(commands)
            commands = [self._delayed.popleft() for _ in steps]
        return self._actuator.follow_all(commands)

    def _commands(self, steps: range) -> list[float]:
        """Angles demanded from each of these steps on [rad]."""
        if not self._by_topic:
            return list(map(self._command, steps))
        # No command comes in between, so that the angle changes at most once, at a timeout.
        first, last = self._command(steps[0]), self._command(steps[-1])
        return [first] * len(steps) if first == last else list(map(self._command, steps))

    def received(self) -> tuple[Command, ...]:
        """See `Source`."""
        if not self._received:
            return ()
        received, self._received = tuple(self._received), []
        return received

    def _offer(self, angle: float, step: int, age: float | None = None, message: object = None) -> Verdict:
        """Accept or reject a steering command that arrived after a step."""
        verdict = self.steering_input.offer(angle, step, age)
        if verdict in ACCEPTED:
            self._received.append(Command(step + 1, angle, message))
        return verdict

    def _command_source(self, settings: SimParameters, log: Signal | None) -> Callable[[int], float]:
        """Road-wheel angle demanded from each step on [rad]."""
        steering, seconds = self.steering_input, self._grid.seconds
        if settings.manoeuvre != "none":
            manoeuvre = make_manoeuvre(settings.manoeuvre, settings.manoeuvre_settings)
            return lambda step: steering.limited(manoeuvre(seconds(step)))
        if log is None:
            return steering.at
        ahead = zip(*log, strict=True)
        due, angle = next(ahead)

        def played(step: int) -> float:
            nonlocal due, angle
            while due <= seconds(step):
                self._offer(angle, step - 1)
                due, angle = next(ahead, (float("inf"), 0.0))
            return steering.at(step)

        return played


def _limits(settings: SimParameters, grid: TimeGrid) -> dict[str, Any]:
    """Settings that a `SteeringInput` follows while running."""
    return {
        "limit": settings.max_steering_angle,
        "timeout_steps": nanoseconds(settings.steering_timeout) // grid.step_ns,
        "zero_on_timeout": settings.on_steering_timeout == "zero",
        "max_age": settings.max_steering_age,
    }
