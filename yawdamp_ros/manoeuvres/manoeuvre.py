"""Manoeuvres by name, as commands and parameters give them."""

import math
from collections.abc import Mapping
from dataclasses import fields
from types import MappingProxyType

from yawdamp_ros.manoeuvres.errors import ManoeuvreError
from yawdamp_ros.manoeuvres.shapes import Chirp, LaneChange, Pulse, Ramp, Sine, Step

Manoeuvre = Sine | Step | Ramp | Pulse | Chirp

MANOEUVRES: Mapping[str, type[Manoeuvre]] = MappingProxyType(
    {
        "lane_change": LaneChange,
        "sine": Sine,
        "step": Step,
        "ramp": Ramp,
        "chirp": Chirp,
        "pulse": Pulse,
    }
)

SETTINGS = tuple(dict.fromkeys(field.name for kind in MANOEUVRES.values() for field in fields(kind)))
"""Every setting that some manoeuvre takes."""

_POSITIVE = frozenset({"frequency", "rise_time", "width", "final_frequency", "sweep_time"})
_NOT_NEGATIVE = frozenset({"start", "cycles"})
_LEAST, _LARGEST = 1e-9, 1e9
"""Smallest and largest value of all settings but the amplitude; others would overflow."""


def make_manoeuvre(name: str, settings: Mapping[str, float]) -> Manoeuvre:
    """Return the manoeuvre of a name with some of its settings given.

    Parameters
    ----------
    name : str
        One of `MANOEUVRES`.
    settings : mapping of str to float
        Fields of that manoeuvre; the others keep their defaults.

    Returns
    -------
    Manoeuvre

    Raises
    ------
    ManoeuvreError
        If there is no such manoeuvre, it has no such setting, or a value is out of range.

    Examples
    --------
    >>> from yawdamp_ros.manoeuvres import make_manoeuvre
    >>> make_manoeuvre("step", {"amplitude": 0.02})
    Step(amplitude=0.02, start=1.0)
    """
    if name not in MANOEUVRES:
        message = f"manoeuvre: {name!r}: expected one of {', '.join(MANOEUVRES)}"
        raise ManoeuvreError(message)
    kind = MANOEUVRES[name]
    known = [field.name for field in fields(kind)]
    for setting, value in settings.items():
        if setting not in known:
            message = f"{setting}: manoeuvre {name} does not use it; it takes {', '.join(known)}"
            raise ManoeuvreError(message)
        _check(setting, value)
    return kind(**settings)


def _check(setting: str, value: float) -> None:
    if setting in _POSITIVE:
        valid, expected = _LEAST <= value <= _LARGEST, f"a number above 0, from {_LEAST:g} to {_LARGEST:g}"
    elif setting in _NOT_NEGATIVE:
        valid, expected = 0.0 <= value <= _LARGEST, f"a number, 0 or more, up to {_LARGEST:g}"
    else:
        valid, expected = abs(value) <= math.pi / 2, "an angle in rad of at most pi/2"
    if not valid:
        message = f"{setting}: {value}: expected {expected}"
        raise ManoeuvreError(message)
