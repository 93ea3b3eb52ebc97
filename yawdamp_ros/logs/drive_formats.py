"""The formats that a recorded drive may have, each read by a module of its own."""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from yawdamp_ros.drives import Drive
from yawdamp_ros.logs.channel_names import parse_wish
from yawdamp_ros.logs.drive_csv import read_drive_csv
from yawdamp_ros.logs.drive_mat import is_mat, read_drive_mat
from yawdamp_ros.logs.drive_options import DriveOptions
from yawdamp_ros.logs.drive_recording import read_drive_recording
from yawdamp_ros.logs.mcap_log import is_recording
from yawdamp_ros.logs.sqlite_log import SqliteLog, is_sqlite


class Format(NamedTuple):
    """A format of drives.

    Attributes
    ----------
    name : str
    fits : callable
        Whether a path is of this format.
    read : callable
        Drive of a path.
    has_topics : bool
        Whether its channels are topics; else they are columns.
    """

    name: str
    fits: Callable[[Path], bool]
    read: Callable[[Path, DriveOptions], Drive]
    has_topics: bool


FORMATS = (
    Format(
        "rosbag2 with sqlite3",
        is_sqlite,
        lambda path, options: read_drive_recording(path, options, SqliteLog(path)),
        has_topics=True,
    ),
    Format("MATLAB", is_mat, read_drive_mat, has_topics=False),
    Format("recording", is_recording, read_drive_recording, has_topics=True),
    Format("CSV", lambda _: True, read_drive_csv, has_topics=False),
)
"""Formats in the order in which they are tried; the last fits everything."""


def format_of(path: Path) -> Format:
    """Format of a path.

    Raises
    ------
    LogError
        If there is nothing to be read.
    """
    return next(each for each in FORMATS if each.fits(path))


def load_drive(  # noqa: PLR0913 - each says how one thing is found
    path: str | Path,
    *,
    column: str | None = None,
    topic: str | None = None,
    joint: str = "steering",
    degrees: bool = False,
    channels: Sequence[str] = (),
    measured: bool = True,
    until: float = math.inf,
) -> Drive:
    r"""Read a recorded drive: CSV, MCAP, rosbag2 (mcap or sqlite3) or MATLAB .mat.

    Parameters
    ----------
    path : str or Path
    column : str, optional
        Steering column of a table; unless given, the one whose name contains ``steer``.
    topic : str, optional
        Steering topic of a recording; unless given, the one that fits by type and name.
    joint : str
        Joint that steers, where the steering comes as joint states.
    degrees : bool
        Whether the steering is in degrees.
    channels : sequence of str
        Channels taken from a named place, as in ``truck/yaw_rate=-gyro:deg/s`` or
        ``speed=/can/speed.data:km/h``; a minus flips the sign.
    measured : bool
        Whether to read measurements, too; else only the inputs of a vehicle.
    until : float
        Time from the first steering sample on past which nothing need be read [s].

    Returns
    -------
    Drive
        In SI units, signs as REP-103 has them, time from the first steering sample on.

    Raises
    ------
    LogError
        If the log cannot be read, or holds no steering; the message names file, place and what was
        expected.

    Examples
    --------
    >>> from pathlib import Path
    >>> from yawdamp_ros import load_drive
    >>> _ = Path("drive.csv").write_text("time_s,steer_deg,speed_kmh\n0,0,72\n1,2,72\n", encoding="utf-8")
    >>> drive = load_drive("drive.csv")
    >>> drive["steering"].values.round(4).tolist(), drive["speed"].values.tolist()
    ([0.0, 0.0349], [20.0, 20.0])
    """
    wishes = [parse_wish(text) for text in channels]
    sign = 1.0
    for wish in wishes:
        if wish.channel == "steering":
            column = topic = wish.place
            degrees, sign = degrees or wish.unit == "deg", wish.sign
    others = tuple(wish for wish in wishes if wish.channel != "steering")
    place = Path(path)
    drive = format_of(place).read(place, DriveOptions(column, topic, joint, degrees, others, measured, until))
    if sign > 0.0:
        return drive
    steering = drive["steering"]
    turned = replace(steering, values=-steering.values, source=f"minus {steering.source}")
    return replace(drive, channels={**drive.channels, "steering": turned})
