"""Notebook interface: runs and drives as arrays, tables and pictures."""

from typing import TYPE_CHECKING

from yawdamp_ros.lazy import load_on_use

if TYPE_CHECKING:
    from yawdamp_ros.library.curves import Curves, UnitCurves
    from yawdamp_ros.library.load import load_run
    from yawdamp_ros.library.offline import simulate

__all__ = ["Curves", "UnitCurves", "load_run", "simulate"]

__getattr__ = load_on_use(
    __name__,
    {
        "yawdamp_ros.library.curves": ("Curves", "UnitCurves"),
        "yawdamp_ros.library.load": ("load_run",),
        "yawdamp_ros.library.offline": ("simulate",),
    },
)
