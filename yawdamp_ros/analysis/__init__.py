"""Modes, measures and sweeps: arrays in, small result types out."""

from yawdamp_ros.analysis.boundaries import (
    SPEEDS,
    Boundary,
    critical_speed,
    find_boundaries,
    speed_boundaries,
)
from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.analysis.locus import Locus, eigenvalue_locus
from yawdamp_ros.analysis.modes import Mode, least_damping_ratio, modes, rightmost
from yawdamp_ros.analysis.steady_turn import (
    SteadyTurn,
    Steering,
    static_gains,
    steady_steering,
    steady_turn,
)
from yawdamp_ros.analysis.transfer_function import TransferFunction, transfer_function
from yawdamp_ros.analysis.variation import Variation, parse_variation

__all__ = [
    "SPEEDS",
    "AnalysisError",
    "Boundary",
    "Locus",
    "Mode",
    "SteadyTurn",
    "Steering",
    "TransferFunction",
    "Variation",
    "critical_speed",
    "eigenvalue_locus",
    "find_boundaries",
    "least_damping_ratio",
    "modes",
    "parse_variation",
    "rightmost",
    "speed_boundaries",
    "static_gains",
    "steady_steering",
    "steady_turn",
    "transfer_function",
]
