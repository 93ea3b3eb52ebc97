"""The one exception of the analysis room."""

from yawdamp_ros.errors import YawdampError


class AnalysisError(YawdampError):
    """A question that this model cannot answer."""
