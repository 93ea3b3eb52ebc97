"""Recording, started and stopped while the simulation goes on."""

from collections.abc import Callable, Sequence
from pathlib import Path

from yawdamp_ros.logs import LogError
from yawdamp_ros.nodes.states import RecorderState
from yawdamp_ros.runs import BackgroundWriter, RunWriter, SerialisedMessage
from yawdamp_ros.runs.encoder import Encoded
from yawdamp_ros.runs.recipe import event_messages, recorded_messages
from yawdamp_ros.stepping import Event


class Recorder:
    """Writes at most one run at a time and keeps the result of the last one.

    Parameters
    ----------
    open_writer : callable
        Function that starts a run in a given directory.
    """

    def __init__(self, open_writer: Callable[[Path], RunWriter]) -> None:
        self.directory: Path | None = None
        self._open_writer = open_writer
        self._writer: BackgroundWriter | None = None
        self._lost_before = 0
        self._last_failure: LogError | None = None

    @property
    def recording(self) -> bool:
        """True while a run is being written, also if writing fails."""
        return self._writer is not None

    @property
    def failure(self) -> LogError | None:
        """Reason that the present run, or else the last one, is incomplete."""
        return self._writer.failure if self._writer is not None else self._last_failure

    @property
    def lost(self) -> int:
        """Number of messages of all runs that were not written."""
        return self._lost_before + (self._writer.lost if self._writer is not None else 0)

    @property
    def state(self) -> RecorderState:
        """Key of its state."""
        if self.failure is not None:
            return RecorderState.FAILED
        return RecorderState.RECORDING if self.recording else RecorderState.IDLE

    @property
    def detail(self) -> str:
        """Directory of the recording, or the reason that there is none."""
        if self.failure is not None:
            return str(self.failure)
        return str(self.directory) if self.recording else "not recording"

    def start(self, directory: Path) -> None:
        """Start a run, and finish the one before it.

        Raises
        ------
        LogError
            If the directory cannot be written; then the run before it goes on.
        """
        writer = BackgroundWriter(self._open_writer(directory))
        self.stop()
        self._writer, self.directory = writer, directory

    def stop(self) -> None:
        """Finish the present run, if there is one, and wait until it is written."""
        if self._writer is not None:
            self._writer.close()
            self._lost_before += self._writer.lost
            self._last_failure = self._writer.failure
            self._writer = None

    def offer(self, messages: Sequence[SerialisedMessage]) -> None:
        """Hand over messages, if a run is being written."""
        if self._writer is not None:
            self._writer.offer(messages)

    def write(self, encoded: Encoded) -> None:
        """Take a sample; see `EncodedSink`."""
        if self.recording:
            self.offer(recorded_messages(encoded))

    def tell(self, events: Sequence[tuple[int, Event]]) -> None:
        """Take events that no sample bears; see `EncodedSink`."""
        if self.recording:
            self.offer(event_messages(events))

    def close(self) -> None:
        """See `stop`."""
        self.stop()
