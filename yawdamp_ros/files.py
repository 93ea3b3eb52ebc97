"""Files of any origin, opened in one way."""

import errno
import os
import stat
from pathlib import Path


def regular(path: Path) -> Path:
    """Return the path of a file that can be read to its end.

    Reading a pipe would wait, and a device may never end.

    Raises
    ------
    OSError
        If there is nothing, or it is no regular file.
    """
    try:
        mode = path.stat().st_mode
    except ValueError as error:  # a NUL or half a character in it
        raise OSError(errno.ENOENT, "not a file name") from error
    if stat.S_ISDIR(mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    if not stat.S_ISREG(mode):
        raise OSError(errno.EINVAL, "not a regular file")
    return path


def read_text(path: Path, most: int) -> str:
    """Text of a file of at most so many characters.

    Raises
    ------
    OSError
        If it cannot be read, or is longer.
    UnicodeDecodeError
        If it is not UTF-8.
    """
    with regular(path).open(encoding="utf-8") as file:
        text = file.read(most + 1)
    if len(text) > most:
        raise OSError(errno.EFBIG, f"longer than {most} characters")
    return text
