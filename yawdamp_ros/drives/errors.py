"""The one exception of the drives room."""

from yawdamp_ros.errors import YawdampError


class DriveError(YawdampError):
    """A drive that cannot be compared or identified, said in one line."""
