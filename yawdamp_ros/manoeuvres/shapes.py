"""The standard steering inputs: each is called with a time in s and gives an angle in rad.

Defaults are those of Frerichs (2012): 0.1 rad, a sine of 1.5 rad/s (printed as 1.5 Hz), a step after
1 s, a chirp from 0.15 Hz to 4 Hz.
"""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Sine:
    """``amplitude sin(2 pi frequency (t - start))`` for a number of cycles; 0 cycles never end.

    Attributes
    ----------
    amplitude : float
        Road-wheel steer angle, left positive [rad].
    frequency : float
        Frequency [Hz].
    start : float
        Time at which the steering begins [s].
    cycles : float
        Number of cycles; 0 never ends.

    Examples
    --------
    >>> from yawdamp_ros.manoeuvres import Sine
    >>> round(Sine(amplitude=0.02, frequency=0.5)(0.5), 3)
    0.02
    """

    amplitude: float = 0.1
    frequency: float = 1.5 / math.tau
    start: float = 0.0
    cycles: float = 0.0

    def __call__(self, time: float) -> float:
        """Steer angle [rad] at a time [s]."""
        turns = (time - self.start) * self.frequency
        if turns < 0.0 or 0.0 < self.cycles < turns:
            return 0.0
        return self.amplitude * math.sin(math.tau * turns)


@dataclass(frozen=True)
class LaneChange(Sine):
    """One cycle of a sine: out of the lane to the left and straight again in the next.

    Attributes
    ----------
    amplitude : float
        Road-wheel steer angle, left positive [rad].
    frequency : float
        Frequency [Hz].
    start : float
        Time at which the steering begins [s].
    cycles : float
        Number of cycles; 0 never ends.

    Examples
    --------
    >>> from yawdamp_ros.manoeuvres import LaneChange
    >>> steering = LaneChange(amplitude=0.02)
    >>> steering(0.5), round(steering(2.0), 5)
    (0.0, 0.01995)
    """

    start: float = 1.0
    cycles: float = 1.0


@dataclass(frozen=True)
class Step:
    """``amplitude`` from `start` on.

    Attributes
    ----------
    amplitude : float
        Road-wheel steer angle, left positive [rad].
    start : float
        Time at which the steering begins [s].

    Examples
    --------
    >>> from yawdamp_ros.manoeuvres import Step
    >>> [Step(amplitude=0.02)(time) for time in (0.5, 1.0)]
    [0.0, 0.02]
    """

    amplitude: float = 0.1
    start: float = 1.0

    def __call__(self, time: float) -> float:
        """Steer angle [rad] at a time [s]."""
        return self.amplitude if time >= self.start else 0.0


@dataclass(frozen=True)
class Ramp:
    """From 0 at `start` to `amplitude` over `rise_time`, then held (a ramp step).

    Attributes
    ----------
    amplitude : float
        Road-wheel steer angle, left positive [rad].
    start : float
        Time at which the steering begins [s].
    rise_time : float
        Duration of the rise [s].

    Examples
    --------
    >>> from yawdamp_ros.manoeuvres import Ramp
    >>> [Ramp(amplitude=0.02)(time) for time in (0.5, 1.5, 3.0)]
    [0.0, 0.01, 0.02]
    """

    amplitude: float = 0.1
    start: float = 1.0
    rise_time: float = 1.0

    def __call__(self, time: float) -> float:
        """Steer angle [rad] at a time [s]."""
        return self.amplitude * min(max((time - self.start) / self.rise_time, 0.0), 1.0)


@dataclass(frozen=True)
class Pulse:
    """``amplitude`` from `start` on for `width`, then straight again.

    Attributes
    ----------
    amplitude : float
        Road-wheel steer angle, left positive [rad].
    start : float
        Time at which the steering begins [s].
    width : float
        Duration [s].

    Examples
    --------
    >>> from yawdamp_ros.manoeuvres import Pulse
    >>> [Pulse(amplitude=0.02)(time) for time in (0.5, 1.2, 2.0)]
    [0.0, 0.02, 0.0]
    """

    amplitude: float = 0.1
    start: float = 1.0
    width: float = 0.5

    def __call__(self, time: float) -> float:
        """Steer angle [rad] at a time [s]."""
        return self.amplitude if self.start <= time < self.start + self.width else 0.0


@dataclass(frozen=True)
class Chirp:
    """A sine whose frequency rises linearly to `final_frequency` over `sweep_time`, then straight.

    Attributes
    ----------
    amplitude : float
        Road-wheel steer angle, left positive [rad].
    frequency : float
        Frequency at the start [Hz].
    start : float
        Time at which the steering begins [s].
    final_frequency : float
        Frequency at the end [Hz].
    sweep_time : float
        Duration [s].

    Examples
    --------
    >>> from yawdamp_ros.manoeuvres import Chirp
    >>> round(Chirp(amplitude=0.01)(2.0), 5)
    -0.00922
    """

    amplitude: float = 0.1
    frequency: float = 0.15
    start: float = 0.0
    final_frequency: float = 4.0
    sweep_time: float = 15.0

    def __call__(self, time: float) -> float:
        """Steer angle [rad] at a time [s]."""
        elapsed = time - self.start
        if not 0.0 <= elapsed <= self.sweep_time:
            return 0.0
        slope = (self.final_frequency - self.frequency) / self.sweep_time
        return self.amplitude * math.sin(math.tau * elapsed * (self.frequency + 0.5 * slope * elapsed))
