"""Sources of vehicles that need no other file."""

import json
from collections.abc import Sequence
from pathlib import Path

from yawdamp_ros.vehicle.errors import VehicleError
from yawdamp_ros.vehicle.load import LARGEST_FILE, VehicleSource, overridden_data, vehicle_text


def vehicle_source(vehicle: str | Path, overrides: Sequence[str] = ()) -> VehicleSource:
    """Read the source of a vehicle, including its tyre files.

    Recordings hold such a source, so that they can be simulated again where those files are not.

    Parameters
    ----------
    vehicle : str or Path
        Name of a builtin vehicle, or path of a vehicle file.
    overrides : sequence of str
        Changes to it, each ``KEY=VALUE``.

    Returns
    -------
    VehicleSource
        The file itself if it names no .tir file.

    Raises
    ------
    VehicleError
        If a file cannot be read, or all of them together are too large for a recording.

    Examples
    --------
    >>> vehicle_source("interlink", ["speed=20"]).overrides
    ('speed=20',)
    """
    found = VehicleSource(vehicle_text(vehicle), tuple(overrides))
    if not any(".tir" in text for text in (found.text, *found.overrides)):
        return found
    of_tyres = [text for text in found.overrides if text.endswith(".tir")]
    data = overridden_data(found.text, str(vehicle), of_tyres)
    try:
        axles = [axle for unit in data["units"] for axle in unit["axles"]]
        for axle in axles:
            tyre = str(axle.get("tyre"))
            if tyre.endswith(".tir") and "\n" not in tyre:
                axle["tyre"] = _tyre_text(Path(vehicle).parent / tyre)
    except (AttributeError, KeyError, TypeError):
        return found  # not a vehicle: the parser reports why
    text = json.dumps(data, indent=1)
    if len(text) > LARGEST_FILE:
        problem = f"{len(text)} characters with its .tir files: expected up to {LARGEST_FILE}"
        raise VehicleError(str(vehicle), "", problem)
    return VehicleSource(text, tuple(each for each in found.overrides if each not in of_tyres))


def _tyre_text(path: Path) -> str:
    from yawdamp_ros.vehicle.tir import tir_text  # noqa: PLC0415 - few vehicles have one

    return tir_text(path)
