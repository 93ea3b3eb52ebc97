"""The one exception of the manoeuvres room."""

from yawdamp_ros.errors import YawdampError


class ManoeuvreError(YawdampError):
    """A manoeuvre that does not exist, or a setting it cannot take."""
