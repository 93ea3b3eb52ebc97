"""The one exception of the dynamics room."""

from yawdamp_ros.errors import YawdampError


class DynamicsError(YawdampError):
    """A linear model that cannot be had for this vehicle, model or speed."""
