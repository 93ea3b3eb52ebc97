"""A run on disk that explains itself, the same for the node and for offline runs."""

import json
import math
import platform
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from rclpy.serialization import serialize_message

from yawdamp_ros.runs.encoder import TWISTS, Encoded, message_class
from yawdamp_ros.runs.frames import TF_TYPE, Frames
from yawdamp_ros.runs.jumps import INT64, JUMP
from yawdamp_ros.runs.outputs import EVENTS, FLOAT64
from yawdamp_ros.runs.recorded_vehicle import METADATA_NAME, VEHICLE_FILE
from yawdamp_ros.runs.run_writer import Channel, RunWriter, SerialisedMessage
from yawdamp_ros.runs.sensors import Sensors
from yawdamp_ros.runs.templates import ENCAPSULATION
from yawdamp_ros.simulation import SimParameters
from yawdamp_ros.stepping import AppliedInput, Command, Event, Motion, TimeGrid
from yawdamp_ros.stepping.build import build_of_numerics
from yawdamp_ros.stepping.stamps import Stamps
from yawdamp_ros.vehicle import VehicleSource
from yawdamp_ros.version import VERSION

FRAME_CHANNELS = {"tf": Channel("/tf", TF_TYPE), "tf_static": Channel("/tf_static", TF_TYPE, latched=True)}
"""Topics of frames, whose names are global and are not resolved."""
EVENT_TYPE = "diagnostic_msgs/msg/DiagnosticStatus"
COMMAND = "steering"
"""Topic of the steering commands as received; that of the road wheels is `applied_topic`."""


def applied_topic(input_name: str) -> str:
    """Relative topic of an input as applied."""
    return "steering_applied" if input_name == "steering" else input_name


class Recipe:
    """Everything that a recording of a run holds besides its messages.

    Parameters
    ----------
    motion : Motion
    grid : TimeGrid
    settings : SimParameters
        Settings at the start.
    vehicle : VehicleSource
    stamps : Stamps
        Time stamps of the steps to come.
    types : mapping of str to str
        Message type of every output by relative topic.
    frames : Frames, optional
        Frames of the units, if they are to be recorded.
    sensors : Sensors, optional
        Sensors, whose delay reaches back before a recording.
    resolve : callable, optional
        Function from a relative topic to its fully qualified name.
    """

    def __init__(  # noqa: PLR0913 - each is one part of what explains a run
        self,
        motion: Motion,
        grid: TimeGrid,
        settings: SimParameters,
        vehicle: VehicleSource,
        *,
        stamps: Stamps,
        types: Mapping[str, str],
        frames: Frames | None = None,
        sensors: Sensors | None = None,
        resolve: Callable[[str], str] = "/{}".format,
    ) -> None:
        self._motion, self._grid = motion, grid
        self._vehicle, self._stamps = vehicle, stamps
        self._outputs = {name: Channel(resolve(name), kind) for name, kind in types.items()}
        self._inputs = {
            name: Channel(resolve(applied_topic(name)), input_type(name)) for name in motion.input_names
        }
        self._frames = frames
        self._sensors = sensors
        # Models with the linear quantities alone have no events.
        self._events = {EVENTS: Channel(resolve(EVENTS), EVENT_TYPE)} if motion.quantity_names else {}
        self._jumps = Channel(resolve(JUMP), INT64)
        self._commands = (
            {COMMAND: Channel(resolve(COMMAND), settings.steering_type)}
            if settings.manoeuvre == "none"
            else {}
        )

    def open(self, directory: Path, settings: SimParameters) -> RunWriter:
        """Start a run in a directory from this instant of the motion on, with the present settings.

        Raises
        ------
        LogError
            If the directory cannot be written.
        """
        channels = (
            {JUMP: self._jumps}
            | self._commands
            | self._events
            | {applied_topic(name): self._inputs[name] for name in self._inputs}
        )
        metadata = {METADATA_NAME: self._metadata(settings)}
        attachments = {VEHICLE_FILE: self._vehicle.text}
        if self._frames is None:
            return RunWriter(directory, channels | self._outputs, attachments, metadata)
        writer = RunWriter(directory, channels | self._outputs | FRAME_CHANNELS, attachments, metadata)
        stamp = self._stamps.of(self._motion.step)
        writer.write([("tf_static", stamp, self._frames.fixed(stamp))])
        return writer

    def _metadata(self, settings: SimParameters) -> dict[str, str]:
        motion = self._motion
        # First, because it starts a block: the recording holds the samples that follow.
        initial = dict(motion.snapshot())
        linear = motion.linearise()
        return {
            "vehicle": motion.vehicle.name,
            "vehicle_overrides": json.dumps(self._vehicle.overrides),
            "model": settings.model,
            "speed": repr(motion.speed),
            "step_ns": str(self._grid.step_ns),
            "steps_per_sample": str(self._grid.steps_per_sample),
            "start_time_ns": str(self._stamps.of(0)),
            "input_topics": json.dumps({name: channel.topic for name, channel in self._inputs.items()}),
            "output_topics": json.dumps({name: channel.topic for name, channel in self._outputs.items()}),
            "initial": json.dumps(initial),
            "state_names": json.dumps(motion.state_names),
            "state_matrix": json.dumps(linear.state_matrix.tolist()),
            "input_matrix": json.dumps(linear.input_matrix.tolist()),
            "parameters": json.dumps(
                {name: None if _is_nan(value) else value for name, value in asdict(settings).items()}
            ),
            "twist": TWISTS[0],
            "surge": "true",
            "imu_history": json.dumps([] if self._sensors is None else self._sensors.history),
            "jump_topic": self._jumps.topic,
            "version": VERSION,
            "python": platform.python_version(),
            "build": build_of_numerics(),
        }


