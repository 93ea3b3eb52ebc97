"""The one exception of the nodes room."""

from yawdamp_ros.errors import YawdampError


class NodeError(YawdampError):
    """Node that cannot start with its arguments."""
