"""The one exception of the analysis room."""

from yawdamp_ros.errors import YawdampError


class AnalysisError(YawdampError):
    """Question that the model cannot answer.

    Examples
    --------
    >>> from yawdamp_ros.analysis import AnalysisError, parse_variation
    >>> try:
    ...     parse_variation("speed")
    ... except AnalysisError as error:
    ...     print(error)
    speed: expected KEY=A:B:N, N values (2 or more) from A to B, as in speed=5:35:31
    """
