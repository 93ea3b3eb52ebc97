"""States and reasons that the node reports: keys for programs, and a sentence each for users."""

from collections.abc import Mapping
from enum import StrEnum
from types import MappingProxyType

from yawdamp_ros.stepping import Verdict


class TimingState(StrEnum):
    """Keys that say whether simulated time keeps up with real time."""

    IN_TIME = "in_time"
    PAUSED = "paused"
    STEPS_DROPPED = "steps_dropped"
    CALLBACK_FAILED = "callback_failed"


class SteeringState(StrEnum):
    """Origin of the steering angle in force."""

    NO_COMMAND = "no_command"
    COMMANDED = "commanded"
    TIMED_OUT = "timed_out"
    MANOEUVRE = "manoeuvre"


class InputState(StrEnum):
    """Keys that say whether inputs besides the steering have come, and go on coming."""

    NO_COMMAND = "no_command"
    COMMANDED = "commanded"
    TIMED_OUT = "timed_out"


class EventState(StrEnum):
    """Keys that say whether something happened to the vehicle since the last look."""

    NOTHING = "nothing"
    HAPPENED = "happened"


class RecorderState(StrEnum):
    """State of the recording."""

    IDLE = "idle"
    RECORDING = "recording"
    DROPPING = "dropping"
    FAILED = "failed"


class ModelState(StrEnum):
    """State of the model in force."""

    STABLE = "stable"
    UNSTABLE = "unstable"
    BEYOND_LINEAR_RANGE = "beyond_linear_range"


class Problem(StrEnum):
    """Reason why the node and another end of its topics do not work together."""

    SHARED_MEMORY_REMOVED = "shared_memory_removed"
    TYPE_MISMATCH = "type_mismatch"
    QOS_MISMATCH = "qos_mismatch"
    SEVERAL_PUBLISHERS = "several_publishers"
    SAME_NAME = "same_name"


class Reply(StrEnum):
    """Key of a service's answer, at the start of its message."""

    RESET = "reset"
    PAUSED = "paused"
    RUNNING = "running"
    STEPPED = "stepped"
    NOT_PAUSED = "not_paused"
    STOPPED = "stopped"
    FAILED = "failed"


VERDICT_SENTENCES: Mapping[Verdict, str] = MappingProxyType(
    {
        Verdict.ACCEPTED: "accepted",
        Verdict.CLAMPED: "outside the limits, clamped",
        Verdict.NOT_FINITE: "rejected, not a finite number",
        Verdict.BACKWARDS: "rejected, the model only drives forwards",
        Verdict.NO_JOINT: "rejected, without the joint that steers",
        Verdict.STALE: "rejected, its time stamp is too far from now",
        Verdict.NOT_SOURCE: "rejected, longitudinal_source or friction_file names another source",
    }
)

RECORDER_SENTENCES: Mapping[RecorderState, str] = MappingProxyType(
    {
        RecorderState.IDLE: "not recording",
        RecorderState.RECORDING: "recording to {}",
        RecorderState.DROPPING: "messages dropped, the disk does not keep up",
        RecorderState.FAILED: "failed: {}",
    }
)
"""Sentences; braces hold the directory or the reason."""


def answer(key: StrEnum, sentence: str) -> str:
    """Message of a service's response: a key for programs, then a sentence.

    Parameters
    ----------
    key : StrEnum
    sentence : str

    Returns
    -------
    str

    Examples
    --------
    >>> answer(Reply.NOT_PAUSED, "call ~/pause first")
    'not_paused: call ~/pause first'
    """
    return f"{key}: {sentence}"
