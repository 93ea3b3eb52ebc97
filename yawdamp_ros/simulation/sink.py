"""Where the samples of a run go."""

from typing import Protocol

from yawdamp_ros.stepping import Sample


class Sink(Protocol):
    """Takes every sample of a run: topics, a file, peaks, a progress bar."""

    def write(self, sample: Sample) -> None:
        """Take a sample of one or more instants."""

    def close(self) -> None:
        """Finish; nothing is written any more."""
