"""The one exception of the dynamics room."""

from yawdamp_ros.errors import YawdampError


class DynamicsError(YawdampError):
    """A linear model that does not exist for this vehicle, model or speed.

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> from yawdamp_ros.dynamics import DynamicsError
    >>> try:
    ...     linear_model(load_vehicle("interlink"), speed=0.0)
    ... except DynamicsError as error:
    ...     print(error)
    speed: 0.0: expected a speed of at least 0.01 m/s
    """
