"""Steering logs in, runs out and in again."""

from yawdamp_ros.logs.background import BackgroundWriter
from yawdamp_ros.logs.errors import LogError
from yawdamp_ros.logs.response_csv import ResponseCsv
from yawdamp_ros.logs.run_writer import Channel, RunWriter, default_run_directory
from yawdamp_ros.logs.steering_csv import read_steering_csv
from yawdamp_ros.logs.steering_log import SteeringLog

__all__ = [
    "BackgroundWriter",
    "Channel",
    "LogError",
    "ResponseCsv",
    "RunWriter",
    "SteeringLog",
    "default_run_directory",
    "read_steering_csv",
]
