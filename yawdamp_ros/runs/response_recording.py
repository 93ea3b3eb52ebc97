"""Recorded runs, read back as arrays."""

import math
from collections import defaultdict
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.logs import LogError, McapLog, MessageDecoder
from yawdamp_ros.runs import outputs
from yawdamp_ros.runs.jumps import JUMP, jump_of
from yawdamp_ros.runs.outputs import EVENTS, FLOAT64
from yawdamp_ros.runs.recorded_vehicle import METADATA_NAME
from yawdamp_ros.runs.response_reader import LARGEST_VALUE
from yawdamp_ros.stepping import Event, Response
from yawdamp_ros.stepping.time_grid import SECOND

ERROR = 2
"""Level of an event with which the motion ends."""
OF_UNITS = ("imu", "odom")
"""Topics of every unit that hold its motion."""


def read_response_recording(path: Path) -> Response:
    """Read a run that the node or `simulate` recorded.

    Parameters
    ----------
    path : Path
        Run directory or its MCAP file; of a truncated one the existing part is read.

    Returns
    -------
    Response
        Its time starts at 0.

    Raises
    ------
    LogError
        If it holds no run.

    Examples
    --------
    >>> import subprocess
    >>> import sys
    >>> command = [sys.executable, "-m", "yawdamp_ros", "simulate", "--manoeuvre", "step", "--duration", "2"]
    >>> _ = subprocess.run([*command, "--output", "run"], capture_output=True, check=True)
    >>> from pathlib import Path
    >>> from yawdamp_ros.runs import read_response_recording
    >>> read_response_recording(Path("run")).yaw.shape
    (201, 3)
    """
    decode = MessageDecoder()
    messages: dict[str, list[Any]] = defaultdict(list)
    scalars: dict[str, list[Any]] = defaultdict(list)
    units: dict[str, None] = {}
    stamps: list[int] = []
    events: list[tuple[int, Any]] = []
    jumped = 0
    log = McapLog(path)
    for message in log.messages():
        prefix, _, name = message.topic.rpartition("/")
        unit = prefix.rpartition("/")[2]
        if name == "joint_states":
            stamps.append(message.log_time - jumped)
            messages[name].append(decode(message))
        elif message.type_name == FLOAT64 and name not in Response.__dataclass_fields__:
            scalars[message.topic].append(decode(message))
        elif name == EVENTS:
            events.append((message.log_time - jumped, decode(message)))
        elif name == JUMP:
            jumped += jump_of(message.data)
        elif name in OF_UNITS:
            units[unit] = None
            messages[f"{unit}/{name}"].append(decode(message))
    if (
        not units
        or not stamps
        or any(f"{unit}/{name}" not in messages for unit in units for name in OF_UNITS)
    ):
        why = f"; {log.warning}" if log.warning else ""
        raise LogError(path, f"no run: expected joint_states, and imu and odom of every unit{why}")
    try:
        response = _response(messages, tuple(units), stamps)
        happened = _events(events, log.metadata.get(METADATA_NAME, {}))
        return replace(
            response,
            extra=_extra(scalars, response),
            events=happened,
            event_times=tuple((stamp - stamps[0]) / SECOND for stamp, _ in events),
        )
    except (AttributeError, TypeError, ValueError, IndexError, OverflowError) as error:
        raise LogError(path, f"no run: its messages hold something else: {error}") from error


def _response(messages: Mapping[str, list[Any]], units: tuple[str, ...], stamps: list[int]) -> Response:
    count = min(map(len, messages.values()))

    def gather(values: Any) -> Any:  # noqa: ANN401 - a column of each unit
        return _bounded([[values(unit, index) for unit in units] for index in range(count)])

    def imu(unit: str, index: int) -> Any:  # noqa: ANN401 - made from the definition in the file
        return messages[f"{unit}/imu"][index]

    def position(unit: str, index: int) -> Any:  # noqa: ANN401
        return messages[f"{unit}/odom"][index].pose.pose.position

    positions = [list(message.position) for message in messages["joint_states"][:count]]
    joints = _bounded(positions)
    return Response(
        unit_names=units,
        time=np.array([(stamp - stamps[0]) / SECOND for stamp in stamps[:count]]),
        steering_angle=joints[:, 0],
        # A quaternion gives a heading only up to whole turns; the heading itself is continuous.
        yaw=np.unwrap(gather(lambda unit, index: _yaw(imu(unit, index).orientation)), axis=0),
        yaw_rate=gather(lambda unit, index: imu(unit, index).angular_velocity.z),
        lateral_acceleration=gather(lambda unit, index: imu(unit, index).linear_acceleration.y),
        articulation=joints[:, 1 : len(units)],
        x=gather(lambda unit, index: position(unit, index).x),
        y=gather(lambda unit, index: position(unit, index).y),
    )


def _events(messages: list[tuple[int, Any]], known: Mapping[str, str]) -> tuple[Event, ...]:
    step, origin = int(known.get("step_ns", "1")), int(known.get("start_time_ns", "0"))
    return tuple(
        Event((stamp - origin) // step, each.name, each.message, final=each.level == ERROR)
        for stamp, each in messages
    )


def _extra(scalars: Mapping[str, list[Any]], response: Response) -> dict[str, FloatArray]:
    """Outputs of one number besides those that every response has."""
    found = {}
    count = len(response.time)
    for output in outputs.OUTPUTS:
        names = output.names(response.unit_names)
        topics = [next((topic for topic in scalars if topic.endswith(f"/{name}")), "") for name in names]
        if output.type_name == FLOAT64 and not hasattr(response, output.name) and all(topics):
            columns = [[message.data for message in scalars[topic][:count]] for topic in topics]
            # A truncated file may end within a sample.
            columns = [column + [math.nan] * (count - len(column)) for column in columns]
            found[output.name] = _bounded(columns).T
    return found


def _bounded(values: list[list[float]]) -> FloatArray:
    array = np.array(values, dtype=np.float64)
    if np.any(np.abs(array) > LARGEST_VALUE):
        message = f"expected numbers within {LARGEST_VALUE:g}"
        raise ValueError(message)
    return array


def _yaw(orientation: Any) -> float:  # noqa: ANN401
    return 2.0 * math.atan2(orientation.z, orientation.w)
