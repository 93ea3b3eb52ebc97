"""The vehicle that a recorded run holds."""

import json
from pathlib import Path

from yawdamp_ros.logs import LogError
from yawdamp_ros.logs.mcap_log import McapLog
from yawdamp_ros.vehicle import Vehicle, parse_vehicle

VEHICLE_FILE = "vehicle.yaml"
"""Name of the attachment that holds the vehicle file."""
METADATA_NAME = "yawdamp_ros"
"""Name of the metadata record that explains a run."""


def recorded_vehicle(path: Path) -> Vehicle:
    """Read the vehicle of a run, with its overrides.

    Parameters
    ----------
    path : Path
        Run directory or its MCAP file, as the node or `simulate` records it.

    Returns
    -------
    Vehicle

    Raises
    ------
    LogError
        If the recording holds none.

    Examples
    --------
    >>> import subprocess
    >>> import sys
    >>> command = [sys.executable, "-m", "yawdamp_ros", "simulate", "--manoeuvre", "step", "--duration", "1"]
    >>> _ = subprocess.run([*command, "--output", "with_vehicle"], capture_output=True, check=True)
    >>> recorded_vehicle(Path("with_vehicle")).name
    'interlink'
    """
    log = McapLog(path)
    next(log.messages(), None)  # The metadata that explains a run precedes its first message.
    try:
        return vehicle_of(log, path)
    except Exception as error:  # invalid texts may raise anything
        raise LogError(path, f"it holds no vehicle: {log.warning or error}") from error


def vehicle_of(log: McapLog, path: Path) -> Vehicle:
    """Return the vehicle of a log whose metadata has been read; invalid texts may raise anything."""
    changes = json.loads(log.metadata[METADATA_NAME]["vehicle_overrides"])
    return parse_vehicle(log.attachments[VEHICLE_FILE].decode(), str(path), changes)