class RunFile:
    """Writes encoded samples to a run directory.

    Parameters
    ----------
    writer : RunWriter
    """

    def __init__(self, writer: RunWriter) -> None:
        self._writer = writer

    def write(self, encoded: Encoded) -> None:
        """Append the messages of a sample."""
        self._writer.write(recorded_messages(encoded))

    def tell(self, events: Sequence[tuple[int, Event]]) -> None:
        """Append events, each with its stamp [ns]."""
        self._writer.write(event_messages(events))

    def close(self) -> None:
        """Finish the run."""
        self._writer.close()


def recorded_messages(encoded: Encoded) -> list[SerialisedMessage]:
    """Messages of a sample: commands, inputs and outputs in the order of time."""
    found: list[SerialisedMessage] = []
    before = _before(encoded)
    pending = next(before, None)
    for index, (stamp, messages) in enumerate(zip(encoded.stamps, encoded.messages, strict=True)):
        while pending is not None and pending[1] <= stamp:
            found.append(pending)
            pending = next(before, None)
        found += ((name, stamp, data) for name, data in zip(encoded.names, messages, strict=True))
        if encoded.frames:
            found.append(("tf", stamp, encoded.frames[index]))
    if pending is not None:  # an event that ended the run before its next sample
        found += (each for each in (pending, *before) if each[0] == EVENTS)
    return found


def _before(encoded: Encoded) -> Iterator[SerialisedMessage]:
    """Commands and inputs of a sample, in the order of time."""
    sample = encoded.sample
    if encoded.jump is not None:
        jumped = message_class(INT64)(data=encoded.jump.nanoseconds)
        yield JUMP, encoded.stamp(encoded.jump.step), serialize_message(jumped)
    happened: list[Command | AppliedInput | Event] = [*sample.commands, *sample.inputs, *sample.events]
    if sample.commands or sample.events:
        happened.sort(key=lambda each: each.step)
    for each in happened:
        stamp = encoded.stamp(each.step)
        if isinstance(each, Command):
            message = each.message or message_class(FLOAT64)(data=each.angle)
            yield COMMAND, stamp, _without_tail(message, serialize_message(message))
        elif isinstance(each, Event):
            yield EVENTS, stamp, serialize_message(event_message(each))
        else:
            yield applied_topic(each.name), stamp, serialised_input(each)


def event_messages(events: Sequence[tuple[int, Event]]) -> list[SerialisedMessage]:
    """Messages of events, each with its stamp [ns]."""
    return [(EVENTS, stamp, serialize_message(event_message(event))) for stamp, event in events]


def event_message(event: Event) -> Any:  # noqa: ANN401 - a generated message
    """Message of an event: its name, its place, and an error if it ends the motion.

    Parameters
    ----------
    event : Event

    Returns
    -------
    diagnostic_msgs.msg.DiagnosticStatus

    Examples
    --------
    >>> event_message(Event(10, "wheel_lift", "trailer, axle 1, left")).name
    'wheel_lift'
    """
    kind = message_class(EVENT_TYPE)
    return kind(level=kind.ERROR if event.final else kind.WARN, name=event.name, message=event.where)


def _without_tail(message: Any, data: bytes) -> bytes:  # noqa: ANN401 - a generated message
    """CDR without the bytes that rclpy leaves behind an empty array of doubles at the end.

    Some readers reject them. Of the messages that can hold steering only joint states end so.
    """
    if len(getattr(message, "effort", [0.0])):
        return data
    texts = [message.header.frame_id, *message.name]
    end = 8  # the stamp
    for index, text in enumerate(texts):
        end += -end % 4 + 4 + len(text.encode()) + 1
        if not index:
            end += -end % 4 + 4  # number of names that follow
    for values in (message.position, message.velocity, message.effort):
        end += -end % 4 + 4
        if len(values):
            end += -end % 8 + 8 * len(values)
    return data[: ENCAPSULATION + end]


def input_type(name: str) -> str:
    """Message type in which a run holds an input."""
    return "std_msgs/msg/Empty" if name == "reset" else FLOAT64


def serialised_input(applied: AppliedInput) -> bytes:
    """Message of an applied input in CDR."""
    kind = message_class(input_type(applied.name))
    data: bytes = serialize_message(kind() if applied.name == "reset" else kind(data=applied.value))
    return data


def _is_nan(value: object) -> bool:
    return isinstance(value, float) and math.isnan(value)
