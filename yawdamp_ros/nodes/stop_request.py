"""SIGINT and SIGTERM as a request that the program asks for, instead of an exception anywhere."""

import os
import select
import signal
from types import FrameType


class StopRequest:
    """Turns SIGINT, SIGTERM and SIGHUP into a flag, from its making on.

    A recording is finished however often the signal comes: under a launch, a terminal's Ctrl-C arrives
    twice. This module imports nothing slow, so that the flag is up before rclpy is imported.
    """

    def __init__(self) -> None:
        self.requested = False
        self._wake, wake_up = os.pipe()
        for descriptor in (self._wake, wake_up):
            os.set_blocking(descriptor, False)
        signal.set_wakeup_fd(wake_up, warn_on_full_buffer=False)
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, self._request)

    def wait(self, seconds: float) -> bool:
        """Sleep for a time in s, or until the request comes; return whether it has."""
        if not self.requested:
            select.select([self._wake], [], [], max(seconds, 0.0))
        return self.requested

    def _request(self, _number: int, _frame: FrameType | None) -> None:
        self.requested = True
