"""The one exception of the manoeuvres room."""

from yawdamp_ros.errors import YawdampError


class ManoeuvreError(YawdampError):
    """A manoeuvre that does not exist, or a setting that it does not accept.

    Examples
    --------
    >>> from yawdamp_ros.manoeuvres import ManoeuvreError, make_manoeuvre
    >>> try:
    ...     make_manoeuvre("zigzag", {})
    ... except ManoeuvreError as error:
    ...     print(error)
    manoeuvre: 'zigzag': expected one of lane_change, sine, step, ramp, chirp, pulse
    """
