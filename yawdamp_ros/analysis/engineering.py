"""Numbers in the units that engineers read: km/h, t, kN, degrees."""

import math
from collections.abc import Mapping
from types import MappingProxyType

from yawdamp_ros.vehicle import STANDARD_GRAVITY

SI, ENGINEERING = "si", "engineering"
SYSTEMS = (SI, ENGINEERING)

FACTORS: Mapping[str, tuple[float, str]] = MappingProxyType(
    {
        "m/s": (3.6, "km/h"),
        "rad": (math.degrees(1.0), "deg"),
        "rad/s": (math.degrees(1.0), "deg/s"),
        "rad/(m/s2)": (math.degrees(1.0) * STANDARD_GRAVITY, "deg/g"),
        "m/s2": (1.0 / STANDARD_GRAVITY, "g"),
        "N": (1e-3, "kN"),
        "kg": (1e-3, "t"),
    }
)
"""Factor and engineering unit for each SI unit."""


def converted(value: float | None, unit: str, system: str) -> tuple[float | None, str]:
    """Value and unit in a system of units.

    Parameters
    ----------
    value : float or None
    unit : str
        SI.
    system : str
        One of `SYSTEMS`.

    Returns
    -------
    float or None
    str

    Examples
    --------
    >>> converted(20.0, "m/s", "engineering")
    (72.0, 'km/h')
    >>> converted(None, "kg", "si")
    (None, 'kg')
    """
    factor, name = FACTORS.get(unit, (1.0, unit)) if system == ENGINEERING else (1.0, unit)
    return (None if value is None else factor * value), name
