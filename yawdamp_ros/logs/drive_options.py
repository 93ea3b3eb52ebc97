"""Options for reading a recorded drive."""

import math
from typing import NamedTuple

from yawdamp_ros.logs.channel_names import Wish


class DriveOptions(NamedTuple):
    """Options of the reader of a drive; by default it finds everything by names and types.

    Attributes
    ----------
    column : str or None
        Steering column of a table.
    topic : str or None
        Steering topic of a recording.
    joint : str
        Joint that steers, where the steering comes as joint states.
    degrees : bool
        Whether the steering is in degrees.
    wishes : tuple of Wish
        Channels taken from a named place.
    measured : bool
        Whether to read measurements, too; else only the inputs of a vehicle.
    until : float
        Time from the first steering sample on past which nothing need be read [s].
    """

    column: str | None = None
    topic: str | None = None
    joint: str = "steering"
    degrees: bool = False
    wishes: tuple[Wish, ...] = ()
    measured: bool = True
    until: float = math.inf
