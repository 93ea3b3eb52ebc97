"""Meaning of names in a log: quantity, unit of the vehicle, and unit of measure."""

import re
from collections.abc import Sequence
from typing import NamedTuple

from yawdamp_ros.drives import INPUTS, QUANTITIES, UNITS, quantity_of
from yawdamp_ros.logs.errors import LogError

_SPELLINGS = {
    "speed": "speed velocity vx v_ego vehicle_speed longitudinal_velocity longitudinal_speed forward_speed",
    "acceleration": "acceleration longitudinal_acceleration ax accel_x acceleration_x",
    "yaw_rate": "yaw_rate yawrate yaw_velocity heading_rate gyro_z angular_velocity_z",
    "lateral_acceleration": "lateral_acceleration lateral_accel lat_accel lat_acc ay accel_y acceleration_y",
    "yaw": "yaw heading yaw_angle",
    "gear": "gear",
    "friction": "friction road_friction",
    "brake": "brake",
    "yaw_moment": "yaw_moment",
    "x": "x position_x pos_x",
    "y": "y position_y pos_y",
}
_QUANTITIES = {spelling: name for name, spellings in _SPELLINGS.items() for spelling in spellings.split()}
_SUFFIXES = {
    "rad": "rad",
    "deg": "deg",
    "rad/s": "radps rad_s rad_per_s",
    "deg/s": "degps deg_s dps deg_per_s",
    "m/s": "mps m_s ms",
    "km/h": "kmh kph km_h kmph",
    "mph": "mph",
    "m/s^2": "mps2 m_s2 ms2",
    "g": "g",
    "m": "m",
}
_ENDINGS = sorted(
    ((f"_{suffix}", unit) for unit, suffixes in _SUFFIXES.items() for suffix in suffixes.split()),
    key=lambda ending: -len(ending[0]),
)
_ARTICULATION = re.compile(r"(?:articulation|hitch_angle|articulation_angle)_?(\d*)")


class Named(NamedTuple):
    """Meaning of a name.

    Attributes
    ----------
    channel : str
        Name of the channel.
    unit : str
        Key of `UNITS`.
    """

    channel: str
    unit: str


def named(name: str) -> Named | None:
    """Channel and unit in the name of a column or a topic; None if it tells neither.

    Steering has its own rules, because it may be of a hand wheel and have any name.

    Parameters
    ----------
    name : str
        Name in the log, as in ``speed_kmh``, ``truck/yaw_rate`` or ``/truck/yaw_rate``.
    """
    prefix, _, last = name.strip("/").rpartition("/")
    word, unit = _without_unit(last.lower().replace(" ", "_"))
    if match := _ARTICULATION.fullmatch(word):
        return _fitting(f"articulation_{match[1] or 1}", unit)
    quantity = _QUANTITIES.get(word)
    if quantity is None:
        return None
    owner = prefix.rpartition("/")[2]
    if quantity in {"brake", "yaw_moment"} and not owner:
        return None  # of which unit?
    inputs = quantity in INPUTS
    return _fitting(f"{owner}/{quantity}" if owner and not inputs else quantity, unit)


def listed(names: Sequence[str], limit: int = 12) -> str:
    """List some names, with a note if there are more."""
    shown = ", ".join(name[:80] for name in names[:limit])
    return shown if len(names) <= limit else f"{shown}, ..."


class Wish(NamedTuple):
    """Channel with a place that the user named.

    Attributes
    ----------
    channel : str
    place : str
        A column, a topic, or a topic and a field as in ``/imu.angular_velocity.z``.
    unit : str
        Key of `UNITS`; empty: as the place's name says, else the SI unit.
    sign : float
        -1 where right or backwards is positive in the log.
    """

    channel: str
    place: str
    unit: str
    sign: float


def parse_wish(text: str) -> Wish:
    """Parse a wish such as ``truck/yaw_rate=-gyro:deg/s``.

    Raises
    ------
    LogError
        If it is none.
    """
    channel, separator, rest = text.partition("=")
    if not (separator and rest) or quantity_of(channel) not in QUANTITIES:
        raise LogError(text, f"expected CHANNEL=PLACE[:UNIT], CHANNEL one of {', '.join(QUANTITIES)}")
    sign = -1.0 if rest.startswith("-") else 1.0
    place, colon, unit = rest.removeprefix("-").rpartition(":")
    if not colon:
        return Wish(channel, rest.removeprefix("-"), "", sign)
    expected = [name for name, (si, _) in UNITS.items() if si == QUANTITIES[quantity_of(channel)]]
    if unit not in expected:
        raise LogError(text, f"unit {unit!r}: expected one of {', '.join(expected)}")
    return Wish(channel, place, unit, sign)


def unit_in(name: str, quantity: str) -> str:
    """Unit that a name ends in, if it fits the quantity; else the SI unit."""
    _, unit = _without_unit(name.lower())
    return unit if unit and UNITS[unit][0] == QUANTITIES[quantity] else QUANTITIES[quantity]


def _without_unit(name: str) -> tuple[str, str]:
    for ending, unit in _ENDINGS:
        if name.endswith(ending) and name not in _QUANTITIES:
            return name.removesuffix(ending), unit
    return name, ""


def _fitting(channel: str, unit: str) -> Named | None:
    si = QUANTITIES[quantity_of(channel)]
    if unit and UNITS[unit][0] != si:
        return None
    return Named(channel, unit or si)
