"""HTML pages as files."""

from pathlib import Path

from yawdamp_ros.pictures.errors import PictureError


def save_page(text: str, path: str | Path) -> None:
    """Write a page.

    Raises
    ------
    PictureError
        If the file cannot be written.
    """
    try:
        Path(path).write_text(text, encoding="utf-8")
    except OSError as error:
        message = f"{path}: cannot be written: {error.strerror}"
        raise PictureError(message) from error
