"""Definitions of ROS messages as an MCAP schema holds them: with every dependency.

They are read from the ``.msg`` files that each message package installs, so that what is recorded is what
is on the wire.
"""

import json
import os
import re
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

from yawdamp_ros.logs.errors import LogError

_SEPARATOR = "=" * 80
_FIELD = re.compile(r"^\s*([A-Za-z]\w*(?:/\w+)*)(?:<=\d+)?(?:\[[^\]]*\])?\s+\w+")
_PRIMITIVES = frozenset(
    ["bool", "byte", "char", "float32", "float64", "string", "wstring"]
    + [f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)]
)


_WRITTEN_HERE = {"tf2_msgs/msg/TFMessage": "geometry_msgs/TransformStamped[] transforms"}
"""Definitions of packages that are not on PyPI, as the format prescribes them."""


class MessageDefinition(NamedTuple):
    """Schema text of a message type and its hash.

    Attributes
    ----------
    text : str
        Encoding ``ros2msg``.
    type_hash : str
        Hash by REP-2016; empty if the package has none.
    """

    text: str
    type_hash: str


@cache
def message_definition(type_name: str) -> MessageDefinition:
    """Definition of a message type.

    Parameters
    ----------
    type_name : str
        Message type, as in ``sensor_msgs/msg/Imu``.

    Returns
    -------
    MessageDefinition

    Raises
    ------
    LogError
        If the package that defines it is not installed.
    """
    package, _, name = type_name.split("/")
    sections, type_hash = [_WRITTEN_HERE.get(type_name, "")], ""
    if not sections[0] or find_spec(package) is not None:
        main = _message_file(package, name)
        sections, type_hash = [main.read_text(encoding="utf-8").rstrip("\n")], _type_hash(main, type_name)
    included: dict[str, None] = {f"{package}/{name}": None}
    pending = _dependencies(sections[0], package)
    while pending:
        dependency = pending.pop(0)
        if dependency in included:
            continue
        included[dependency] = None
        text = _message_file(*dependency.split("/")).read_text(encoding="utf-8").rstrip("\n")
        sections.append(f"{_SEPARATOR}\nMSG: {dependency}\n{text}")
        pending += _dependencies(text, dependency.split("/")[0])
    return MessageDefinition("\n".join(sections) + "\n", type_hash)


def _dependencies(text: str, package: str) -> list[str]:
    found = []
    for line in text.splitlines():
        match = _FIELD.match(line)
        if match and match[1] not in _PRIMITIVES:
            parts = match[1].split("/")
            found.append(f"{parts[0] if len(parts) > 1 else package}/{parts[-1]}")
    return found


def _message_file(package: str, name: str) -> Path:
    # A ROS from PyPI sets no AMENT_PREFIX_PATH, but its Python modules lie below its prefix.
    prefixes = [Path(entry) for entry in os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if entry]
    module = find_spec(package)
    if module is not None and module.origin is not None:
        prefixes += Path(module.origin).parents
    for prefix in prefixes:
        path = prefix.joinpath("share", package, "msg", f"{name}.msg")
        if path.is_file():
            return path
    message_type = f"{package}/msg/{name}"
    raise LogError(message_type, f"its definition is not installed; install {package}")


def _type_hash(message_file: Path, type_name: str) -> str:
    try:
        described = json.loads(message_file.with_suffix(".json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return ""
    hashes = {entry["type_name"]: entry["hash_string"] for entry in described["type_hashes"]}
    return str(hashes.get(type_name, ""))
