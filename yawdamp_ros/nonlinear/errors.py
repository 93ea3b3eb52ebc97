"""The one exception of the nonlinear room."""

from yawdamp_ros.errors import YawdampError


class NonlinearError(YawdampError):
    """A motion that cannot be computed, said in one line."""
