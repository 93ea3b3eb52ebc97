"""The name that the user typed."""

import os
import sys
from pathlib import Path

VARIABLE = "YAWDAMP_TYPED"
"""Environment variable by which the executables of `ros2 run` name themselves."""


def program() -> str:
    """Return the words typed before the name of a command.

    Returns
    -------
    str
        ``yawdamp``, ``python -m yawdamp_ros`` or ``ros2 run yawdamp_ros``.
    """
    script = Path(sys.argv[0])
    if (script.parent.name, script.name) == ("yawdamp_ros", "__main__.py"):
        return "python -m yawdamp_ros"
    return os.environ.get(VARIABLE, "yawdamp")
