"""Steering logs in, runs out and in again.

The names below load on first use: a node that writes a run does not need what reads one.
"""

from typing import TYPE_CHECKING

from yawdamp_ros.lazy import load_on_use

if TYPE_CHECKING:
    from yawdamp_ros.logs.background import BackgroundWriter
    from yawdamp_ros.logs.errors import LogError
    from yawdamp_ros.logs.mcap_log import McapLog, MessageDecoder, RecordedMessage, is_recording
    from yawdamp_ros.logs.response_csv import ResponseCsv
    from yawdamp_ros.logs.run_writer import (
        Channel,
        RunWriter,
        SerialisedMessage,
        default_run_directory,
        make_run_directory,
    )
    from yawdamp_ros.logs.steering_csv import read_steering_csv
    from yawdamp_ros.logs.steering_log import SteeringLog
    from yawdamp_ros.logs.steering_mcap import read_steering_mcap

__all__ = [
    "BackgroundWriter",
    "Channel",
    "LogError",
    "McapLog",
    "MessageDecoder",
    "RecordedMessage",
    "ResponseCsv",
    "RunWriter",
    "SerialisedMessage",
    "SteeringLog",
    "default_run_directory",
    "is_recording",
    "make_run_directory",
    "read_steering_csv",
    "read_steering_mcap",
]

__getattr__ = load_on_use(
    __name__,
    {
        "yawdamp_ros.logs.background": ("BackgroundWriter",),
        "yawdamp_ros.logs.errors": ("LogError",),
        "yawdamp_ros.logs.mcap_log": ("McapLog", "MessageDecoder", "RecordedMessage", "is_recording"),
        "yawdamp_ros.logs.response_csv": ("ResponseCsv",),
        "yawdamp_ros.logs.run_writer": (
            "Channel",
            "RunWriter",
            "SerialisedMessage",
            "default_run_directory",
            "make_run_directory",
        ),
        "yawdamp_ros.logs.steering_csv": ("read_steering_csv",),
        "yawdamp_ros.logs.steering_log": ("SteeringLog",),
        "yawdamp_ros.logs.steering_mcap": ("read_steering_mcap",),
    },
)
