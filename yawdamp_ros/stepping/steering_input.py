"""What becomes of a steering command before it reaches the wheels."""

import math


class SteeringInput:
    """The newest valid steering command, held, scaled, limited and timed out.

    Time is counted in steps, so that a run repeats whatever the machine was doing.

    Parameters
    ----------
    ratio : float
        Commanded angle over road-wheel angle: 1 for road-wheel commands, the steering ratio for those
        of the hand wheel.
    limit : float
        Largest road-wheel angle in rad; a command past it is clamped and counted.
    timeout_steps : int
        Steps of silence after which `zero_on_timeout` counts.
    zero_on_timeout : bool
        Whether silence returns the wheels to straight ahead; else the last command is held.
    """

    def __init__(self, *, ratio: float, limit: float, timeout_steps: int, zero_on_timeout: bool) -> None:
        self._ratio = ratio
        self._limit = limit
        self._timeout_steps = timeout_steps
        self._zero_on_timeout = zero_on_timeout
        self._angle = 0.0
        self._received_at: int | None = None
        self.rejected = 0
        self.clamped = 0

    def offer(self, command: float, step: int) -> bool:
        """Take a command in rad that arrived after a step; return False if it was rejected.

        NaN and infinities are rejected and counted: the command before them stays.
        """
        if not math.isfinite(command):
            self.rejected += 1
            return False
        angle = command / self._ratio
        if abs(angle) > self._limit:
            self.clamped += 1
            angle = math.copysign(self._limit, angle)
        self._angle = angle
        self._received_at = step
        return True

    def at(self, step: int) -> float:
        """Road-wheel steer angle in rad in force from a step on."""
        return 0.0 if self._zero_on_timeout and self.timed_out(step) else self._angle

    def timed_out(self, step: int) -> bool:
        """Whether commands came once and have been silent for longer than the timeout."""
        return self._received_at is not None and step - self._received_at > self._timeout_steps
