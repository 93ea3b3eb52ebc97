"""Writing off the timer's thread: the simulation never waits for a disk."""

import threading
import time
from collections.abc import Iterator, Sequence
from queue import Full, Queue

from yawdamp_ros.logs.errors import LogError
from yawdamp_ros.runs.run_writer import RunWriter, SerialisedMessage

QUEUE_LENGTH = 6_000
"""Largest number of samples that wait for the disk, a minute at 100 Hz."""
WRITE_PERIOD = 0.1
"""Time between two looks at the queue [s]: a thread that wakes for every sample interrupts the timer's."""
FLUSH_PERIOD = 0.5
"""Longest time that a written message stays in memory, where a kill would lose it [s]."""


class BackgroundWriter:
    """A thread that feeds a `RunWriter` from a bounded queue.

    `offer` returns at once, whatever the state of the disk: messages that cannot be written are counted in
    `lost`, and the reason is kept in `failure`.

    Parameters
    ----------
    writer : RunWriter

    Examples
    --------
    >>> from pathlib import Path
    >>> from struct import pack
    >>> from yawdamp_ros.runs import Channel, RunWriter, make_run_directory
    >>> directory = make_run_directory(Path("run"), numbered=False)
    >>> writer = RunWriter(directory, {"steering": Channel("/steering", "std_msgs/msg/Float64")}, {}, {})
    >>> from yawdamp_ros.runs import BackgroundWriter
    >>> background = BackgroundWriter(writer)
    >>> background.offer([("steering", 0, bytes([0, 1, 0, 0]) + pack("<d", 0.02))])
    >>> background.close()
    >>> background.lost, background.failure
    (0, None)
    """

    def __init__(self, writer: RunWriter) -> None:
        self.directory = writer.directory
        self.failure: LogError | None = None
        # Each thread counts for itself, for an addition by two threads can get lost.
        self._lost_before_queue = 0
        self._lost_behind_queue = 0
        self._writer = writer
        self._queue: Queue[Sequence[SerialisedMessage]] = Queue(QUEUE_LENGTH)
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._work, name="recorder", daemon=True)
        self._thread.start()

    @property
    def lost(self) -> int:
        """Known number of messages that are not in the file."""
        return self._lost_before_queue + self._lost_behind_queue

    def offer(self, messages: Sequence[SerialisedMessage]) -> None:
        """Queue the messages of a sample; see `RunWriter.write`."""
        if self.failure is not None:
            self._lost_before_queue += len(messages)
            return
        try:
            self._queue.put_nowait(messages)
        except Full:
            self._lost_before_queue += len(messages)

    def close(self) -> None:
        """Write the queue, finish the file, and wait until this is done."""
        self._closing.set()
        self._thread.join()

    def _work(self) -> None:
        try:
            self._write_until_closed()
            self._writer.close()
        except LogError as error:
            self._lost_behind_queue += self._writer.unflushed
            self.failure = error
            self._lose_waiting()
            self._closing.wait()
            self._lose_waiting()

    def _write_until_closed(self) -> None:
        flush_at = time.monotonic() + FLUSH_PERIOD
        closing = False
        while not closing:
            # Asked for first: what was offered before the end is in the queue by then.
            closing = self._closing.wait(WRITE_PERIOD)
            for messages in self._waiting():
                self._writer.write(messages)
                time.sleep(0)  # lets the timer's thread go first
            if time.monotonic() >= flush_at:
                self._writer.flush()
                flush_at = time.monotonic() + FLUSH_PERIOD

    def _lose_waiting(self) -> None:
        self._lost_behind_queue += sum(map(len, self._waiting()))

    def _waiting(self) -> Iterator[Sequence[SerialisedMessage]]:
        """Take what is in the queue now."""
        for _ in range(self._queue.qsize()):
            yield self._queue.get_nowait()
