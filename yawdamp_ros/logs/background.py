"""Writing off the timer's thread: the simulation never waits for a disk."""

import threading
import time
from queue import Empty, Full, Queue

from yawdamp_ros.logs.errors import LogError
from yawdamp_ros.logs.run_writer import RunWriter

QUEUE_LENGTH = 100_000
"""Messages that may wait for the disk, about a minute of a three-unit run at 100 Hz."""
FLUSH_PERIOD = 0.5
"""Longest time in s that a message stays where a kill would lose it."""

_Message = tuple[int, int, bytes]


class BackgroundWriter:
    """A thread that feeds a `RunWriter` from a bounded queue.

    Whatever becomes of the disk, `offer` returns at once: what cannot be written is counted in `lost`,
    and the reason is kept in `failure`.

    Parameters
    ----------
    writer : RunWriter
    """

    def __init__(self, writer: RunWriter) -> None:
        self.directory = writer.directory
        self.failure: LogError | None = None
        self.lost = 0
        self._writer = writer
        self._queue: Queue[_Message | None] = Queue(QUEUE_LENGTH)
        self._thread = threading.Thread(target=self._work, name="recorder", daemon=True)
        self._thread.start()

    def offer(self, channel: int, log_time: int, data: bytes) -> None:
        """Queue a serialised message; see `RunWriter.write`."""
        if self.failure is not None:
            self.lost += 1
            return
        try:
            self._queue.put_nowait((channel, log_time, data))
        except Full:
            self.lost += 1

    def close(self) -> None:
        """Write what is queued, finish the file, and wait for that."""
        self._queue.put(None)
        self._thread.join()

    def _work(self) -> None:
        try:
            self._write_until_closed()
        except LogError as error:
            self.failure = error
            self.lost += 1
            while self._queue.get() is not None:
                self.lost += 1
            return
        try:
            self._writer.close()
        except LogError as error:
            self.failure = error

    def _write_until_closed(self) -> None:
        flush_at = time.monotonic() + FLUSH_PERIOD
        while True:
            try:
                message = self._queue.get(timeout=max(flush_at - time.monotonic(), 0.0))
            except Empty:
                pass
            else:
                if message is None:
                    return
                self._writer.write(*message)
            if time.monotonic() >= flush_at:
                self._writer.flush()
                flush_at = time.monotonic() + FLUSH_PERIOD
