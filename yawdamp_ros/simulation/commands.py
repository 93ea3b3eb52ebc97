"""Commands on their way to the model: taken or refused, limited, timed out, lagged."""

from collections import deque
from collections.abc import Callable, Sequence
from typing import Any

from yawdamp_ros.manoeuvres import make_manoeuvre
from yawdamp_ros.simulation.settings import SimParameters
from yawdamp_ros.stepping import (
    AppliedInput,
    Command,
    Motion,
    SpeedInput,
    SteeringActuator,
    SteeringInput,
    TimeGrid,
    Verdict,
)
from yawdamp_ros.stepping.time_grid import nanoseconds

ACCEPTED = frozenset({Verdict.ACCEPTED, Verdict.CLAMPED})


class Commands:
    """The source of a run that is driven: by a manoeuvre, by a log, or by whoever calls `steer`.

    Parameters
    ----------
    settings : SimParameters
    grid : TimeGrid
    motion : Motion
        That they are for.
    log : (sequence of float, sequence of float), optional
        Times in s and commanded angles in rad, each in force until the next.
    speeds : (sequence of float, sequence of float), optional
        Times in s and speeds in m/s to be followed, each in force until the next.

    Attributes
    ----------
    steering_input : SteeringInput
    speed_input : SpeedInput

    Raises
    ------
    ManoeuvreError
        If the settings' manoeuvre cannot be.
    """

    def __init__(
        self,
        settings: SimParameters,
        grid: TimeGrid,
        motion: Motion,
        log: tuple[Sequence[float], Sequence[float]] | None = None,
        speeds: tuple[Sequence[float], Sequence[float]] | None = None,
    ) -> None:
        self.steering_input = SteeringInput(ratio=settings.steering_ratio, **_limits(settings, grid))
        self.speed_input = SpeedInput(motion.speed)
        self._actuator = SteeringActuator(
            grid.step_size, settings.steering_time_constant, settings.steering_rate_limit
        )
        self._grid = grid
        self._motion = motion
        self._speed = motion.speed
        self._settings = settings
        self._reset = False
        self._received: list[Command] = []
        self._command = self._command_source(settings, log)
        self._speeds = deque(zip(*speeds, strict=True)) if speeds else deque[tuple[float, float]]()

    def steer(self, angle: float, age: float | None = None, message: object = None) -> Verdict:
        """Accept or reject a steering command, which acts from the next step on.

        Parameters
        ----------
        angle : float
            As commanded, rad.
        age : float, optional
            How long ago it was stamped, in s; None if it bears no stamp.
        message : object, optional
            What held it, to be recorded.
        """
        return self._offer(angle, self._motion.step, age, message)

    def reset(self) -> None:
        """Return to rest at the origin at the next step."""
        self._reset = True

    def change(self, settings: SimParameters) -> None:
        """Go by other settings from now on, as far as they can change while running."""
        for name, value in _limits(settings, self._grid).items():
            setattr(self.steering_input, name, value)
        if settings.speed is not None and settings.speed != self._settings.speed:
            self.speed_input.speed = settings.speed
        self._settings = settings

    def inputs(self, steps: range) -> Sequence[AppliedInput]:
        """See `Source`."""
        found = []
        if self._reset:
            self._reset = False
            found.append(AppliedInput(steps[0], "reset", 0.0))
        found += self._new_speed(steps[0])
        while self._speeds and self._speeds[0][0] <= self._grid.seconds(steps[-1]):
            due, speed = self._speeds.popleft()
            self.speed_input.offer(speed)
            found += self._new_speed(max(self._step_at(due), steps[0]))
        return found

    def _new_speed(self, step: int) -> list[AppliedInput]:
        if self.speed_input.speed == self._speed:
            return []
        self._speed = self.speed_input.speed
        return [AppliedInput(step, "speed", self._speed)]

    def _step_at(self, time: float) -> int:
        """First step at a time in s or after it."""
        step = nanoseconds(time) // self._grid.step_ns
        return step if self._grid.seconds(step) >= time else step + 1

    def steering(self, steps: range) -> Sequence[float]:
        """See `Source`."""
        return self._actuator.follow_all(list(map(self._command, steps)))

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

    def _command_source(
        self, settings: SimParameters, log: tuple[Sequence[float], Sequence[float]] | None
    ) -> Callable[[int], float]:
        """Road-wheel angle in rad asked for from each step on."""
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
    """What of the settings a `SteeringInput` goes by while running."""
    return {
        "limit": settings.max_steering_angle,
        "timeout_steps": nanoseconds(settings.steering_timeout) // grid.step_ns,
        "zero_on_timeout": settings.on_steering_timeout == "zero",
        "max_age": settings.max_steering_age,
    }
