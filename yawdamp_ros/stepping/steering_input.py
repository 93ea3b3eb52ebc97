"""Checks of a steering command before it reaches the actuator."""

import math

from yawdamp_ros.stepping.verdict import Verdict


class SteeringInput:
    """The newest valid steering command, held, scaled, limited and timed out.

    The timeout is counted in steps, so that a run repeats on a busy machine, too. The attributes may
    change while running.

    Parameters
    ----------
    ratio : float
        Commanded angle over road-wheel angle: 1 for road-wheel commands, the steering ratio for those
        of the hand wheel.
    limit : float
        Largest road-wheel angle in rad; a command past it is clamped and counted.
    timeout_steps : int
        Steps without a command after which `zero_on_timeout` applies.
    zero_on_timeout : bool
        Whether a timeout returns the wheels to straight ahead; else the last command is held.
    max_age : float
        Largest difference of a stamp from the present, past or future [s]; 0 for no limit.

    Attributes
    ----------
    counts : dict of Verdict to int
        Commands offered so far, by verdict.

    Examples
    --------
    >>> source = SteeringInput(ratio=1.0, limit=0.5, timeout_steps=100, zero_on_timeout=False, max_age=0.0)
    >>> source.offer(0.8, step=0)
    <Verdict.CLAMPED: 'clamped'>
    >>> source.at(1)
    0.5
    """

    def __init__(
        self, *, ratio: float, limit: float, timeout_steps: int, zero_on_timeout: bool, max_age: float
    ) -> None:
        self.ratio = ratio
        self.limit = limit
        self.timeout_steps = timeout_steps
        self.zero_on_timeout = zero_on_timeout
        self.max_age = max_age
        self.counts = dict.fromkeys(
            (Verdict.ACCEPTED, Verdict.CLAMPED, Verdict.NOT_FINITE, Verdict.NO_JOINT, Verdict.STALE), 0
        )
        self._angle = 0.0
        self._received_at: int | None = None

    def offer(self, command: float, step: int, age: float | None = None) -> Verdict:
        """Accept, clamp or reject a command that arrived after a step, and count which.

        A rejected command leaves the one before it in force.

        Parameters
        ----------
        command : float
            Road-wheel angle times the ratio [rad].
        step : int
        age : float, optional
            Time since it was stamped [s]; None if it bears no stamp.

        Returns
        -------
        Verdict
        """
        verdict, angle = self._judge(command, age)
        self.counts[verdict] += 1
        if verdict in {Verdict.ACCEPTED, Verdict.CLAMPED}:
            self._angle, self._received_at = angle, step
        return verdict

    def reject(self, verdict: Verdict) -> None:
        """Count a message that held no command."""
        self.counts[verdict] += 1

    def at(self, step: int) -> float:
        """Road-wheel steer angle demanded from a step on, within the present limit [rad]."""
        if self.zero_on_timeout and self.timed_out(step):
            return 0.0
        return self.limited(self._angle)

    def limited(self, angle: float) -> float:
        """Road-wheel angle within the present limit [rad]."""
        return min(max(angle, -self.limit), self.limit)

    def steps_since_command(self, step: int) -> int | None:
        """Steps since the last command; None before the first."""
        return None if self._received_at is None else step - self._received_at

    def timed_out(self, step: int) -> bool:
        """True if a command has arrived and the last one is older than the timeout."""
        silence = self.steps_since_command(step)
        return silence is not None and silence > self.timeout_steps

    def _judge(self, command: float, age: float | None) -> tuple[Verdict, float]:
        if not math.isfinite(command):
            return Verdict.NOT_FINITE, 0.0
        if age is not None and self.max_age and abs(age) > self.max_age:
            return Verdict.STALE, 0.0
        angle = command / self.ratio
        if abs(angle) > self.limit:
            return Verdict.CLAMPED, math.copysign(self.limit, angle)
        return Verdict.ACCEPTED, angle
