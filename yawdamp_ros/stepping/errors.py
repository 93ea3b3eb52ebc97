"""The one exception of the stepping room."""

from yawdamp_ros.errors import YawdampError


class SteppingError(YawdampError):
    """Steps, periods or durations that do not fit together, or a motion beyond all numbers."""
