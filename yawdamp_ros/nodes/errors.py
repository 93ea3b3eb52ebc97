"""The one exception of the nodes room."""

from yawdamp_ros.errors import YawdampError


class NodeError(YawdampError):
    """A node that cannot start as it was asked to."""
