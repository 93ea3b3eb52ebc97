"""Modes, measures and sweeps: arrays in, small result types out.

The names below load on first use: some need much of SciPy, which a node that starts does not.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from yawdamp_ros.analysis.assessment import Finding, assess, failed
    from yawdamp_ros.analysis.boundaries import (
        SPEEDS,
        Boundary,
        critical_speed,
        find_boundaries,
        speed_boundaries,
        zero_damping_speed,
    )
    from yawdamp_ros.analysis.errors import AnalysisError
    from yawdamp_ros.analysis.lane_change import (
        SAE_J2179,
        SAE_J2179_SPEED,
        SingleLaneChange,
        run_lane_change,
        steer_axle,
    )
    from yawdamp_ros.analysis.locus import Locus, eigenvalue_locus
    from yawdamp_ros.analysis.measures import MEASURES, Level, Measure
    from yawdamp_ros.analysis.modes import Mode, growth, least_damping_ratio, modes, rightmost
    from yawdamp_ros.analysis.offtracking import (
        axle_path,
        high_speed_transient_offtracking,
        steady_offtracking,
    )
    from yawdamp_ros.analysis.rearward_amplification import (
        PeakAmplification,
        amplification_at,
        peak_amplification,
        rearward_amplification,
    )
    from yawdamp_ros.analysis.steady_turn import (
        SteadyTurn,
        Steering,
        static_gains,
        steady_steering,
        steady_turn,
    )
    from yawdamp_ros.analysis.transfer_function import TransferFunction, transfer_function
    from yawdamp_ros.analysis.variation import Variation, parse_variation
    from yawdamp_ros.analysis.yaw_damping import pulse_decay, yaw_damping_coefficient

__all__ = [
    "MEASURES",
    "SAE_J2179",
    "SAE_J2179_SPEED",
    "SPEEDS",
    "AnalysisError",
    "Boundary",
    "Finding",
    "Level",
    "Locus",
    "Measure",
    "Mode",
    "PeakAmplification",
    "SingleLaneChange",
    "SteadyTurn",
    "Steering",
    "TransferFunction",
    "Variation",
    "amplification_at",
    "assess",
    "axle_path",
    "critical_speed",
    "eigenvalue_locus",
    "failed",
    "find_boundaries",
    "growth",
    "high_speed_transient_offtracking",
    "least_damping_ratio",
    "modes",
    "parse_variation",
    "peak_amplification",
    "pulse_decay",
    "rearward_amplification",
    "rightmost",
    "run_lane_change",
    "speed_boundaries",
    "static_gains",
    "steady_offtracking",
    "steady_steering",
    "steady_turn",
    "steer_axle",
    "transfer_function",
    "yaw_damping_coefficient",
    "zero_damping_speed",
]

_MODULES = {
    "assessment": ("Finding", "assess", "failed"),
    "boundaries": (
        "SPEEDS",
        "Boundary",
        "critical_speed",
        "find_boundaries",
        "speed_boundaries",
        "zero_damping_speed",
    ),
    "errors": ("AnalysisError",),
    "lane_change": ("SAE_J2179", "SAE_J2179_SPEED", "SingleLaneChange", "run_lane_change", "steer_axle"),
    "locus": ("Locus", "eigenvalue_locus"),
    "measures": ("MEASURES", "Level", "Measure"),
    "modes": ("Mode", "growth", "least_damping_ratio", "modes", "rightmost"),
    "offtracking": ("axle_path", "high_speed_transient_offtracking", "steady_offtracking"),
    "rearward_amplification": (
        "PeakAmplification",
        "amplification_at",
        "peak_amplification",
        "rearward_amplification",
    ),
    "steady_turn": ("SteadyTurn", "Steering", "static_gains", "steady_steering", "steady_turn"),
    "transfer_function": ("TransferFunction", "transfer_function"),
    "variation": ("Variation", "parse_variation"),
    "yaw_damping": ("pulse_decay", "yaw_damping_coefficient"),
}


def __getattr__(name: str) -> object:
    for module, names in _MODULES.items():
        if name in names:
            return getattr(import_module(f"{__name__}.{module}"), name)
    message = f"module {__name__!r} has no attribute {name!r}"
    raise AttributeError(message)
