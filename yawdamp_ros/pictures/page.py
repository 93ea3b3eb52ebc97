"""HTML pages that need nothing else: styles, script and data are in them."""

import json
import shutil
import subprocess
import tempfile
from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path
from string import Template

from yawdamp_ros.pictures.errors import PictureError

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
"""Programs that can print a page."""
LONGEST_PRINT = 120.0
"""Longest time for printing a page [s]."""


def page_text(template: str, title: str, data: Mapping[str, object]) -> str:
    """Page of a template of this package, with the common style and charts.

    Parameters
    ----------
    template : str
        File name of the template.
    title : str
    data : mapping
        Data for the template's script, of types that JSON can hold.

    Returns
    -------
    str
    """
    here = files("yawdamp_ros.pictures")
    # A name from a file must not end the script that holds it.
    held = json.dumps(data).replace("<", "\\u003c")
    return Template(here.joinpath(template).read_text(encoding="utf-8")).substitute(
        title=title,
        data=held,
        style=here.joinpath("page.css").read_text(encoding="utf-8"),
        script=here.joinpath("page.js").read_text(encoding="utf-8"),
    )


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


def print_page(text: str, path: str | Path) -> None:
    """Print a page to a PDF file, by a browser of the machine.

    Parameters
    ----------
    text : str
        HTML.
    path : str or Path

    Raises
    ------
    PictureError
        If no such browser is found, or it prints nothing.
    """
    browser = next((found for name in BROWSERS if (found := shutil.which(name))), None)
    if browser is None:
        message = f"{path}: needs a browser that prints, none of {', '.join(BROWSERS)} is installed"
        raise PictureError(message)
    with tempfile.TemporaryDirectory() as directory:
        page, printed = Path(directory) / "page.html", Path(directory) / "page.pdf"
        save_page(text, page)
        command = [browser, "--headless", "--disable-gpu", "--no-sandbox", "--no-pdf-header-footer"]
        command += ["--force-prefers-reduced-motion", f"--user-data-dir={directory}/profile"]
        command += [f"--print-to-pdf={printed}", page.as_uri()]
        try:
            subprocess.run(  # noqa: S603 - a program of the list, and paths made here
                command, capture_output=True, check=True, timeout=LONGEST_PRINT
            )
            shutil.copyfile(printed, path)
        except (OSError, subprocess.SubprocessError) as error:
            message = f"{path}: cannot be printed by {browser}: {getattr(error, 'strerror', None) or error}"
            raise PictureError(message) from error
