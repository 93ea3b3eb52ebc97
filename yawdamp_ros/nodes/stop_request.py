"""SIGINT and SIGTERM as a request that the program polls, instead of an exception anywhere."""

import os
import select
import signal
from types import FrameType, TracebackType
from typing import Self

_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


class StopRequest:
    """Turns SIGINT, SIGTERM and SIGHUP into a flag for as long as its context lasts.

    A recording is finished however often the signal comes: under a launch, a terminal's Ctrl-C arrives
    twice. This module imports nothing slow, so that the flag is up before rclpy is imported.
    """

    def __init__(self) -> None:
        self.requested = False

    def wait(self, seconds: float) -> bool:
        """Sleep for a time [s] or until the request arrives; return whether it has."""
        if not self.requested:
            select.select([self._wake], [], [], max(seconds, 0.0))
        return self.requested

    def __enter__(self) -> Self:
        # A signal writes to the pipe, which ends a select; a flag alone would not end a sleep.
        self._wake, self._alarm = os.pipe()
        os.set_blocking(self._alarm, False)
        self._former_wakeup = signal.set_wakeup_fd(self._alarm, warn_on_full_buffer=False)
        # nohup asks to ignore a hang-up.
        wanted = [number for number in _SIGNALS if signal.getsignal(number) is not signal.SIG_IGN]
        self._former_handlers = {number: signal.signal(number, self._request) for number in wanted}
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        for number, handler in self._former_handlers.items():
            signal.signal(number, handler)
        signal.set_wakeup_fd(self._former_wakeup)
        os.close(self._wake)
        os.close(self._alarm)

    def _request(self, _number: int, _frame: FrameType | None) -> None:
        self.requested = True
