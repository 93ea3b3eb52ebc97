"""The commands, as `python -m yawdamp_ros NAME` and as `ros2 run yawdamp_ros NAME`."""

import signal
import sys
from pathlib import Path

from yawdamp_ros.cli import run


def script() -> int:
    """Run the command that the executable is named after."""
    return _run(Path(sys.argv[0]).name, *sys.argv[1:])


def _run(*arguments: str) -> int:
    status = run(arguments)
    # The work is done: a second Ctrl-C, as a launch sends, must not hit the interpreter's own shutdown.
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    return status


if __name__ == "__main__":
    sys.exit(_run(*sys.argv[1:]))
