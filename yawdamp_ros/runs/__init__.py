"""Runs on disk: outputs and their encoding, written, read and compared.

The names below load on first use: a node that writes a run needs no reader. Only the code that encodes
messages imports ROS.
"""

from typing import TYPE_CHECKING

from yawdamp_ros.lazy import load_on_use

if TYPE_CHECKING:
    from yawdamp_ros.runs.background import BackgroundWriter
    from yawdamp_ros.runs.outputs import OUTPUTS, Of, Output
    from yawdamp_ros.runs.response_csv import ResponseCsv
    from yawdamp_ros.runs.response_reader import read_response_csv
    from yawdamp_ros.runs.response_recording import read_response_recording
    from yawdamp_ros.runs.run_writer import (
        Channel,
        RunWriter,
        SerialisedMessage,
        default_run_directory,
        make_run_directory,
    )

__all__ = [
    "OUTPUTS",
    "BackgroundWriter",
    "Channel",
    "Of",
    "Output",
    "ResponseCsv",
    "RunWriter",
    "SerialisedMessage",
    "default_run_directory",
    "make_run_directory",
    "read_response_csv",
    "read_response_recording",
]

__getattr__ = load_on_use(
    __name__,
    {
        "yawdamp_ros.runs.background": ("BackgroundWriter",),
        "yawdamp_ros.runs.outputs": ("OUTPUTS", "Of", "Output"),
        "yawdamp_ros.runs.response_csv": ("ResponseCsv",),
        "yawdamp_ros.runs.response_reader": ("read_response_csv",),
        "yawdamp_ros.runs.response_recording": ("read_response_recording",),
        "yawdamp_ros.runs.run_writer": (
            "Channel",
            "RunWriter",
            "SerialisedMessage",
            "default_run_directory",
            "make_run_directory",
        ),
    },
)
