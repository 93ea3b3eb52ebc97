"""Lateral dynamics of heavy vehicle combinations, with and without ROS.

The names below load on first use, so that a command that needs little starts fast.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from yawdamp_ros.dynamics import linear_model
    from yawdamp_ros.stepping import simulate
    from yawdamp_ros.vehicle import load_vehicle

__all__ = ["linear_model", "load_vehicle", "simulate"]

_ROOMS = {
    "linear_model": "yawdamp_ros.dynamics",
    "load_vehicle": "yawdamp_ros.vehicle",
    "simulate": "yawdamp_ros.stepping",
}


def __getattr__(name: str) -> object:
    if name in _ROOMS:
        return getattr(import_module(_ROOMS[name]), name)
    message = f"module {__name__!r} has no attribute {name!r}"
    raise AttributeError(message)
