"""The path of the lead unit over ground."""

import numpy as np

from yawdamp_ros.dynamics.kinematics import ComplexArray, FloatArray


class GroundPath:
    """Path by the trapezoidal rule, the only quadrature of a linear model: its velocity turns with the yaw.

    Parameters
    ----------
    step_size : float
        Step size [s].

    Attributes
    ----------
    position, velocity : complex
        ``x + i y`` and its rate in the ground frame at this instant [m, m/s].
    """

    def __init__(self, step_size: float) -> None:
        self.position = self.velocity = 0.0j
        self._half_step = 0.5 * step_size
        self._arrays = _Arrays(0)

    def set_velocity(self, speed: float, lateral_velocity: float, yaw: float) -> None:
        """Set the velocity at this instant, to the bits that `advance` computes."""
        heading = complex(np.exp(complex(0.0, yaw)))
        self.velocity = complex(
            heading.real * speed - lateral_velocity * heading.imag,
            heading.imag * speed + lateral_velocity * heading.real,
        )

    def advance(self, speed: float, lateral_velocity: FloatArray, yaw: FloatArray) -> ComplexArray:
        """Go on over k steps.

        Parameters
        ----------
        speed : float
            Longitudinal speed [m/s].
        lateral_velocity, yaw : ndarray, shape (k,)
            Lateral velocity [m/s] and yaw [rad] after each step.

        Returns
        -------
        ndarray of complex, shape (k,)
            Position after each step [m].
        """
        # A step costs less than the making of an array, and most calls are for as many steps as the last one.
        if len(self._arrays.sideways) != len(yaw):
            self._arrays = _Arrays(len(yaw))
        use = self._arrays
        use.velocities[0] = self.velocity
        use.angle[:] = yaw
        np.exp(use.exponent, out=use.after)
        # No products of two complex numbers: NumPy rounds them differently at the end of an array.
        use.lateral[:] = lateral_velocity
        np.multiply(use.sideways, use.after, out=use.across)
        np.multiply(use.after, speed, out=use.after)
        np.add(use.after, use.across, out=use.after)
        ways = use.before + use.after
        ways *= self._half_step
        ways[0] += self.position
        positions: ComplexArray = np.add.accumulate(ways, out=ways)
        self.position, self.velocity = complex(positions[-1]), complex(use.after[-1])
        return positions


class _Arrays:
    """Arrays for so many steps, and views of their parts."""

    def __init__(self, steps: int) -> None:
        self.exponent, self.sideways, self.across = np.zeros((3, steps), dtype=np.complex128)
        self.angle, self.lateral = self.exponent.imag, self.sideways.imag
        self.velocities = np.zeros(steps + 1, dtype=np.complex128)
        self.before, self.after = self.velocities[:-1], self.velocities[1:]
