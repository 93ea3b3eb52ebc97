"""The commands, as `yawdamp NAME`, `python -m yawdamp_ros NAME` and `ros2 run yawdamp_ros NAME`."""

import signal
import sys

from yawdamp_ros.cli import run


def main() -> int:
    """Run the command that the command line names."""
    status = run(sys.argv[1:])
    # The work is done: a second Ctrl-C, as a launch sends, must not hit the interpreter's own shutdown.
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    return status


if __name__ == "__main__":
    sys.exit(main())
