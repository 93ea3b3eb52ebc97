"""The one exception of the simulation room."""

from yawdamp_ros.errors import YawdampError


class SimulationError(YawdampError):
    """A run that cannot be as it was asked for."""
