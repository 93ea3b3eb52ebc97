"""A measured speed that the model follows quasi-statically."""

import math

LOWEST_SPEED = 1.0
"""In m/s. A slip angle is a lateral velocity over the speed, which means nothing towards standstill."""
HIGHEST_SPEED = 70.0
"""In m/s, as for vehicle files."""


class SpeedInput:
    """The newest valid speed, held; attributes count what was refused or clamped.

    Parameters
    ----------
    speed : float
        Until the first one arrives, m/s.
    """

    def __init__(self, speed: float) -> None:
        self.speed = speed
        self.rejected = 0
        self.clamped = 0

    def offer(self, speed: float) -> bool:
        """Take a speed in m/s; return False if it was refused or clamped.

        NaN, infinities and driving backwards are refused; what is too slow or too fast is clamped.
        """
        if not math.isfinite(speed) or speed < 0.0:
            self.rejected += 1
            return False
        self.speed = min(max(speed, LOWEST_SPEED), HIGHEST_SPEED)
        if self.speed != speed:
            self.clamped += 1
            return False
        return True
