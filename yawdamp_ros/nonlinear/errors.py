"""The one exception of the nonlinear room."""

from yawdamp_ros.errors import YawdampError


class NonlinearError(YawdampError):
    """A motion that cannot be computed; the message is one line.

    Examples
    --------
    >>> from yawdamp_ros.nonlinear import NonlinearDynamics, NonlinearError, steady_turn
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> dynamics = NonlinearDynamics(load_vehicle("truck_trailer"))
    >>> try:
    ...     steady_turn(dynamics, 20.0, dynamics.inputs())
    ... except NonlinearError as error:
    ...     print(error)
    expected a steer angle or a lateral acceleration
    """
