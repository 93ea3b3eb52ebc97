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
        # Arrays and no numbers, which NumPy would convert at every use.
        self._half_step = np.array(0.5 * step_size, dtype=np.complex128)
        self._speed = np.zeros((), dtype=np.complex128)
        self._arrays = _Arrays(0)

    def set_velocity(self, speed: float, lateral_velocity: float, yaw: float) -> None:
        """Set speed [m/s], which stays, lateral velocity [m/s] and yaw [rad] at this instant."""
        heading = complex(np.exp(complex(0.0, yaw)))
        # To the bits that `advance` computes.
        self.velocity = complex(
            heading.real * speed - lateral_velocity * heading.imag,
            heading.imag * speed + lateral_velocity * heading.real,
        )
        self._speed[()] = speed

    def advance(
        self, lateral_velocity: FloatArray, turned: FloatArray, direction: FloatArray | float
    ) -> ComplexArray:
        """Go on over k steps.

        Parameters
        ----------
        lateral_velocity : ndarray, shape (k,)
            Lateral velocity after each step [m/s].
        turned, direction : ndarray, shape (k,)
            Two parts of the yaw after each step [rad]; the second may be common to all.

        Returns
        -------
        ndarray of complex, shape (k,)
            Position after each step [m].
        """
        # A step costs less than the making of an array, and most calls are for as many steps as the last one.
        if len(self._arrays.angle) != len(turned):
            self._arrays = _Arrays(len(turned))
        use = self._arrays
        use.velocities[0] = self.velocity
        np.add(turned, direction, out=use.angle)
        after = np.exp(use.exponent, out=use.after)
        # No products of two complex numbers with two parts: NumPy rounds them differently at an array's end.
        use.lateral[:] = lateral_velocity
        np.multiply(use.sideways, after, out=use.across)
        np.multiply(after, self._speed, out=after)
        np.add(after, use.across, out=after)
        positions: ComplexArray = np.add(use.before, after)
        np.multiply(positions, self._half_step, out=positions)
        positions[0] = positions.item(0) + self.position
        np.add.accumulate(positions, out=positions)
        self.position, self.velocity = positions.item(-1), after.item(-1)
        return positions


class _Arrays:
    """Arrays for so many steps, and views of their parts."""

    def __init__(self, steps: int) -> None:
        self.exponent, self.sideways, self.across = np.zeros((3, steps), dtype=np.complex128)
        self.angle, self.lateral = self.exponent.imag, self.sideways.imag
        self.velocities = np.zeros(steps + 1, dtype=np.complex128)
        self.before, self.after = self.velocities[:-1], self.velocities[1:]
