"""A run: commands in, samples out."""

from collections import deque
from collections.abc import Sequence
from typing import Protocol

import numpy as np

from yawdamp_ros.simulation.limits import Limits, Stop, limit_violation
from yawdamp_ros.simulation.sink import Sink
from yawdamp_ros.stepping import AppliedInput, Command, Event, Motion, Sample, TimeGrid


class Source(Protocol):
    """Source of the inputs of a run: `Commands`, or the recording of another run.

    Examples
    --------
    >>> from yawdamp_ros.simulation import Commands, Run, SimParameters, make_motion
    >>> from yawdamp_ros.stepping import TimeGrid
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> motion = make_motion(load_vehicle("truck_trailer"), "consistent", speed=20.0, step_size=0.001)
    >>> grid = TimeGrid.of(0.001, 0.01)
    >>> settings = SimParameters(manoeuvre="step", amplitude=0.02)
    >>> source = Commands(settings, grid, motion)
    >>> run = Run(motion, grid, source, sinks=[])
    >>> run.start()
    >>> run.advance(1)
    >>> run.samples
    2
    """

    def inputs(self, steps: range) -> Sequence[AppliedInput]:
        """Inputs other than steering that act from one of these steps on, in order, each given once."""

    def steering(self, steps: range) -> Sequence[float]:
        """Road-wheel steer angle from each of these steps on, each requested once [rad]."""

    def received(self) -> tuple[Command, ...]:
        """Commands taken since the last call."""


class Run:
    """Steps a motion by its source and hands every sample to its sinks until a limit is exceeded.

    The node, `simulate` and `resimulate` all use it.

    Parameters
    ----------
    motion : Motion
    grid : TimeGrid
    source : Source
    sinks : sequence of Sink
        Receivers of every sample, in this order.
    limits : Limits, optional
        Limits that stop the run; they may be replaced while it runs.

    Attributes
    ----------
    samples : int
        Number of samples handed on so far.
    stopped : Stop or None
        Reason of the stop; no further sample is handed on.
    events : list of Event
        Events so far, in order of time.
    unwritten : tuple of Event
        Events that ended the run before its next sample; no sink received them.

    Examples
    --------
    >>> from yawdamp_ros.simulation import Commands, Run, SimParameters, make_motion
    >>> from yawdamp_ros.stepping import TimeGrid
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> motion = make_motion(load_vehicle("truck_trailer"), "consistent", speed=20.0, step_size=0.001)
    >>> grid = TimeGrid.of(0.001, 0.01)
    >>> settings = SimParameters(manoeuvre="step", amplitude=0.02)
    >>> source = Commands(settings, grid, motion)
    >>> run = Run(motion, grid, source, sinks=[])
    >>> run.start()
    >>> run.advance(200)
    >>> run.samples, run.stopped
    (201, None)
    """

    def __init__(
        self,
        motion: Motion,
        grid: TimeGrid,
        source: Source,
        sinks: Sequence[Sink],
        limits: Limits | None = None,
    ) -> None:
        self.motion = motion
        self.grid = grid
        self.limits = limits
        self.samples = 0
        self.stopped: Stop | None = None
        self.events: list[Event] = []
        self.unwritten: tuple[Event, ...] = ()
        self._source = source
        self._unit_names = motion.vehicle.unit_names
        self._sinks = tuple(sinks)

    @property
    def time(self) -> float:
        """Present simulated time, or the time at which the run was stopped [s]."""
        return self.grid.seconds(self.motion.step if self.stopped is None else self.stopped.step)

    def start(self) -> None:
        """Hand on the sample of this instant, with its inputs."""
        here = range(self.motion.step, self.motion.step + 1)
        for applied in self._source.inputs(here):
            self.motion.apply(applied)
        self._steer(self._source.steering(here)[0])
        self._hand_on(self.motion.sample())

    def advance(self, samples: int = 1) -> None:
        """Take sample periods, and hand on their samples."""
        period, first = self.grid.steps_per_sample, self.motion.step + 1
        steps = range(first, first + samples * period)
        others = deque(self._source.inputs(steps))
        angles = self._source.steering(steps)
        if not others:
            self._hand_on(self.motion.run(angles, period if samples > 1 else None))
            return
        for begin in range(0, len(steps), period):
            self._hand_on(self._period(angles[begin : begin + period], others))

    def close(self) -> None:
        """Let every sink finish."""
        for sink in self._sinks:
            sink.close()

    def _period(self, angles: Sequence[float], others: deque[AppliedInput]) -> Sample:
        """Take a period with inputs other than steering in it."""
        motion, first = self.motion, self.motion.step + 1
        while others and others[0].step < first + len(angles):
            applied = others.popleft()
            while motion.step < applied.step:
                motion.advance()
                self._steer(angles[motion.step - first])
            motion.apply(applied)
        left = angles[motion.step + 1 - first :]
        return motion.run(left) if len(left) else motion.sample()

    def _steer(self, angle: float) -> None:
        self.motion.apply(AppliedInput(self.motion.step, "steering", angle))

    def _hand_on(self, sample: Sample) -> None:
        if self.stopped is not None:
            return
        if received := self._source.received():
            sample = sample._replace(commands=received)
        self.events += sample.events
        final = next((event for event in sample.events if event.final), None)
        if final is not None:
            reason = f"{final.name.replace('_', ' ')} of {final.where}"
            self.stopped = Stop(final.step, final.name, final.where, reason)
        found = None
        if self.limits is not None:
            found = limit_violation(sample, self._unit_names, self.limits)
        if found is not None:
            instant, violation = found
            # Values after a final event are NaN; the event is the reason.
            self.stopped = self.stopped or violation
            if not instant:
                self.unwritten = sample.events
                return
            sample = sample.before(instant)._replace(events=sample.events)
        self.samples += np.size(sample.step)
        for sink in self._sinks:
            sink.write(sample)
