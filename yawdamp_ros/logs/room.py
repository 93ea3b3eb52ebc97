"""Check that a disk has room for a run before it is written."""

import shutil
from pathlib import Path

from yawdamp_ros.logs.errors import LogError

CSV_VALUE = 22
"""Size of a number of a CSV file, with its comma [bytes]."""
WHEEL_VALUES = 5
"""Numbers of a wheel in a CSV file."""
RUN_UNIT = 330
"""Compressed size of a sample of a unit in a run directory [bytes]."""
RUN_WHEEL = 36
"""Compressed size of a sample of a wheel in a run directory [bytes]."""
SPARE = 2
"""Required free space over the size of the run: others write to the disk, too."""


def size_of_run(samples: int, units: int, wheels: int = 0, *, csv: bool) -> int:
    """Estimate the size of a run on disk.

    Parameters
    ----------
    samples, units : int
    wheels : int
        Number of wheels in it; 0 for the linear models.
    csv : bool
        Whether it is a CSV file; else a run directory.

    Returns
    -------
    int
        Bytes.
    """
    if csv:
        return samples * CSV_VALUE * (4 * units + 1 + WHEEL_VALUES * wheels)
    return samples * (RUN_UNIT * units + RUN_WHEEL * wheels)


def check_room(output: Path, samples: int, units: int, wheels: int = 0) -> None:
    """Refuse a run unless the disk has twice the room for it.

    Parameters
    ----------
    output : Path
        Path of the run to be written; a name ending in .csv means a CSV file.
    samples, units, wheels : int

    Raises
    ------
    LogError
        If there is not enough room.
    """
    size = size_of_run(samples, units, wheels, csv=output.suffix == ".csv")
    place = next((parent for parent in output.absolute().parents if parent.is_dir()), Path("/"))
    free = shutil.disk_usage(place).free
    if SPARE * size > free:
        raise LogError(
            output,
            f"about {size / 1e9:.3g} GB to write, and {free / 1e9:.3g} GB free: expected twice as much "
            "room; a shorter --duration or a longer --sample-period takes less",
        )
