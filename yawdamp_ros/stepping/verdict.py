"""Verdicts on commands and speeds."""

from enum import StrEnum


class Verdict(StrEnum):
    """Key of what was done with a command or a speed."""

    ACCEPTED = "accepted"
    CLAMPED = "clamped"
    NOT_FINITE = "rejected_not_finite"
    BACKWARDS = "rejected_backwards"
    NO_JOINT = "rejected_no_joint"
    STALE = "rejected_stale"
    NOT_SOURCE = "rejected_not_source"
