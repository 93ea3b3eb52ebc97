"""Tyre property files (.tir) of the magic formula, read strictly.

The format is that of PAC2002 and MF-Tyre 5.2: sections in brackets, lines ``KEY = value``, text in single
quotes, comments from ``$`` or ``!``. Read are the nominal load, the scaling, and the coefficients of pure
lateral force and of the longitudinal peak; the model has no camber and no wheel spin, so that the others do
not matter to it.
"""

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from yawdamp_ros.files import read_text
from yawdamp_ros.vehicle.errors import VehicleError

LARGEST_FILE = 1 << 18
"""Largest .tir file in characters."""

FORMATS = ("PAC2002", "MF-TYRE", "MF_TYRE", "MF_05", "MF_52")
"""Formats of [MODEL] PROPERTY_FILE_FORMAT whose lateral force is that of `magic_formula_force`."""

UNITS = {
    "LENGTH": ("meter", "metre", "m"),
    "FORCE": ("newton", "n"),
    "ANGLE": ("radian", "radians", "rad"),
}
"""Units that a file may state; others are rejected, not converted."""

REQUIRED = {
    "MODEL": ("PROPERTY_FILE_FORMAT",),
    "VERTICAL": ("FNOMIN",),
    "LATERAL_COEFFICIENTS": ("PCY1", "PDY1", "PKY1", "PKY2"),
}

COEFFICIENTS = (
    "FNOMIN", "PCY1", "PDY1", "PDY2", "PEY1", "PEY2", "PEY3", "PKY1", "PKY2", "PHY1", "PHY2", "PVY1", "PVY2",
    "LFZO", "LCY", "LMUY", "LEY", "LKY", "LHY", "LVY", "PDX1", "PDX2", "LMUX",
)  # fmt: skip
"""Names read from the file, in the order of `MagicFormula.coefficients`; a missing scale (L..) is 1."""

_SECTION = re.compile(r"\[([A-Za-z0-9_]+)\]")
_ENTRY = re.compile(r"([A-Za-z][A-Za-z0-9_]*)\s*=\s*('[^']*'|[^\s']+)")


@dataclass(frozen=True)
class MagicFormula:
    """A tyre by the magic formula.

    Attributes
    ----------
    name : str
        File that it was read from.
    coefficients : tuple of float
        Coefficients in the order of `COEFFICIENTS`, in SI units.
    relaxation_length : float or None
        Relaxation length at the nominal load [m], from PTY1, PTY2 and UNLOADED_RADIUS; None without them.

    Examples
    --------
    >>> from pathlib import Path
    >>> from yawdamp_ros.vehicle import read_tir
    >>> tyre = read_tir(Path("truck.tir"))
    >>> tyre.coefficients[:3]
    (35000.0, 1.2, 0.8)
    """

    name: str
    coefficients: tuple[float, ...]
    relaxation_length: float | None = None


def read_tir(path: Path) -> MagicFormula:
    """Read a tyre property file.

    Parameters
    ----------
    path : Path

    Returns
    -------
    MagicFormula

    Raises
    ------
    VehicleError
        If there is no such file, or it is not a valid one; the message names file, line or key, and what was
        expected.

    Examples
    --------
    >>> from pathlib import Path
    >>> from yawdamp_ros.vehicle import read_tir
    >>> read_tir(Path("truck.tir")).name
    'truck.tir'
    """
    return parse_tir(tir_text(path), str(path))


