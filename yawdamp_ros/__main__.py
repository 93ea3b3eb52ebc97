"""The commands, as `python -m yawdamp_ros NAME` and as `ros2 run yawdamp_ros NAME`."""

import sys
from pathlib import Path

from yawdamp_ros.cli import run


def script() -> int:
    """Run the command that the executable is named after."""
    return run([Path(sys.argv[0]).name, *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(run(sys.argv[1:]))
