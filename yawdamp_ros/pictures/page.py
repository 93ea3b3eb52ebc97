"""HTML pages that need nothing else: styles, script and data are in them."""

import json
from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path
from string import Template

from yawdamp_ros.pictures.errors import PictureError


def page_text(template: str, title: str, data: Mapping[str, object]) -> str:
    """Page of a template of this package, with the look and the charts that all share.

    Parameters
    ----------
    template : str
        Its file's name.
    title : str
    data : mapping
        What the template's script draws, of what JSON holds.

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
