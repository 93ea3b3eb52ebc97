"""A recorded drive: steering, speed and measurements of a vehicle."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from yawdamp_ros.drives.channel import Channel
from yawdamp_ros.drives.errors import DriveError
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.stepping.held_input import HIGHEST_SPEED, LOWEST_FOLLOWED

INPUTS = ("steering", "speed", "acceleration", "gear", "friction")
"""Channels that act on a vehicle, besides those of its units; every other one was measured on it."""


def is_input(name: str) -> bool:
    """Return whether a channel acts on a vehicle, rather than was measured on it.

    Parameters
    ----------
    name : str
        Name of the channel.

    Returns
    -------
    bool

    Examples
    --------
    >>> [is_input(name) for name in ("speed", "trailer_1/brake", "trailer_1/yaw")]
    [True, True, False]
    """
    return name in INPUTS or name.rpartition("/")[2] in {"steering", "brake", "yaw_moment"}


@dataclass(frozen=True)
class Drive:
    """Channels of one recorded drive.

    Attributes
    ----------
    source : str
        File it came from.
    channels : mapping of str to Channel
        Channels by name.
    start_time : int
        Time in ns at which the channels' time is 0, where the log knows; else 0.
    notes : tuple of str
        Data of the log that was left out, with the reason.
    warning : str
        Fault of the file that did not prevent reading; else empty.

    Examples
    --------
    >>> from yawdamp_ros import load_drive
    >>> drive = load_drive("docs/recorded_drive.csv").steered_by(18.0)
    >>> round(drive.duration, 1), sorted(drive.channels)[:2]
    (94.5, ['lateral_acceleration', 'speed'])
    """

    source: str
    channels: Mapping[str, Channel]
    start_time: int = 0
    notes: tuple[str, ...] = ()
    warning: str = ""

    def __getitem__(self, name: str) -> Channel:
        """Channel of a name.

        Raises
        ------
        DriveError
            If the drive has no such channel.
        """
        if name not in self.channels:
            held = ", ".join(self.channels) or "nothing"
            message = f"{self.source}: no {name}; the drive has {held}"
            raise DriveError(message)
        return self.channels[name]

    def __contains__(self, name: object) -> bool:
        return name in self.channels

    @property
    def measured(self) -> tuple[Channel, ...]:
        """Channels that are no input."""
        return tuple(channel for name, channel in self.channels.items() if not is_input(name))

    @property
    def duration(self) -> float:
        """Time of the last steering sample [s], or of the last of any channel where none steers."""
        if "steering" in self:
            return float(self["steering"].times[-1])
        return max((float(channel.times[-1]) for channel in self.channels.values()), default=0.0)

    def speed(self, start: float) -> Channel | None:
        """Speed, or the integral of the acceleration from a first speed [m/s]; None without both."""
        if "speed" in self or "acceleration" not in self:
            return self.channels.get("speed")
        given = self["acceleration"]
        speeds = speeds_by_acceleration(given.times, given.values, start)
        return Channel("speed", f"integral of {given.source}", given.times, speeds)

    def without(self, *names: str) -> "Drive":
        """Leave out some channels."""
        return replace(
            self, channels={name: each for name, each in self.channels.items() if name not in names}
        )

    def steered_by(self, ratio: float) -> "Drive":
        """Divide the steering by a ratio, such as that of hand wheel to road wheel.

        Raises
        ------
        DriveError
            If the drive has no steering.
        """
        steering = self["steering"]
        divided = replace(steering, values=steering.values / ratio)
        return replace(self, channels={**self.channels, "steering": divided})

    def window(self, start: float, duration: float | None = None) -> "Drive":
        """Part from a start on, for a duration, both [s]; its time starts anew.

        Raises
        ------
        DriveError
            If no sample of the steering is left.
        """
        end = float("inf") if duration is None else start + duration
        cut = {
            name: channel.window(start, end, held=is_input(name) and name != "steering")
            for name, channel in self.channels.items()
        }
        kept = {name: channel for name, channel in cut.items() if len(channel.times)}
        if not kept or ("steering" in self and "steering" not in kept):
            message = (
                f"{self.source}: no sample between {start:g} s and {end:g} s; "
                f"the drive lasts {self.duration:g} s"
            )
            raise DriveError(message)
        return replace(
            self, channels=kept, start_time=self.start_time and self.start_time + round(start * 1e9)
        )

    def described(self) -> list[str]:
        """One line for each channel with its source."""
        return [
            f"{channel.name}: {channel.source}, {len(channel.times)} samples, {channel.rate:.3g} Hz, "
            f"{channel.values.min():.4g} to {channel.values.max():.4g} {channel.unit}"
            for channel in self.channels.values()
        ]


def speeds_by_acceleration(
    times: Sequence[float] | FloatArray, values: Sequence[float] | FloatArray, start: float
) -> FloatArray:
    """Speeds in m/s at the instants of an acceleration, each value of which holds until the next.

    Parameters
    ----------
    times, values : array_like, shape (k,)
        In s and m/s^2.
    start : float
        Speed at the first instant [m/s].

    Returns
    -------
    ndarray, shape (k,)
        Speeds [m/s], clamped to the range of a model.

    Examples
    --------
    >>> speeds_by_acceleration([0.0, 2.0, 4.0], [0.5, -1.0, 0.0], 10.0)
    array([10., 11.,  9.])
    """
    gained = np.cumsum(np.diff(times) * np.asarray(values, float)[:-1])
    return np.clip(start + np.concatenate([[0.0], gained]), LOWEST_FOLLOWED, HIGHEST_SPEED)
