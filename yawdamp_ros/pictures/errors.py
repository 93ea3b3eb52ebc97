"""The one exception of the pictures room."""

from yawdamp_ros.errors import YawdampError


class PictureError(YawdampError):
    """A picture that cannot be drawn or written."""
