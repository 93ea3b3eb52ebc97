"""The one record that crosses from the numerics to messages and files."""

from typing import Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from yawdamp_ros.dynamics.kinematics import ComplexArray, FloatArray


class AppliedInput(NamedTuple):
    """Something that acted on the model from a step on; a run is repeated from these alone.

    Attributes
    ----------
    step : int
    name : str
        ``steering``, ``speed`` or ``reset``.
    value : float
        Road-wheel steer angle in rad, speed in m/s, or 0 for a reset.
    """

    step: int
    name: Literal["steering", "speed", "reset"]
    value: float


class Sample(NamedTuple):
    """Everything known of an n-unit combination at one instant, or at m instants.

    Arrays of one instant are of the shapes below; those of m instants have an axis of m before.

    Attributes
    ----------
    step : ndarray, shape ()
        Steps since the start; with the step size, the time.
    steering_angle : ndarray, shape ()
        Road-wheel steer angle in force from this instant on, rad.
    speed : float
        Longitudinal speed, m/s.
    x, y : ndarray, shape (n,)
        Centres of gravity in the ground frame, m.
    yaw, yaw_rate : ndarray, shape (n,)
        rad and rad/s; yaw is not wrapped.
    heading : ndarray of complex, shape (n,)
        ``cos(yaw) + i sin(yaw)``, exact after any number of turns, which the yaw as one number is not.
    velocity : ndarray of complex, shape (n,)
        Of each centre of gravity in its unit's own frame, forward and to the left as real and imaginary part:
        the rate of the pose, m/s.
    lateral_velocity, lateral_acceleration : ndarray, shape (n,)
        Of the linear model, for small angles: of each centre of gravity in its unit's own frame, gravity
        excluded, m/s and m/s^2.
    articulation, articulation_rate : ndarray, shape (n - 1,)
        ``psi_k - psi_(k+1)`` and its rate, rad and rad/s.
    inputs : tuple of AppliedInput
        What took effect after the sample before, up to the last of these, in order.
    """

    step: npt.NDArray[np.int64]
    steering_angle: FloatArray
    speed: float
    x: FloatArray
    y: FloatArray
    yaw: FloatArray
    yaw_rate: FloatArray
    heading: ComplexArray
    velocity: ComplexArray
    lateral_velocity: FloatArray
    lateral_acceleration: FloatArray
    articulation: FloatArray
    articulation_rate: FloatArray
    inputs: tuple[AppliedInput, ...]
