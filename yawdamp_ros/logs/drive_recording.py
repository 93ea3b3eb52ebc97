"""Drives from recordings: channels by the types and names of topics, decoded by definitions in the file."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple, Protocol

import numpy as np
import numpy.typing as npt

from yawdamp_ros.drives import INPUTS, QUANTITIES, UNITS, Channel, Drive, is_input, quantity_of
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.logs.channel_messages import JOINT_TYPE, MEASURING_TYPES, SCALAR_TYPES, field_names, field_of
from yawdamp_ros.logs.channel_names import Wish, listed, named
from yawdamp_ros.logs.drive_options import DriveOptions
from yawdamp_ros.logs.errors import LogError
from yawdamp_ros.logs.mcap_log import McapLog, MessageDecoder, RecordedMessage
from yawdamp_ros.logs.steering_log import SteeringLog
from yawdamp_ros.logs.steering_mcap import steering_log, steering_topic
from yawdamp_ros.simulation.steering_messages import STEERING_TYPES, message_stamp
from yawdamp_ros.stepping.time_grid import SECOND

LARGEST_SKEW = 5.0
"""Largest difference between a stamp and the time of recording on one clock [s]."""

_HELD_TYPES = {*STEERING_TYPES, *MEASURING_TYPES, *SCALAR_TYPES}


class Log(Protocol):
    """A source of messages."""

    warning: str

    def messages(self) -> Iterator[RecordedMessage]:
        """Every message that can be read."""


JUMP_TOPIC, JUMP_TYPE = "/time_jump", "std_msgs/msg/Int64"
"""Topic and type of the jumps of the time stamps [ns] in a run of the node: each holds from then on."""


class _Place(NamedTuple):
    """Place of a channel: a field of a topic's messages, or a joint."""

    topic: str
    path: str
    scale: float = 1.0


def read_drive_recording(path: Path, options: DriveOptions, log: Log | None = None) -> Drive:
    """Read a drive from an MCAP file or a rosbag2 directory.

    Parameters
    ----------
    path : Path
    options : DriveOptions
    log : Log, optional
        Messages of the log, if another format holds them.

    Returns
    -------
    Drive

    Raises
    ------
    LogError
        If it cannot be read or holds no steering.
    """
    log = McapLog(path) if log is None else log
    wished = {_topic_of(wish.place) for wish in options.wishes}
    found: dict[str, list[RecordedMessage]] = {}
    topics: dict[str, str] = {}
    jumped = 0
    for logged in log.messages():
        if logged.type_name == JUMP_TYPE and logged.topic.endswith(JUMP_TOPIC):
            jumped += int.from_bytes(logged.data[4:12], "little", signed=True)
            continue
        # A run of the node has its own time, whatever jumps its stamps made to follow ROS time.
        message = logged._replace(log_time=logged.log_time - jumped)
        topics[message.topic] = message.type_name
        if message.type_name in _HELD_TYPES or message.topic in wished:
            found.setdefault(message.topic, []).append(message)
    topic = steering_topic(options.topic, topics, path, log.warning)
    steering = steering_log(
        path, topic, found[topic], options.joint, degrees=options.degrees, warning=log.warning
    )
    places = {**_places(topics, found), **_wished_places(options.wishes, topics, path)}
    reader = _Reader(path, steering, stamped=not jumped)
    channels = {"steering": _steering_channel(steering, topic, topics[topic])}
    for each in dict.fromkeys(place.topic for place in places.values()):
        of_topic = {
            name: place
            for name, place in places.items()
            if place.topic == each and (options.measured or is_input(name))
        }
        if of_topic:
            channels |= reader.channels(of_topic, found[each])
    return Drive(str(path), channels, steering.start_time, tuple(reader.notes), log.warning)


def _steering_channel(steering: SteeringLog, topic: str, kind: str) -> Channel:
    return Channel("steering", f"{topic} ({kind})", np.array(steering.times), np.array(steering.angles))


