"""Checks of parameter files after ``--params-file``: readable, and for one of the nodes."""

import re
from collections.abc import Iterator, Sequence
from contextlib import suppress
from itertools import pairwise
from pathlib import Path
from typing import Any

from yawdamp_ros.files import read_text
from yawdamp_ros.nodes.errors import NodeError

LARGEST_PARAMETER_FILE = 1 << 17
"""Largest parameter file in characters."""

MOST_BRACKETS = 1000
"""Limit on opening brackets in a parameter file."""


def parameter_files(ros_arguments: Sequence[str]) -> list[Path]:
    """Parameter files among the arguments of rclpy."""
    return [Path(value) for option, value in pairwise(ros_arguments) if option == "--params-file"]


def check_parameter_file(path: Path) -> None:
    """Refuse a file that would hang rcl's parser, whose time grows with the square of most sizes."""
    try:
        text = read_text(path, LARGEST_PARAMETER_FILE)
    except OSError as error:
        message = f"--params-file: {path}: cannot be read: {error.strerror}"
        raise NodeError(message) from error
    except UnicodeDecodeError as error:
        message = f"--params-file: {path}: not UTF-8 text; expected a YAML file"
        raise NodeError(message) from error
    if text.count("[") + text.count("{") > MOST_BRACKETS:
        message = f"--params-file: {path}: more than {MOST_BRACKETS} lists and mappings in brackets"
        raise NodeError(message)


def misfit(path: Path, node_name: str) -> str:
    """Sentence for a parameter file without a key for a node; empty if there is one.

    Parameters
    ----------
    path : Path
        Parameter file that rclpy has read.
    node_name : str
        Fully qualified.

    Returns
    -------
    str
    """
    from yawdamp_ros.plain_yaml import parse_yaml  # noqa: PLC0415 - it loads long, and few give a file

    names: list[str] = []
    with suppress(ValueError, OSError):  # rclpy has read the file nevertheless
        names = list(_node_names(parse_yaml(read_text(path, LARGEST_PARAMETER_FILE), LARGEST_PARAMETER_FILE)))
    if not names or any(_fits(name, node_name) for name in names):
        return ""
    return f"{path}: none of its parameters is for {node_name}: its keys are {', '.join(names)}; expected /**"


def _node_names(tree: Any, above: str = "") -> Iterator[str]:  # noqa: ANN401 - any YAML
    """Names, or patterns of names, whose parameters a file holds."""
    if isinstance(tree, dict):
        for key, below in tree.items():
            if key == "ros__parameters":
                yield above
            else:
                yield from _node_names(below, f"{above}/{str(key).strip('/')}")


def _fits(pattern: str, node_name: str) -> bool:
    """Return whether a name matches a pattern, in which * is one part of it and ** any number of them."""
    expression = re.escape(pattern).replace(r"/\*\*", "(/[^/]+)*").replace(r"\*", "[^/]+")
    return re.fullmatch(expression, node_name) is not None
