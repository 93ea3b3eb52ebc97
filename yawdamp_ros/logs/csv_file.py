"""CSV files, opened the same way by all readers."""

import csv
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from yawdamp_ros.files import regular
from yawdamp_ros.logs.errors import LogError

if TYPE_CHECKING:
    import _csv
    from collections.abc import Iterator
    from typing import TextIO

LONGEST_LINE = 1 << 20
"""Maximum line length in characters."""


@contextmanager
def csv_reader(path: Path) -> "Iterator[_csv.Reader]":
    """Rows of a UTF-8 CSV file.

    Raises
    ------
    LogError
        If it cannot be read, then or later.
    """
    try:
        with regular(path).open(encoding="utf-8-sig", newline="") as file:
            yield csv.reader(_lines(file, path))
    except OSError as error:
        raise LogError(path, f"cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise LogError(path, "not UTF-8 text; expected a CSV file") from error
    except csv.Error as error:
        raise LogError(path, f"not valid CSV: {error}") from error


def _lines(file: "TextIO", path: Path) -> "Iterator[str]":
    while line := file.readline(LONGEST_LINE + 1):
        if len(line) > LONGEST_LINE:
            raise LogError(path, f"a line of more than {LONGEST_LINE} characters; expected a CSV file")
        yield line
