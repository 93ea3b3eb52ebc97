"""Recorded drives as arrays: channels, prediction, comparison and identification.

The names below load on first use: a reader of drives does not need the fitting.
"""

from typing import TYPE_CHECKING

from yawdamp_ros.lazy import load_on_use

if TYPE_CHECKING:
    from yawdamp_ros.drives.channel import QUANTITIES, UNITS, Channel, quantity_of
    from yawdamp_ros.drives.comparison import ChannelComparison, Excitation, compare, excitation
    from yawdamp_ros.drives.drive import INPUTS, Drive, is_input, speeds_by_acceleration
    from yawdamp_ros.drives.errors import DriveError
    from yawdamp_ros.drives.identification import Estimate, Identification, identify
    from yawdamp_ros.drives.matching import Match, matches
    from yawdamp_ros.drives.parameters import DEFAULT, Parameter
    from yawdamp_ros.drives.prediction import Inputs, inputs_of, predict

__all__ = [
    "DEFAULT",
    "INPUTS",
    "QUANTITIES",
    "UNITS",
    "Channel",
    "ChannelComparison",
    "Drive",
    "DriveError",
    "Estimate",
    "Excitation",
    "Identification",
    "Inputs",
    "Match",
    "Parameter",
    "compare",
    "excitation",
    "identify",
    "inputs_of",
    "is_input",
    "matches",
    "predict",
    "quantity_of",
    "speeds_by_acceleration",
]

__getattr__ = load_on_use(
    __name__,
    {
        "yawdamp_ros.drives.channel": ("QUANTITIES", "UNITS", "Channel", "quantity_of"),
        "yawdamp_ros.drives.comparison": ("ChannelComparison", "Excitation", "compare", "excitation"),
        "yawdamp_ros.drives.drive": ("INPUTS", "Drive", "is_input", "speeds_by_acceleration"),
        "yawdamp_ros.drives.errors": ("DriveError",),
        "yawdamp_ros.drives.identification": ("Estimate", "Identification", "identify"),
        "yawdamp_ros.drives.matching": ("Match", "matches"),
        "yawdamp_ros.drives.parameters": ("DEFAULT", "Parameter"),
        "yawdamp_ros.drives.prediction": ("Inputs", "inputs_of", "predict"),
    },
)
