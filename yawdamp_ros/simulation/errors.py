"""The one exception of the simulation room."""

from yawdamp_ros.errors import YawdampError


class SimulationError(YawdampError):
    """Run that is not possible with its settings.

    Examples
    --------
    >>> from yawdamp_ros.simulation import SimulationError, make_motion
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> try:
    ...     make_motion(load_vehicle("interlink"), "cubic", None, 0.001)
    ... except SimulationError as error:
    ...     print(error)
    model: 'cubic': expected one of consistent, published, nonlinear
    """
