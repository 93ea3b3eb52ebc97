"""Steering logs in, runs out and in again."""

from yawdamp_ros.logs.background import BackgroundWriter
from yawdamp_ros.logs.errors import LogError
from yawdamp_ros.logs.mcap_log import McapLog, MessageDecoder, RecordedMessage, is_recording
from yawdamp_ros.logs.response_csv import ResponseCsv
from yawdamp_ros.logs.run_writer import (
    Channel,
    RunWriter,
    SerialisedMessage,
    default_run_directory,
    unused,
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
    "read_steering_csv",
    "read_steering_mcap",
    "unused",
]