class _Reader:
    """Decodes the messages of topics on the time base of the steering."""

    def __init__(self, path: Path, steering: SteeringLog, *, stamped: bool) -> None:
        self._stamped = stamped
        self.notes: list[str] = []
        self._path = path
        self._start = steering.start_time
        self._decode = MessageDecoder()

    def channels(self, places: Mapping[str, _Place], messages: list[RecordedMessage]) -> dict[str, Channel]:
        """Channels of one topic, by name, each message decoded once."""
        stamps, rows = [], []
        for message in messages:
            decoded = self._decode(message)
            stamps.append(message_stamp(decoded))
            rows.append([self._value(decoded, place, message) for place in places.values()])
        times = self._times(np.array(stamps), np.array([message.log_time for message in messages]))
        order = np.argsort(times, kind="stable")
        channels = {}
        for (name, place), values in zip(places.items(), np.array(rows).T, strict=True):
            good = order[np.isfinite(values[order])]
            if missing := len(values) - len(good):
                self.notes.append(f"{name}: {missing} of {len(values)} values are no numbers")
            if len(good):
                source = f"{place.topic} {place.path} ({messages[0].type_name})"
                channels[name] = Channel(name, source, times[good], place.scale * values[good])
        return channels

    def _value(self, decoded: object, place: _Place, message: RecordedMessage) -> float:
        try:
            joint = place.path.removeprefix("position of ")
            if joint == place.path:
                return field_of(decoded, place.path)
            names = field_names(decoded)
            return field_of(decoded, f"position.{names.index(joint)}")
        except (AttributeError, IndexError, TypeError, ValueError) as error:
            raise LogError(
                self._path, f"{place.topic}: {message.type_name} has no number at {place.path!r}"
            ) from error

    def _times(self, stamps: npt.NDArray[np.int64], logged: npt.NDArray[np.int64]) -> FloatArray:
        skew = float(np.median(np.abs(stamps - logged))) / SECOND
        trusted = self._stamped and bool(stamps.all()) and skew < LARGEST_SKEW
        return ((stamps if trusted else logged) - self._start) / SECOND


def _places(topics: Mapping[str, str], found: Mapping[str, list[RecordedMessage]]) -> dict[str, _Place]:
    """Place of every channel found by names and types, the best first."""
    scalars = _scalars(topics)
    inputs = [(name, place) for name, place in scalars if is_input(name)]
    places: dict[str, _Place] = {}
    for name, place in (*inputs, *_typed(topics), *scalars, *_joints(topics, found)):
        places.setdefault(name, place)
    return places


def _scalars(topics: Mapping[str, str]) -> list[tuple[str, _Place]]:
    told = [(topic, named(topic)) for topic, kind in topics.items() if kind in SCALAR_TYPES]
    return [(name.channel, _Place(topic, "data", UNITS[name.unit][1])) for topic, name in told if name]


def _typed(topics: Mapping[str, str]) -> Iterator[tuple[str, _Place]]:
    for kind, fields in MEASURING_TYPES.items():
        for topic in (name for name, type_name in topics.items() if type_name == kind):
            owner = topic.strip("/").rpartition("/")[0].rpartition("/")[2]
            for field in fields:
                owned = owner and field.quantity not in INPUTS
                name = f"{owner}/{field.quantity}" if owned else field.quantity
                yield name, _Place(topic, field.path)


def _joints(
    topics: Mapping[str, str], found: Mapping[str, list[RecordedMessage]]
) -> Iterator[tuple[str, _Place]]:
    for topic in (name for name, kind in topics.items() if kind == JOINT_TYPE):
        for joint in field_names(MessageDecoder()(found[topic][0])):
            told = named(joint)
            if told and quantity_of(told.channel) == "articulation":
                yield told.channel, _Place(topic, f"position of {joint}")


def _wished_places(wishes: tuple[Wish, ...], topics: Mapping[str, str], path: Path) -> dict[str, _Place]:
    places = {}
    for wish in wishes:
        topic = _topic_of(wish.place)
        if topic not in topics:
            raise LogError(path, f"{topic}: no such topic; expected one of {listed(list(topics))}")
        quantity = quantity_of(wish.channel)
        field = wish.place.removeprefix(topic).removeprefix(".")
        usual = [each.path for each in MEASURING_TYPES.get(topics[topic], ()) if each.quantity == quantity]
        scale = wish.sign * UNITS[wish.unit or QUANTITIES[quantity]][1]
        places[wish.channel] = _Place(topic, field or next(iter(usual), "data"), scale)
    return places


def _topic_of(place: str) -> str:
    return place.partition(".")[0]
