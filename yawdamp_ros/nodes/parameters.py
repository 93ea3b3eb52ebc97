"""Parameters of the simulator node: declared once, for the node, its help and the README."""

import difflib
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field, fields
from typing import Any

from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor
from rclpy.node import Node

from yawdamp_ros.dynamics import MODELS
from yawdamp_ros.manoeuvres import MANOEUVRES
from yawdamp_ros.nodes.errors import NodeError

UNSET = float("nan")
"""A number that was not given: the manoeuvre's own default counts."""
_TYPE_NAMES = {
    bool: "true or false",
    float: "a double",
    str: "a string",
    list: "a list of strings",
}
_OF_RCLPY = ("use_sim_time", "qos_overrides.", "start_type_description_service")


def _parameter(
    default: object,
    description: str,
    *,
    limits: tuple[float, float] | None = None,
    choices: Iterable[str] = (),
    dynamic: bool = False,
) -> Any:  # noqa: ANN401 - dataclasses.field is typed by its default
    metadata = {"description": description, "limits": limits, "choices": tuple(choices), "dynamic": dynamic}
    if isinstance(default, list):
        return field(default_factory=default.copy, metadata=metadata)
    return field(default=default, metadata=metadata)


# ruff: noqa: RUF009 - each default is a dataclasses.field
@dataclass(frozen=True)
class SimParameters:
    """What the simulator node can be asked for."""

    vehicle: str = _parameter("interlink", "builtin name or path of a vehicle file")
    vehicle_overrides: list[str] = _parameter(
        [""], "changes to the vehicle, each KEY=VALUE as in units.1.mass=4156"
    )
    model: str = _parameter("consistent", "linear model of the vehicle", choices=MODELS)
    speed: float = _parameter(
        0.0, "longitudinal speed in m/s; 0: the vehicle's own", limits=(0.0, 70.0), dynamic=True
    )
    step_size: float = _parameter(0.001, "fixed integration step in s", limits=(1e-6, 1.0))
    publish_rate: float = _parameter(100.0, "samples a second of simulated time, in Hz", limits=(0.1, 1e4))
    publish_scalars: bool = _parameter(
        default=True, description="also publish yaw, yaw_rate and lateral_acceleration as Float64"
    )
    steering_ratio: float = _parameter(
        1.0, "steering command over road-wheel angle; 1: road-wheel commands", limits=(1e-3, 1e3)
    )
    max_steering_angle: float = _parameter(
        0.8, "road-wheel angle in rad past which a command is clamped", limits=(0.0, 1.5)
    )
    steering_timeout: float = _parameter(
        0.5, "silence in s of simulated time after which on_steering_timeout counts", limits=(0.0, 1e6)
    )
    on_steering_timeout: str = _parameter(
        "hold", "after a silence: hold the last command, or zero", choices=("hold", "zero")
    )
    manoeuvre: str = _parameter(
        "none", "steering of the node's own, in place of the topic", choices=("none", *MANOEUVRES)
    )
    amplitude: float = _parameter(UNSET, "of the manoeuvre, rad; nan: its own")
    frequency: float = _parameter(UNSET, "of sine, lane change and chirp, Hz; nan: its own")
    start: float = _parameter(UNSET, "of the manoeuvre, s; nan: its own")
    cycles: float = _parameter(UNSET, "of sine and lane change; 0: endless; nan: its own")
    rise_time: float = _parameter(UNSET, "of the ramp, s; nan: its own")
    width: float = _parameter(UNSET, "of the pulse, s; nan: its own")
    final_frequency: float = _parameter(UNSET, "of the chirp, Hz; nan: its own")
    sweep_time: float = _parameter(UNSET, "of the chirp, s; nan: its own")
    duration: float = _parameter(
        0.0, "simulated time in s after which the node ends; 0: none", limits=(0.0, 1e9)
    )
    record: bool = _parameter(default=True, description="record the run")
    record_directory: str = _parameter(
        "", "directory of the run, which must not exist; empty: runs/<stamp>_<vehicle>"
    )


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
    return SimParameters(**values)


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


def _descriptor(described: Mapping[str, Any]) -> ParameterDescriptor:
    descriptor = ParameterDescriptor(description=described["description"], read_only=not described["dynamic"])
    if described["limits"]:
        low, high = described["limits"]
        descriptor.floating_point_range = [FloatingPointRange(from_value=low, to_value=high)]
    if described["choices"]:
        descriptor.additional_constraints = f"one of {', '.join(described['choices'])}"
    return descriptor