def tir_text(path: Path) -> str:
    """Read the text of a tyre property file.

    Parameters
    ----------
    path : Path

    Returns
    -------
    str
        Ending with a line break.

    Raises
    ------
    VehicleError
        If it cannot be read.
    """
    try:
        return read_text(path, LARGEST_FILE) + "\n"
    except OSError as error:
        raise VehicleError(str(path), "", f"cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise VehicleError(str(path), "", "not UTF-8 text; expected a .tir file") from error


def parse_tir(text: str, source: str) -> MagicFormula:
    """Turn the text of a tyre property file into a `MagicFormula`.

    Parameters
    ----------
    text : str
    source : str
        Name of the file in error messages.

    Returns
    -------
    MagicFormula

    Raises
    ------
    VehicleError

    Examples
    --------
    >>> text = '''[MODEL]
    ... PROPERTY_FILE_FORMAT = 'PAC2002'
    ... [VERTICAL]
    ... FNOMIN = 35000
    ... [LATERAL_COEFFICIENTS]
    ... PCY1 = 1.2
    ... PDY1 = 0.8
    ... PKY1 = -12
    ... PKY2 = 1.7  $ at this share of the nominal load the stiffness is largest
    ... '''
    >>> parse_tir(text, "truck.tir").coefficients[:3]
    (35000.0, 1.2, 0.8)
    """
    sections = _sections(text, source)
    for section, keys in REQUIRED.items():
        if section not in sections:
            raise VehicleError(source, f"[{section}]", "missing")
        for key in keys:
            if key not in sections[section]:
                raise VehicleError(source, f"[{section}] {key}", "missing")
    form = sections["MODEL"]["PROPERTY_FILE_FORMAT"]
    if form not in FORMATS:
        raise VehicleError(
            source, "[MODEL] PROPERTY_FILE_FORMAT", f"{form!r}: expected one of {', '.join(FORMATS)}"
        )
    for key, allowed in UNITS.items():
        unit = sections.get("UNITS", {}).get(key, allowed[0])
        if str(unit).lower() not in allowed:
            raise VehicleError(source, f"[UNITS] {key}", f"{unit!r}: expected {allowed[0]}")
    numbers = {
        key: value
        for section in sections.values()
        for key, value in section.items()
        if isinstance(value, float)
    }
    for key in ("FNOMIN", "PKY2"):
        if not numbers.get(key, 0.0) > 0.0:
            raise VehicleError(source, key, f"{numbers.get(key)}: expected a number above 0")
    return MagicFormula(
        source,
        tuple(numbers.get(key, 1.0 if key.startswith("L") else 0.0) for key in COEFFICIENTS),
        _relaxation_length(numbers),
    )


def _relaxation_length(numbers: Mapping[str, float]) -> float | None:
    """Pacejka (2006), equation A.31 at the nominal load, without camber."""
    needed = ("PTY1", "PTY2", "UNLOADED_RADIUS")
    if any(key not in numbers for key in needed):
        return None
    rate, place, radius = (numbers[key] for key in needed)
    length = rate * math.sin(2.0 * math.atan2(1.0, place)) * radius * numbers.get("LSGAL", 1.0)
    return length if length > 0.0 else None


def _sections(text: str, source: str) -> dict[str, dict[str, float | str]]:
    sections: dict[str, dict[str, float | str]] = {}
    section = ""
    for number, raw in enumerate(text.splitlines(), 1):
        line = re.split(r"[$!]", raw, maxsplit=1)[0].strip()
        if not line:
            continue
        header = _SECTION.fullmatch(line)
        if header:
            section = header[1].upper()
            if section in sections:
                raise VehicleError(source, f"line {number}", f"section [{section}] stands twice")
            sections[section] = {}
        elif section == "SHAPE" or line.startswith("{"):
            continue  # the table of the tyre's contour
        else:
            key, value = _entry(line, f"line {number}", source)
            if not section:
                raise VehicleError(source, f"line {number}", f"{key}: expected a [SECTION] first")
            if key in sections[section]:
                raise VehicleError(source, f"line {number}", f"{key} stands twice in [{section}]")
            sections[section][key] = value
    return sections


def _entry(line: str, where: str, source: str) -> tuple[str, float | str]:
    found = _ENTRY.fullmatch(line)
    if not found:
        raise VehicleError(source, where, f"{line[:60]!r}: expected [SECTION] or KEY = value")
    key, value = found[1].upper(), found[2]
    if value.startswith("'"):
        return key, value[1:-1].strip()
    try:
        number = float(value)
    except ValueError as error:
        raise VehicleError(source, f"{where}: {key}", f"{value!r}: expected a number") from error
    if not math.isfinite(number):
        raise VehicleError(source, f"{where}: {key}", f"{value}: expected a finite number")
    return key, number
