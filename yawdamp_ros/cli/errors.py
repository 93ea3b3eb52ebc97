"""The one exception of the commands."""

from yawdamp_ros.errors import YawdampError


class UsageError(YawdampError):
    """Options that do not go together, or a value that cannot be one."""
