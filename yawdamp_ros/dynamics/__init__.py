"""From a vehicle to its linear state space."""

from yawdamp_ros.dynamics.consistent import EquationsOfMotion, equations_of_motion
from yawdamp_ros.dynamics.errors import DynamicsError
from yawdamp_ros.dynamics.linear_model import MODELS, LinearModel, linear_model

__all__ = [
    "MODELS",
    "DynamicsError",
    "EquationsOfMotion",
    "LinearModel",
    "equations_of_motion",
    "linear_model",
]
