"""The schemas of vehicle files and schemes, and the error for a file that violates one."""

import json
import math
from collections.abc import Iterator
from functools import cache
from typing import TYPE_CHECKING, Any

from yawdamp_ros.share import share_directory
from yawdamp_ros.vehicle.errors import VehicleError

if TYPE_CHECKING:
    from jsonschema import Draft202012Validator, ValidationError


def check_schema(data: Any, source: str, schema: str = "vehicle.schema.json") -> None:  # noqa: ANN401
    """Check the data of a file against a schema of `config`.

    Raises
    ------
    VehicleError
        If they do not keep to it; the message names file, key, value and what was expected.
    """
    # First, because infinities and integers too long for a float lead to unclear messages.
    for key, value in _numbers(data, ""):
        if abs(value) > 1e300 or math.isnan(value):  # noqa: PLR2004
            shown = value if isinstance(value, float) else "a very long number"
            raise VehicleError(source, key, f"{shown}: expected a finite number")
    for key in _nameless(data, ""):
        raise VehicleError(source, key, "unknown key; expected a name")
    errors = sorted(_validator(schema).iter_errors(data), key=lambda error: list(map(str, error.path)))
    if errors:
        raise _schema_error(errors[0], source)


def _schema_error(error: "ValidationError", source: str) -> VehicleError:
    key = ".".join(map(str, error.path))
    if error.validator == "additionalProperties":
        known = error.schema["properties"]
        unknown = next(name for name in error.instance if name not in known)
        return VehicleError(
            source, _join(key, str(unknown)), f"unknown key; expected one of {', '.join(known)}"
        )
    if error.validator == "required":
        missing = next(name for name in error.validator_value if name not in error.instance)
        return VehicleError(source, _join(key, missing), "missing")
    shown = _shorten(repr(error.instance))
    return VehicleError(source, key, f"{shown}: expected {error.schema['description']}")


def _numbers(node: Any, key: str) -> Iterator[tuple[str, float]]:  # noqa: ANN401
    if isinstance(node, dict):
        for name, child in node.items():
            yield from _numbers(child, _join(key, str(name)))
    elif isinstance(node, list):
        for index, child in enumerate(node):
            yield from _numbers(child, _join(key, str(index)))
    elif isinstance(node, int | float):
        yield key, node


def _nameless(node: Any, key: str) -> Iterator[str]:  # noqa: ANN401
    """Keys that are not text; jsonschema before 4.18 fails on them."""
    children = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    for name, child in children:
        if isinstance(node, dict) and not isinstance(name, str):
            yield _join(key, str(name))
        yield from _nameless(child, _join(key, str(name)))


@cache
def _validator(schema: str) -> "Draft202012Validator":
    from jsonschema import Draft202012Validator  # noqa: PLC0415 - help needs none of it

    path = share_directory() / "config" / schema
    return Draft202012Validator(json.loads(path.read_text(encoding="utf-8")))


def _join(key: str, name: str) -> str:
    return f"{key}.{name}" if key else name


def _shorten(text: str, limit: int = 60) -> str:
    return text if len(text) <= limit else text[: limit - 3] + "..."
