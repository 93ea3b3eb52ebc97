"""Sinks for the samples of a run."""

from typing import Protocol

from yawdamp_ros.stepping import Sample


class Sink(Protocol):
    """A consumer of every sample of a run: topics, a file, peaks, a progress bar.

    Examples
    --------
    >>> from yawdamp_ros.simulation import Commands, Run, SimParameters, make_motion
    >>> from yawdamp_ros.stepping import TimeGrid
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> class Largest:
    ...     value = 0.0
    ...     def write(self, sample):
    ...         self.value = max(self.value, float(abs(sample.yaw_rate).max()))
    ...     def close(self):
    ...         pass
    >>> motion = make_motion(load_vehicle("truck_trailer"), "consistent", speed=20.0, step_size=0.001)
    >>> grid, largest = TimeGrid.of(0.001, 0.01), Largest()
    >>> source = Commands(SimParameters(manoeuvre="step", amplitude=0.02), grid, motion)
    >>> run = Run(motion, grid, source, [largest])
    >>> run.start()
    >>> run.advance(300)
    >>> round(largest.value, 3)
    0.077
    """

    def write(self, sample: Sample) -> None:
        """Take a sample of one or more instants."""

    def close(self) -> None:
        """Finish; nothing is written any more."""
