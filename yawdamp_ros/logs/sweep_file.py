"""Files that receive a sweep's answers, and from which an interrupted sweep continues.

A second file, with ``.json`` added to the name, holds the definition of the sweep: vehicle file,
changes, model, keys, points and measure. A sweep goes on from a file only where all of that is the same and
the points in the rows are its own; rows are written in the order of the points, so that those missing are
the last ones.
"""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Protocol

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.files import read_text
from yawdamp_ros.logs.errors import LogError

LARGEST_DESCRIPTION = 1 << 22
"""Largest definition of a sweep in characters, with its vehicle file."""


class SweepFile(Protocol):
    """Takes the answers of a sweep, in order.

    Attributes
    ----------
    answers : ndarray, shape (m, a)
        Answers of the first m points, which the file already holds.
    """

    answers: FloatArray

    def write(self, answers: FloatArray) -> None:
        """Append the answers of the next points, shape (chunk, a)."""

    def close(self) -> None:
        """Finish the file."""


def describe(path: Path, definition: Mapping[str, object]) -> bool:
    """Write the sweep's definition beside a file; return whether the file exists with the same definition.

    Parameters
    ----------
    path : Path
    definition : mapping
        Definition of the sweep, of types that JSON can hold.

    Raises
    ------
    LogError
        If the file is there and of another sweep.
    OSError, UnicodeDecodeError
        If the description cannot be read or written.
    """
    described = json.dumps(definition, indent=2) + "\n"
    description = path.with_name(f"{path.name}.json")
    if not path.exists():
        description.write_text(described, encoding="utf-8")
        return False
    if not description.exists() or read_text(description, LARGEST_DESCRIPTION) != described:
        raise another(path)
    return True


def another(path: Path) -> LogError:
    """Return the error for a file of another sweep."""
    return LogError(path, "is there and is not of this sweep; expected a new name, or the same sweep")


def unusable(path: Path, error: OSError | UnicodeDecodeError) -> LogError:
    """Error of a file that cannot be read or written."""
    return LogError(path, f"cannot be used: {getattr(error, 'strerror', None) or error}")
