"""Readers of steering logs and drives, and files of sweeps.

The names below load on first use.
"""

from typing import TYPE_CHECKING

from yawdamp_ros.lazy import load_on_use

if TYPE_CHECKING:
    from yawdamp_ros.logs.errors import LogError
    from yawdamp_ros.logs.mcap_log import McapLog, MessageDecoder, RecordedMessage, is_recording
    from yawdamp_ros.logs.steering_csv import read_steering_csv
    from yawdamp_ros.logs.steering_log import SteeringLog
    from yawdamp_ros.logs.steering_mcap import read_steering_mcap

__all__ = [
    "LogError",
    "McapLog",
    "MessageDecoder",
    "RecordedMessage",
    "SteeringLog",
    "is_recording",
    "read_steering_csv",
    "read_steering_mcap",
]

__getattr__ = load_on_use(
    __name__,
    {
        "yawdamp_ros.logs.errors": ("LogError",),
        "yawdamp_ros.logs.mcap_log": ("McapLog", "MessageDecoder", "RecordedMessage", "is_recording"),
        "yawdamp_ros.logs.steering_csv": ("read_steering_csv",),
        "yawdamp_ros.logs.steering_log": ("SteeringLog",),
        "yawdamp_ros.logs.steering_mcap": ("read_steering_mcap",),
    },
)


def __dir__() -> list[str]:
    return __all__
