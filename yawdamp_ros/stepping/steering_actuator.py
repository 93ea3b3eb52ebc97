"""The lag between a steering command and the road wheels."""

import math
from collections.abc import Sequence


class SteeringActuator:
    """Rate limit and first-order lag between a command and the road wheels; either may be off.

    Over a step the command is held, and the lag is its exact solution.

    Parameters
    ----------
    step_size : float
        Time step [s].
    time_constant : float
        Time constant of the lag [s]; 0 for no lag.
    rate_limit : float
        Largest rate of the road-wheel angle [rad/s]; 0 for no limit.

    Examples
    --------
    >>> from yawdamp_ros.stepping import SteeringActuator
    >>> actuator = SteeringActuator(step_size=0.01, time_constant=0.0, rate_limit=0.5)
    >>> [round(actuator.follow(0.02), 3) for _ in range(5)]
    [0.005, 0.01, 0.015, 0.02, 0.02]
    """

    def __init__(self, step_size: float, time_constant: float, rate_limit: float) -> None:
        self._closing = 1.0 - math.exp(-step_size / time_constant) if time_constant else 1.0
        self._largest_change = step_size * rate_limit if rate_limit else math.inf
        self._demand = 0.0
        self._angle = 0.0

    def follow(self, command: float) -> float:
        """Road-wheel angle [rad], one step after the last one, on the way to a command [rad]."""
        change = command - self._demand
        if abs(change) > self._largest_change:
            self._demand += math.copysign(self._largest_change, change)
        else:
            self._demand = command
        if self._closing == 1.0:
            self._angle = self._demand
        else:
            self._angle += self._closing * (self._demand - self._angle)
        return self._angle

    def follow_all(self, commands: Sequence[float]) -> Sequence[float]:
        """Road-wheel angles in rad over steps, on the way to a command in rad each."""
        if self._closing == 1.0 and self._largest_change == math.inf:
            self._demand = self._angle = commands[-1]
            return commands
        return list(map(self.follow, commands))
