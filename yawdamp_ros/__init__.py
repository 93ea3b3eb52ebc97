"""Lateral dynamics of heavy vehicle combinations, with and without ROS.

The names and rooms below load on first use, so that a command that needs little starts fast.
"""

from typing import TYPE_CHECKING

from yawdamp_ros.lazy import load_on_use
from yawdamp_ros.version import VERSION

if TYPE_CHECKING:
    from yawdamp_ros import (
        analysis,
        drives,
        dynamics,
        library,
        logs,
        manoeuvres,
        nonlinear,
        pictures,
        runs,
        simulation,
        stepping,
        vehicle,
    )
    from yawdamp_ros.dynamics import linear_model
    from yawdamp_ros.library import load_run, simulate
    from yawdamp_ros.logs.drive_formats import load_drive
    from yawdamp_ros.vehicle import load_vehicle

__version__ = VERSION

__all__ = [
    "__version__",
    "analysis",
    "drives",
    "dynamics",
    "library",
    "linear_model",
    "load_drive",
    "load_run",
    "load_vehicle",
    "logs",
    "manoeuvres",
    "nonlinear",
    "pictures",
    "runs",
    "simulate",
    "simulation",
    "stepping",
    "vehicle",
]

__getattr__ = load_on_use(
    __name__,
    {
        "yawdamp_ros.dynamics": ("linear_model",),
        "yawdamp_ros.library": ("load_run", "simulate"),
        "yawdamp_ros.logs.drive_formats": ("load_drive",),
        "yawdamp_ros.vehicle": ("load_vehicle",),
    },
    (
        "analysis",
        "drives",
        "dynamics",
        "library",
        "logs",
        "manoeuvres",
        "nonlinear",
        "pictures",
        "runs",
        "simulation",
        "stepping",
        "vehicle",
    ),
)


def __dir__() -> list[str]:
    return __all__
