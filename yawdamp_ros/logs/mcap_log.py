"""Recorded messages, from a bare MCAP or from a rosbag2 directory of several, finished or cut off."""

import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from mcap.exceptions import McapError
from mcap.records import Attachment, Channel, Header, Message, Metadata, Schema
from mcap.stream_reader import StreamReader
from mcap_ros2.decoder import DecoderFactory
from ruamel.yaml import YAML
from ruamel.yaml.error import YAMLError
from zstandard import ZstdError

from yawdamp_ros.logs.errors import LogError

MAGIC = b"\x89MCAP0\r\n"
LARGEST_RECORD = 1 << 30
"""Bytes; a longer record is taken for a broken length."""

# What the MCAP library and its decoders raise on bytes that are not what they should be.
BROKEN = (
    McapError,
    ZstdError,
    struct.error,
    ValueError,
    KeyError,
    IndexError,
    TypeError,
    OverflowError,
    MemoryError,
    RuntimeError,
)


class RecordedMessage(NamedTuple):
    """A message as it lies in a file.

    Attributes
    ----------
    topic : str
    type_name : str
        As in ``sensor_msgs/msg/Imu``.
    log_time : int
        In ns.
    data : bytes
    schema : Schema
        Definition, as in the file.
    message_encoding : str
    """

    topic: str
    type_name: str
    log_time: int
    data: bytes
    schema: Schema
    message_encoding: str


class McapLog:
    """The messages of a recording, file by file, in the order in which they were written.

    Parameters
    ----------
    path : Path
        An MCAP file, or a rosbag2 directory with or without its metadata.yaml.

    Attributes
    ----------
    attachments : dict of str to bytes
        By name; filled as `messages` is read, as are the others.
    metadata : dict of str to dict
        By name.
    warning : str
        Where a file ends before its time, and what that means; else empty.

    Raises
    ------
    LogError
        If there is nothing to be read.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.attachments: dict[str, bytes] = {}
        self.metadata: dict[str, dict[str, str]] = {}
        self.warning = ""
        self._files = _bag_files(path) if path.is_dir() else [path]

    def messages(self) -> Iterator[RecordedMessage]:
        """Every message that can be read.

        Raises
        ------
        LogError
            If a file is no MCAP of ROS 2 messages.
        """
        for file in self._files:
            yield from self._messages_of(file)

    def _messages_of(self, path: Path) -> Iterator[RecordedMessage]:
        schemas: dict[int, Schema] = {}
        channels: dict[int, Channel] = {}
        try:
            with path.open("rb") as stream:
                _check_magic(stream.read(len(MAGIC)), path)
                stream.seek(0)
                reader = StreamReader(stream, validate_crcs=True, record_size_limit=LARGEST_RECORD)
                try:
                    for record in reader.records:
                        if isinstance(record, Message):
                            channel = channels[record.channel_id]
                            schema = schemas[channel.schema_id]
                            yield RecordedMessage(
                                channel.topic,
                                schema.name,
                                record.log_time,
                                record.data,
                                schema,
                                channel.message_encoding,
                            )
                        elif isinstance(record, Schema):
                            schemas[record.id] = record
                        elif isinstance(record, Channel):
                            channels[record.id] = record
                        else:
                            self._keep(record, path)
                except LogError:
                    raise
                except BROKEN as error:
                    reason = str(error).splitlines()[0] if str(error) else "it ends in the middle"
                    self.warning = f"{path}: unfinished or damaged, read up to there: {reason}"
        except OSError as error:
            raise LogError(path, f"cannot be read: {error.strerror}") from error

    def _keep(self, record: object, path: Path) -> None:
        if isinstance(record, Header):
            if record.profile != "ros2":
                raise LogError(path, f"profile {record.profile!r}: expected an MCAP of profile 'ros2'")
        elif isinstance(record, Attachment):
            self.attachments[record.name] = record.data
        elif isinstance(record, Metadata):
            self.metadata[record.name] = record.metadata


class MessageDecoder:
    """Decodes messages by the definitions that lie beside them; nothing need be installed."""

    def __init__(self) -> None:
        self._decoders: dict[tuple[str, bytes], Any] = {}

    def __call__(self, message: RecordedMessage) -> Any:  # noqa: ANN401 - made from the definition
        """Message with its fields as attributes.

        Raises
        ------
        LogError
            If it does not fit its definition.
        """
        key = (message.type_name, message.schema.data)
        try:
            if key not in self._decoders:
                self._decoders[key] = DecoderFactory().decoder_for(message.message_encoding, message.schema)
            decoded = self._decoders[key] and self._decoders[key](message.data)
        except BROKEN as error:
            raise LogError(
                message.topic, f"message at {message.log_time} ns is no {message.type_name}"
            ) from error
        if decoded is None:
            raise LogError(
                message.topic,
                f"{message.schema.encoding} in {message.message_encoding}: expected ros2msg in cdr",
            )
        return decoded


def is_recording(path: Path) -> bool:
    """Whether a path is a rosbag2 directory or an MCAP file, rather than text."""
    if path.is_dir():
        return True
    try:
        with path.open("rb") as stream:
            return path.suffix == ".mcap" or stream.read(len(MAGIC)) == MAGIC
    except OSError as error:
        raise LogError(path, f"cannot be read: {error.strerror}") from error


def _check_magic(start: bytes, path: Path) -> None:
    if not start:
        raise LogError(path, "empty; expected an MCAP file")
    if start != MAGIC:
        raise LogError(path, "not an MCAP file")


def _bag_files(directory: Path) -> list[Path]:
    metadata = directory / "metadata.yaml"
    if not metadata.is_file():
        files = sorted(directory.glob("*.mcap"))
        if not files:
            raise LogError(directory, "neither metadata.yaml nor an .mcap in it; expected a recording")
        return files
    try:
        information = YAML(typ="safe", pure=True).load(metadata.read_text(encoding="utf-8"))[
            "rosbag2_bagfile_information"
        ]
        storage, names = information["storage_identifier"], information["relative_file_paths"]
        files = [directory / Path(name).name for name in names]
    except OSError as error:
        raise LogError(metadata, f"cannot be read: {error.strerror}") from error
    except (YAMLError, ValueError, KeyError, TypeError, RecursionError) as error:
        raise LogError(metadata, "not the metadata of a rosbag2 recording") from error
    if storage != "mcap" or any(file.suffix != ".mcap" for file in files):
        raise LogError(metadata, f"storage {storage!r}: expected uncompressed files of storage 'mcap'")
    if not files:
        raise LogError(metadata, "lists no file")
    return files
