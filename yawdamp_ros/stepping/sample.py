"""The one record that crosses from the numerics to messages and files."""

from typing import Literal, NamedTuple

from yawdamp_ros.dynamics.kinematics import FloatArray


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
    """Everything known of an n-unit combination at one instant.

    Attributes
    ----------
    step : int
        Steps since the start; with the step size, the time.
    steering_angle : float
        Road-wheel steer angle in force from this instant on, rad.
    speed : float
        Longitudinal speed, m/s.
    x, y : ndarray, shape (n,)
        Centres of gravity in the ground frame, m.
    yaw, yaw_rate : ndarray, shape (n,)
        rad and rad/s; yaw is not wrapped.
    lateral_velocity, lateral_acceleration : ndarray, shape (n,)
        Of each centre of gravity in its unit's own frame, gravity excluded, m/s and m/s^2.
    articulation, articulation_rate : ndarray, shape (n - 1,)
        ``psi_k - psi_(k+1)`` and its rate, rad and rad/s.
    inputs : tuple of AppliedInput
        What took effect after the previous sample, up to this one, in order.
    """

    step: int
    steering_angle: float
    speed: float
    x: FloatArray
    y: FloatArray
    yaw: FloatArray
    yaw_rate: FloatArray
    lateral_velocity: FloatArray
    lateral_acceleration: FloatArray
    articulation: FloatArray
    articulation_rate: FloatArray
    inputs: tuple[AppliedInput, ...]
