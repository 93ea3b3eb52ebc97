"""From a vehicle to its linear state space."""

from yawdamp_ros.dynamics.consistent import EquationsOfMotion, equations_of_motion
from yawdamp_ros.dynamics.errors import DynamicsError
from yawdamp_ros.dynamics.linear_model import (
    LOWEST_SPEED,
    MODELS,
    LinearModel,
    Outputs,
    linear_model,
    split_outputs,
)

__all__ = [
    "LOWEST_SPEED",
    "MODELS",
    "DynamicsError",
    "EquationsOfMotion",
    "LinearModel",
    "Outputs",
    "equations_of_motion",
    "linear_model",
    "split_outputs",
]
