"""One signal of a recorded drive, with its own time base."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from yawdamp_ros.dynamics.kinematics import FloatArray

QUANTITIES: Mapping[str, str] = MappingProxyType(
    {
        "steering": "rad",
        "speed": "m/s",
        "acceleration": "m/s^2",
        "yaw": "rad",
        "yaw_rate": "rad/s",
        "lateral_acceleration": "m/s^2",
        "articulation": "rad",
        "x": "m",
        "y": "m",
        "gear": "1",
        "friction": "1",
        "brake": "m/s^2",
        "yaw_moment": "N m",
    }
)
"""Quantities that a drive can hold, each with the unit in which it is kept."""

UNITS: Mapping[str, tuple[str, float]] = MappingProxyType(
    {
        "rad": ("rad", 1.0),
        "deg": ("rad", math.pi / 180.0),
        "rad/s": ("rad/s", 1.0),
        "deg/s": ("rad/s", math.pi / 180.0),
        "m/s": ("m/s", 1.0),
        "km/h": ("m/s", 1.0 / 3.6),
        "mph": ("m/s", 0.44704),
        "m/s^2": ("m/s^2", 1.0),
        "g": ("m/s^2", 9.80665),
        "m": ("m", 1.0),
        "1": ("1", 1.0),
        "N m": ("N m", 1.0),
    }
)
"""Units that a log may use, each with the SI unit and the factor to it."""


def quantity_of(name: str) -> str:
    """Return the quantity in a channel's name.

    Parameters
    ----------
    name : str
        Name, as in ``truck/yaw_rate``.

    Returns
    -------
    str
        Quantity, as in ``yaw_rate``.

    Examples
    --------
    >>> from yawdamp_ros.drives import quantity_of
    >>> quantity_of("truck/yaw_rate"), quantity_of("articulation_1")
    ('yaw_rate', 'articulation')
    """
    last = name.rpartition("/")[2]
    return "articulation" if last.startswith("articulation_") else last


@dataclass(frozen=True)
class Channel:
    """Samples of one quantity in SI units; signs are those of REP-103, left positive.

    Attributes
    ----------
    name : str
        A quantity of `QUANTITIES`, after ``<unit>/`` where the log tells the unit of the vehicle;
        articulation angles are ``articulation_1`` onwards.
    source : str
        Place in the log, and the conversion that was applied.
    times : ndarray, shape (m,)
        Times from the start of the drive [s], not decreasing.
    values : ndarray, shape (m,)
        Values, all finite.

    Examples
    --------
    >>> import numpy as np
    >>> from yawdamp_ros.drives import Channel
    >>> Channel("truck/yaw_rate", "made", np.array([0.0, 1.0]), np.array([0.1, 0.2])).unit
    'rad/s'
    """

    name: str
    source: str
    times: FloatArray
    values: FloatArray

    @property
    def unit(self) -> str:
        """Unit of the values."""
        return QUANTITIES[quantity_of(self.name)]

    @property
    def rate(self) -> float:
        """Samples per second, by the median interval; 0 of a single sample."""
        step = float(np.median(np.diff(self.times))) if len(self.times) > 1 else 0.0
        return 1.0 / step if step > 0.0 else 0.0

    def held(self, times: FloatArray) -> FloatArray:
        """Newest value at each time [s]; the first value before the first sample."""
        places = np.searchsorted(self.times, times, side="right") - 1
        held: FloatArray = self.values[np.maximum(places, 0)]
        return held

    def interpolated(self, times: FloatArray) -> FloatArray:
        """Value at each time [s], linear between samples."""
        return np.interp(times, self.times, self.values)

    def window(self, start: float, end: float, *, held: bool = False) -> "Channel":
        """Samples from a start to an end [s]; time starts anew at the start.

        Parameters
        ----------
        start, end : float
        held : bool
            Whether the sample in force at the start is kept, too, as of the start.
        """
        kept = (self.times >= start) & (self.times <= end)
        times, values = self.times[kept] - start, self.values[kept]
        before = int(np.searchsorted(self.times, start)) - 1
        if held and before >= 0 and not (len(times) and times[0] == 0.0):
            times, values = np.append(0.0, times), np.append(self.values[before], values)
        return replace(self, times=times, values=values)
