"""The one exception of the stepping room."""

from yawdamp_ros.errors import YawdampError


class SteppingError(YawdampError):
    """Mismatch of steps, periods or durations, or a motion that overflows.

    Examples
    --------
    >>> from yawdamp_ros.stepping import SteppingError, TimeGrid
    >>> try:
    ...     TimeGrid.of(0.001, 0.0105)
    ... except SteppingError as error:
    ...     print(error)
    step_size: 0.001 s: expected a whole number of steps in a sample period of 0.0105 s
    """
