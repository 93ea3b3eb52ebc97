"""Parameters of the simulator node, as `SimParameters` declares them."""

import difflib
from collections.abc import Iterable, Mapping
from dataclasses import asdict, fields, replace
from pathlib import Path
from typing import Any

from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
from rclpy.node import Node
from rclpy.parameter import Parameter

from yawdamp_ros.nodes.errors import NodeError
from yawdamp_ros.simulation.settings import SimParameters

_TYPE_NAMES = {
    bool: "true or false",
    int: "an integer",
    float: "a double",
    str: "a string",
    list: "a list of strings",
}
_OF_RCLPY = ("use_sim_time", "qos_overrides.", "start_type_description_service")


def declare_parameters(node: Node) -> SimParameters:
    """Declare every parameter on a node and read what it was given.

    Raises
    ------
    NodeError
        If a value has the wrong type or is out of range, or there is no such parameter.
    """
    defaults = asdict(SimParameters())
    # rclpy has no public way to see overrides of parameters that nobody declared, and a misspelt one
    # must not be ignored.
    overrides = node._parameter_overrides  # noqa: SLF001
    described = {declared.name: declared.metadata for declared in fields(SimParameters)}
    for name, override in overrides.items():
        if name in described:
            _check(name, override.value, defaults[name], described[name])
        elif not (node.has_parameter(name) or name.startswith(_OF_RCLPY)):
            close = difflib.get_close_matches(name, described, n=1)
            hint = f"; did you mean {close[0]}?" if close else ""
            message = f"parameter {name}: no such parameter{hint}"
            raise NodeError(message)
    values = {}
    for name, default in defaults.items():
        values[name] = node.declare_parameter(name, default, _descriptor(described[name])).value
    settings = SimParameters(**values)
    if problem := settings.problem():
        message = f"parameter {problem}"
        raise NodeError(message)
    return settings


def changed(settings: SimParameters, parameters: Iterable[Parameter]) -> SimParameters:
    """Settings with some parameters changed together, as a running node is asked for.

    Raises
    ------
    NodeError
        If one of them, or all of them together, cannot be; then none of them counts.
    """
    described = {declared.name: declared.metadata for declared in fields(SimParameters)}
    wanted = {parameter.name: parameter.value for parameter in parameters if parameter.name in described}
    for name, value in wanted.items():
        _check(name, value, getattr(settings, name), described[name])
    directory = wanted.get("record_directory", settings.record_directory)
    if directory != settings.record_directory and not _is_confined(directory):
        message = f"parameter record_directory: {directory!r}: expected one below the working directory"
        raise NodeError(message)
    new = replace(settings, **wanted)
    if problem := new.problem():
        message = f"parameter {problem}"
        raise NodeError(message)
    return new


def _check(name: str, value: Any, default: Any, described: Mapping[str, Any]) -> None:  # noqa: ANN401
    problem = ""
    if type(value) is not type(default):
        wanted = _TYPE_NAMES[type(default)]
        problem = f"expected {wanted}"
        if isinstance(default, float) and type(value) is int:
            problem += f", write {value}.0"
    elif described["choices"] and value not in described["choices"]:
        problem = f"expected one of {', '.join(described['choices'])}"
    elif described["limits"] and not described["limits"][0] <= value <= described["limits"][1]:
        problem = "expected a number from {:g} to {:g}".format(*described["limits"])
    if problem:
        message = f"parameter {name}: {value!r}: {problem}"
        raise NodeError(message)


def _is_confined(directory: str) -> bool:
    """Whether a path that any peer on the graph can have set stays below the working directory."""
    path = Path(directory)
    if path.is_absolute() or ".." in path.parts or not directory.isprintable():
        return False
    try:
        return path.resolve().is_relative_to(Path.cwd().resolve())
    except (OSError, RuntimeError):  # a loop of symlinks, or no working directory any more
        return False


def _descriptor(described: Mapping[str, Any]) -> ParameterDescriptor:
    descriptor = ParameterDescriptor(description=described["description"], read_only=not described["dynamic"])
    if described["limits"]:
        low, high = described["limits"]
        if isinstance(low, int):
            descriptor.integer_range = [IntegerRange(from_value=low, to_value=high, step=1)]
        else:
            descriptor.floating_point_range = [FloatingPointRange(from_value=low, to_value=high)]
    if described["choices"]:
        descriptor.additional_constraints = f"one of {', '.join(described['choices'])}"
    return descriptor
