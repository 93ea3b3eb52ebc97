"""From a vehicle to its linear state space."""

from yawdamp_ros.dynamics.consistent import EquationsOfMotion, equations_of_motion
from yawdamp_ros.dynamics.errors import DynamicsError
from yawdamp_ros.dynamics.linear_model import LOWEST_SPEED, MODELS, LinearModel, linear_model

__all__ = [
    "LOWEST_SPEED",
    "MODELS",
    "DynamicsError",
    "EquationsOfMotion",
    "LinearModel",
    "equations_of_motion",
    "linear_model",
]
