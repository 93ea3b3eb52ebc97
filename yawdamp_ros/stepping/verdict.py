"""Verdicts on commands and speeds."""

from enum import StrEnum


class Verdict(StrEnum):
    """Keys of the node's decision on a command or a speed.

    Examples
    --------
    >>> from yawdamp_ros.stepping import Verdict
    >>> list(Verdict)[0].value
    'accepted'
    """

    ACCEPTED = "accepted"
    CLAMPED = "clamped"
    NOT_FINITE = "rejected_not_finite"
    BACKWARDS = "rejected_backwards"
    NO_JOINT = "rejected_no_joint"
    STALE = "rejected_stale"
    NOT_SOURCE = "rejected_not_source"
