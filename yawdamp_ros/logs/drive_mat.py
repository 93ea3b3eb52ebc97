"""Drives from MATLAB .mat files (version 7 and earlier), by scipy.io."""

import warnings
from pathlib import Path
from typing import Any

import numpy as np

from yawdamp_ros.drives import Channel, Drive
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.files import regular
from yawdamp_ros.logs.channel_names import listed
from yawdamp_ros.logs.drive_options import DriveOptions
from yawdamp_ros.logs.drive_table import channels_of, measured_columns
from yawdamp_ros.logs.errors import LogError
from yawdamp_ros.logs.steering_csv import TIME_COLUMNS, steering_column
from yawdamp_ros.logs.steering_log import LARGEST_ANGLE, LONGEST_LOG

LARGEST_FILE = 1 << 30
"""Largest size of a file [bytes]."""
MOST_VALUES = 100_000_000
"""Limit on the numbers of a file: a small file may claim to hold more than the memory."""
_MATLAB_73 = b"MATLAB 7.3"


def read_drive_mat(path: Path, options: DriveOptions) -> Drive:
    """Read a drive from vectors of one length, at the top of a .mat file or in one structure.

    Parameters
    ----------
    path : Path
        File of vectors named as the columns of a CSV file, one of them the time.
    options : DriveOptions

    Returns
    -------
    Drive

    Raises
    ------
    LogError
        If the file cannot be read, lacks a vector, or holds steering that is none.
    """
    vectors = _vectors(path)
    time_name = next((name for name in TIME_COLUMNS if name in vectors), None)
    if time_name is None:
        raise LogError(
            path, f"no time vector; expected one of {', '.join(TIME_COLUMNS)} among {listed(list(vectors))}"
        )
    time = vectors.pop(time_name)
    columns = {name: vector for name, vector in vectors.items() if len(vector) == len(time)}
    name = steering_column(list(columns), options.column, path)
    scale = np.pi / 180.0 if options.degrees or name.endswith("_deg") else 1.0
    angles = scale * columns[name]
    _check(time, angles, time_name, name, path)
    times = time - time[0]
    found = measured_columns(list(columns), options.wishes, [name], path)
    channels, notes = channels_of(found, times, columns)
    steering = Channel("steering", f"vector {name}", times, angles)
    return Drive(str(path), {"steering": steering, **channels}, notes=notes)


def is_mat(path: Path) -> bool:
    """Return whether a path is named as a .mat file."""
    return path.suffix.lower() == ".mat"


def _check(time: FloatArray, angles: FloatArray, time_name: str, name: str, path: Path) -> None:
    for label, vector in ((time_name, time), (name, angles)):
        if not np.isfinite(vector).all():
            at = int(np.argmin(np.isfinite(vector)))
            raise LogError(path, f"{label}({at + 1}): {vector[at]}: expected a finite number")
    if (np.diff(time) < 0.0).any():
        at = int(np.argmax(np.diff(time) < 0.0)) + 1
        raise LogError(path, f"{time_name}({at + 1}): {time[at]}: expected a time not before {time[at - 1]}")
    if time[-1] - time[0] > LONGEST_LOG:
        raise LogError(path, f"it lasts {time[-1] - time[0]:g} s; expected at most {LONGEST_LOG:g} s")
    if (np.abs(angles) > LARGEST_ANGLE).any():
        at = int(np.argmax(np.abs(angles) > LARGEST_ANGLE))
        raise LogError(path, f"{name}({at + 1}): expected an angle within {LARGEST_ANGLE:g} rad")


def _vectors(path: Path) -> dict[str, FloatArray]:
    try:
        content = _content(path)
    except LogError:
        raise
    except OSError as error:
        raise LogError(path, f"cannot be read: {error.strerror or error}") from error
    except Exception as error:  # the library may raise anything for bad bytes
        raise LogError(path, "not a MATLAB file of version 7 or earlier") from error
    structures = [_numeric(part) for part in content.values() if isinstance(part, dict)]
    return {name: vector for part in (*structures, _numeric(content)) for name, vector in part.items()}


def _content(path: Path) -> dict[str, Any]:
    from scipy.io import loadmat, whosmat  # noqa: PLC0415 - other formats do without

    with regular(path).open("rb") as stream:
        start = stream.read(len(_MATLAB_73))
    if start == _MATLAB_73:
        raise LogError(path, "a MATLAB 7.3 file; expected one saved with -v7")
    if path.stat().st_size > LARGEST_FILE:
        raise LogError(path, f"expected at most {LARGEST_FILE} bytes")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        if sum(int(np.prod(shape, dtype=object)) for _, shape, _ in whosmat(path)) > MOST_VALUES:
            raise LogError(path, f"expected at most {MOST_VALUES} values")
        content: dict[str, Any] = loadmat(path, squeeze_me=True, simplify_cells=True)
    return content


def _numeric(content: dict[str, Any]) -> dict[str, FloatArray]:
    return {
        name: part.astype(np.float64)
        for name, part in content.items()
        if isinstance(part, np.ndarray) and part.ndim == 1 and part.dtype.kind in "fiu" and len(part)
    }
