"""Modes, measures and sweeps: arrays in, small result types out.

The names below load on first use: some need much of SciPy, which a node that starts does not.
"""

from typing import TYPE_CHECKING

from yawdamp_ros.lazy import load_on_use

if TYPE_CHECKING:
    from yawdamp_ros.analysis.amplification import (
        PeakAmplification,
        amplification_at,
        peak_amplification,
        rearward_amplification,
    )
    from yawdamp_ros.analysis.assessment import Assessment, Finding, Outcome, Verdict, assess, failed, outcome
    from yawdamp_ros.analysis.boundaries import (
        Boundary,
        critical_speed,
        find_boundaries,
        speed_boundaries,
        zero_damping_speed,
    )
    from yawdamp_ros.analysis.eigenmodes import Mode, growth, least_damping_ratio, modes, rightmost
    from yawdamp_ros.analysis.errors import AnalysisError
    from yawdamp_ros.analysis.lane_change import (
        SAE_J2179,
        SAE_J2179_SPEED,
        SingleLaneChange,
        run_lane_change,
        steer_axle_position,
    )
    from yawdamp_ros.analysis.locus import Locus, eigenvalue_locus
    from yawdamp_ros.analysis.measures import MEASURES, VEHICLE_MEASURES, Measure, VehicleMeasure
    from yawdamp_ros.analysis.offtracking import (
        axle_path,
        high_speed_transient_offtracking,
        steady_offtracking,
    )
    from yawdamp_ros.analysis.schemes import Requirement, Scheme, builtin_schemes, load_scheme
    from yawdamp_ros.analysis.speed_brackets import SPEEDS
    from yawdamp_ros.analysis.steady_state import (
        SteadyTurn,
        Steering,
        static_gains,
        steady_steering,
        steady_turn,
    )
    from yawdamp_ros.analysis.tractrix import Turn, low_speed_turn
    from yawdamp_ros.analysis.transfer import TransferFunction, transfer_function
    from yawdamp_ros.analysis.variation import Variation, parse_variation
    from yawdamp_ros.analysis.yaw_damping import damping_of_peaks, pulse_decay, yaw_damping_coefficient

__all__ = [
    "MEASURES",
    "SAE_J2179",
    "SAE_J2179_SPEED",
    "SPEEDS",
    "VEHICLE_MEASURES",
    "AnalysisError",
    "Assessment",
    "Boundary",
    "Finding",
    "Locus",
    "Measure",
    "Mode",
    "Outcome",
    "PeakAmplification",
    "Requirement",
    "Scheme",
    "SingleLaneChange",
    "SteadyTurn",
    "Steering",
    "TransferFunction",
    "Turn",
    "Variation",
    "VehicleMeasure",
    "Verdict",
    "amplification_at",
    "assess",
    "axle_path",
    "builtin_schemes",
    "critical_speed",
    "damping_of_peaks",
    "eigenvalue_locus",
    "failed",
    "find_boundaries",
    "growth",
    "high_speed_transient_offtracking",
    "least_damping_ratio",
    "load_scheme",
    "low_speed_turn",
    "modes",
    "outcome",
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
    "steer_axle_position",
    "transfer_function",
    "yaw_damping_coefficient",
    "zero_damping_speed",
]

__getattr__ = load_on_use(
    __name__,
    {
        "yawdamp_ros.analysis.assessment": (
            "Assessment",
            "Finding",
            "Outcome",
            "Verdict",
            "assess",
            "failed",
            "outcome",
        ),
        "yawdamp_ros.analysis.boundaries": (
            "Boundary",
            "critical_speed",
            "find_boundaries",
            "speed_boundaries",
            "zero_damping_speed",
        ),
        "yawdamp_ros.analysis.errors": ("AnalysisError",),
        "yawdamp_ros.analysis.lane_change": (
            "SAE_J2179",
            "SAE_J2179_SPEED",
            "SingleLaneChange",
            "run_lane_change",
            "steer_axle_position",
        ),
        "yawdamp_ros.analysis.locus": ("Locus", "eigenvalue_locus"),
        "yawdamp_ros.analysis.tractrix": ("Turn", "low_speed_turn"),
        "yawdamp_ros.analysis.measures": ("MEASURES", "VEHICLE_MEASURES", "Measure", "VehicleMeasure"),
        "yawdamp_ros.analysis.eigenmodes": ("Mode", "growth", "least_damping_ratio", "modes", "rightmost"),
        "yawdamp_ros.analysis.offtracking": (
            "axle_path",
            "high_speed_transient_offtracking",
            "steady_offtracking",
        ),
        "yawdamp_ros.analysis.amplification": (
            "PeakAmplification",
            "amplification_at",
            "peak_amplification",
            "rearward_amplification",
        ),
        "yawdamp_ros.analysis.schemes": ("Requirement", "Scheme", "builtin_schemes", "load_scheme"),
        "yawdamp_ros.analysis.speed_brackets": ("SPEEDS",),
        "yawdamp_ros.analysis.steady_state": (
            "SteadyTurn",
            "Steering",
            "static_gains",
            "steady_steering",
            "steady_turn",
        ),
        "yawdamp_ros.analysis.transfer": ("TransferFunction", "transfer_function"),
        "yawdamp_ros.analysis.variation": ("Variation", "parse_variation"),
        "yawdamp_ros.analysis.yaw_damping": ("damping_of_peaks", "pulse_decay", "yaw_damping_coefficient"),
    },
)


def __dir__() -> list[str]:
    return __all__
