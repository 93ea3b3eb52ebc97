"""Lateral dynamics of heavy vehicle combinations, with and without ROS.

The names below load on first use, so that a command that needs little starts fast.
"""

from typing import TYPE_CHECKING

from yawdamp_ros.lazy import load_on_use

if TYPE_CHECKING:
    from yawdamp_ros.dynamics import linear_model
    from yawdamp_ros.simulation import simulate
    from yawdamp_ros.vehicle import load_vehicle

__all__ = ["linear_model", "load_vehicle", "simulate"]

__getattr__ = load_on_use(
    __name__,
    {
        "yawdamp_ros.dynamics": ("linear_model",),
        "yawdamp_ros.simulation": ("simulate",),
        "yawdamp_ros.vehicle": ("load_vehicle",),
    },
)
