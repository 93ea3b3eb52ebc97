"""Declaring, checking and changing the parameters of the simulator node."""

import difflib
from array import array
from collections.abc import Iterable, Mapping
from dataclasses import Field, replace
from pathlib import Path
from typing import Any

from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
from rclpy.node import Node
from rclpy.parameter import Parameter

from yawdamp_ros.nodes.errors import NodeError
from yawdamp_ros.simulation.settings import FORMER_NAMES, FORMER_VALUES, PARAMETERS, SimParameters
from yawdamp_ros.simulation.steering_messages import AUTOWARE_CONTROL

DEEPEST_DIRECTORY = 32
"""Largest number of parts of a recording path that a peer may set."""
_TYPE_NAMES = {
    bool: "true or false",
    int: "an integer",
    float: "a double",
    str: "a string",
    list: "a list",
}
_OF_RCLPY = ("use_sim_time", "qos_overrides.", "start_type_description_service")


def declare_parameters(node: Node) -> SimParameters:
    """Declare every parameter on a node and read the given values.

    Parameters
    ----------
    node : Node
        Made with ``automatically_declare_parameters_from_overrides``: a parameter that was given and that
        nobody declares must not be ignored.

    Returns
    -------
    SimParameters

    Raises
    ------
    NodeError
        If a value has the wrong type or is out of range, or there is no such parameter.
    """
    given = _given(node)
    for name, value in given.items():
        _check(name, value)
    if namespace := node.get_namespace().strip("/"):
        given.setdefault("frame_prefix", f"{namespace}/")
    if given.get("autoware"):
        given.setdefault("steering_type", AUTOWARE_CONTROL)
        given.setdefault("longitudinal_source", "steering")
    settings = SimParameters(**{PARAMETERS[name].name: value for name, value in given.items()})
    if problem := settings.problem():
        message = f"parameter {problem}"
        raise NodeError(message)
    for name, declared in PARAMETERS.items():
        value = getattr(settings, declared.name)
        if value is not None:
            node.declare_parameter(name, value, parameter_descriptor(declared))
    return settings


def declare_derived(node: Node, values: Mapping[str, Any]) -> None:
    """Declare omitted parameters that follow from others, so that they show the values in force.

    Parameters
    ----------
    node : Node
    values : mapping of str to object
        Values in force, by name.
    """
    for name, value in values.items():
        if not node.has_parameter(name):
            node.declare_parameter(name, value, parameter_descriptor(PARAMETERS[name]))


def changed(settings: SimParameters, parameters: Iterable[Parameter]) -> SimParameters:
    """Settings with some parameters changed together, as in a request to a running node.

    Parameters
    ----------
    settings : SimParameters
    parameters : iterable of Parameter
        Parameters; those with other names are left to rclpy.

    Returns
    -------
    SimParameters

    Raises
    ------
    NodeError
        If one of them, or their combination, is invalid; then none of them is applied.
    """
    wanted = {parameter.name: parameter.value for parameter in parameters if parameter.name in PARAMETERS}
    for name, value in wanted.items():
        _check(name, value)
    source = wanted.get("longitudinal_source", settings.longitudinal_source)
    if source != "parameter" and "speed" in wanted:
        message = f"parameter speed: follows the topic {source}, as longitudinal_source says; publish there"
        raise NodeError(message)
    directory = wanted.get("record_directory", settings.record_directory)
    if directory != settings.record_directory and not _is_confined(directory):
        message = f"parameter record_directory: {directory!r}: expected one below the working directory"
        raise NodeError(message)
    new = replace(settings, **{PARAMETERS[name].name: value for name, value in wanted.items()})
    if problem := new.problem():
        message = f"parameter {problem}"
        raise NodeError(message)
    return new


def parameter_descriptor(declared: Field[Any]) -> ParameterDescriptor:
    """Descriptor with the range, the choices and whether it is read-only, as `ros2 param describe` shows it.

    Parameters
    ----------
    declared : Field
        One of `PARAMETERS`.

    Returns
    -------
    ParameterDescriptor
    """
    described = declared.metadata
    descriptor = ParameterDescriptor(
        description=described["description"],
        additional_constraints=described["constraint"],
        read_only=not described["dynamic"],
    )
    if described["limits"]:
        low, high = described["limits"]
        if described["kind"] is int:
            descriptor.integer_range = [IntegerRange(from_value=low, to_value=high, step=1)]
        else:
            descriptor.floating_point_range = [FloatingPointRange(from_value=low, to_value=high)]
    if described["choices"]:
        descriptor.additional_constraints = f"one of {', '.join(described['choices'])}"
    return descriptor


def _given(node: Node) -> dict[str, Any]:
    """Return given values by present names, and undeclare them."""
    given = {}
    for name, parameter in node.get_parameters_by_prefix("").items():
        if name == "use_sim_time" and not isinstance(parameter.value, bool):
            message = f"parameter {name}: {parameter.value!r}: expected {_TYPE_NAMES[bool]}"
            raise NodeError(message)
        if name.startswith(_OF_RCLPY):
            continue
        new = FORMER_NAMES.get(name, name)
        if new not in PARAMETERS:
            close = difflib.get_close_matches(name, PARAMETERS, n=1)
            hint = f"; did you mean {close[0]}?" if close else ""
            message = f"parameter {name}: no such parameter{hint}"
            raise NodeError(message)
        node.undeclare_parameter(name)
        if new in given:
            message = f"parameter {name}: {new} is given as well; expected one of the two"
            raise NodeError(message)
        if new != name:
            node.get_logger().warning(f"parameter {name}: renamed to {new}; this release accepts both")
        value = list(parameter.value) if isinstance(parameter.value, array) else parameter.value
        given[new] = FORMER_VALUES.get((name, str(value)), value)
    return given


def _check(name: str, value: Any) -> None:  # noqa: ANN401 - of any type that a parameter has
    declared = PARAMETERS[name]
    described: Mapping[str, Any] = declared.metadata
    kind: type = described["kind"]
    problem = ""
    default = getattr(SimParameters(), declared.name)
    mixed = kind is list and {type(item) for item in value or []} - {type(default[0])}
    if type(value) is not kind or mixed:
        problem = f"expected {_TYPE_NAMES[kind]}"
        if kind is list:
            problem += f" of {'doubles' if isinstance(default[0], float) else 'strings'}"
        if kind is float and type(value) is int:
            problem += f", write {value}.0"
    elif described["choices"] and value not in described["choices"]:
        problem = f"expected one of {', '.join(described['choices'])}"
    elif described["limits"] and not described["limits"][0] <= value <= described["limits"][1]:
        problem = "expected a number from {:g} to {:g}".format(*described["limits"])
        if described["constraint"]:
            problem += f"; {described['constraint']}"
        if described["otherwise"]:
            problem += f"; leave it out for {described['otherwise']}"
    if problem:
        message = f"parameter {name}: {value!r}: {problem}"
        raise NodeError(message)


def _is_confined(directory: str) -> bool:
    """Return whether a path, which any peer may have set, stays below the working directory."""
    path = Path(directory)
    if path.is_absolute() or ".." in path.parts or not directory.isprintable():
        return False
    # A run has a name of its own; empty is the default's.
    if directory and not 0 < len(path.parts) <= DEEPEST_DIRECTORY:
        return False
    try:
        return path.resolve().is_relative_to(Path.cwd().resolve())
    except (OSError, RuntimeError):  # a loop of symlinks, or no working directory any more
        return False
