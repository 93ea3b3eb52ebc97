"""The one exception of the commands."""

from yawdamp_ros.errors import YawdampError


class UsageError(YawdampError):
    """Options that exclude each other, or an invalid value."""
