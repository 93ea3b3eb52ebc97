"""CSV files, opened alike for all that is read from them."""

import csv
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from yawdamp_ros.logs.errors import LogError

if TYPE_CHECKING:
    import _csv
    from collections.abc import Iterator


@contextmanager
def csv_reader(path: Path) -> "Iterator[_csv.Reader]":
    """Rows of a UTF-8 CSV file.

    Raises
    ------
    LogError
        If it cannot be read, then or later.
    """
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            yield csv.reader(file)
    except OSError as error:
        raise LogError(path, f"cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise LogError(path, "not UTF-8 text; expected a CSV file") from error
    except csv.Error as error:
        raise LogError(path, f"not valid CSV: {error}") from error
