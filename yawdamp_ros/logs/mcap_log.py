"""Recorded messages, from a bare MCAP or from a rosbag2 directory of several, finished or cut off."""

import re
from collections.abc import Iterator
from contextlib import redirect_stderr
from dataclasses import replace
from io import BytesIO, StringIO
from pathlib import Path
from typing import Any, NamedTuple

from lz4.frame import LZ4FrameFile
from mcap.records import Attachment, Channel, Chunk, Header, McapRecord, Message, Metadata, Schema
from mcap.stream_reader import StreamReader, breakup_chunk
from mcap_ros2.decoder import DecoderFactory
from zstandard import ZstdDecompressor

from yawdamp_ros.errors import one_line
from yawdamp_ros.files import read_text, regular
from yawdamp_ros.logs.errors import LogError
from yawdamp_ros.plain_yaml import parse_yaml

MAGIC = b"\x89MCAP0\r\n"
LARGEST_RECORD = 1 << 30
"""Largest record [bytes]; a longer one counts as a corrupt length."""

LARGEST_CHUNK = 1 << 28
"""Largest decompressed chunk [bytes]; writers close one after some megabytes."""

MOST_EXPANSION = 100
"""Largest ratio of decompressed to file size, beyond `LARGEST_CHUNK`."""

LARGEST_METADATA = 1 << 20
"""Largest metadata.yaml in characters."""

LARGEST_DEFINITION = 1 << 16
"""Largest message definition with every dependency, without comments [bytes]."""


class RecordedMessage(NamedTuple):
    """A message as a file holds it.

    Attributes
    ----------
    file : Path
    topic : str
    type_name : str
        Message type, as in ``sensor_msgs/msg/Imu``.
    log_time : int
        Time of logging [ns].
    data : bytes
    schema : Schema
        Definition, as in the file.
    message_encoding : str

    Examples
    --------
    >>> from pathlib import Path
    >>> from yawdamp_ros.logs import McapLog
    >>> message = next(McapLog(Path("steering_run")).messages())
    >>> message.type_name, message.log_time
    ('std_msgs/msg/Float64', 0)
    """

    file: Path
    topic: str
    type_name: str
    log_time: int
    data: bytes
    schema: Schema
    message_encoding: str


class McapLog:
    """Messages of a recording, file by file, in the order in which they were written.

    Parameters
    ----------
    path : Path
        An MCAP file, or a rosbag2 directory with or without its metadata.yaml.

    Attributes
    ----------
    attachments : dict of str to bytes
        Attachments by name; reading `messages` fills this and the following attributes.
    metadata : dict of str to dict
        Metadata by name.
    warning : str
        Place at which a file ends early, and the consequence; else empty.

    Raises
    ------
    LogError
        If there is nothing to be read.

    Examples
    --------
    >>> from pathlib import Path
    >>> from yawdamp_ros.logs import McapLog
    >>> [message.topic for message in McapLog(Path("steering_run")).messages()]
    ['/steering']
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
            with regular(path).open("rb") as stream:
                _check_magic(stream.read(len(MAGIC)), path)
                stream.seek(0)
                reader = _Reader(
                    stream, emit_chunks=True, validate_crcs=True, record_size_limit=LARGEST_RECORD
                )
                try:
                    for record in _unpacked(reader.records, path.stat().st_size):
                        if isinstance(record, Message):
                            channel = channels[record.channel_id]
                            schema = schemas[channel.schema_id]
                            yield RecordedMessage(
                                path,
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
                except OSError:
                    raise
                except Exception as error:  # noqa: BLE001 - whatever bytes make the libraries raise
                    reason = str(error).partition("\n")[0] or "it ends in the middle"
                    self.warning = one_line(f"{path}: unfinished or damaged, read up to there: {reason}")
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
    """Decoder of messages by the definitions beside them; no message package is needed.

    Examples
    --------
    >>> from pathlib import Path
    >>> from yawdamp_ros.logs import McapLog, MessageDecoder
    >>> decode = MessageDecoder()
    >>> [decode(message).data for message in McapLog(Path("steering_run")).messages()]
    [0.02]
    """

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
                self._decoders[key] = _decoder(message)
            decoded = self._decoders[key] and self._decoders[key](_Whole(message.data))
        except Exception as error:  # the library may raise anything for bad bytes or definitions
            raise LogError(
                message.file, f"{message.topic}: message at {message.log_time} ns is no {message.type_name}"
            ) from error
        if decoded is None:
            raise LogError(
                message.file,
                f"{message.topic}: {message.schema.encoding} in {message.message_encoding}: "
                "expected ros2msg in cdr",
            )
        return decoded


class _Reader(StreamReader):
    """Reader that stops at zeros, as a machine's crash leaves them: they would be empty records."""

    def _read_record(self, opcode: int, length: int) -> McapRecord | None:
        if opcode == 0:
            message = "zeros in place of a record"
            raise ValueError(message)
        return super()._read_record(opcode, length)


class _Whole(bytes):
    """Bytes that refuse a slice beyond their end, so that a definition cannot ask for more than there is.

    The library's numbers refuse that by themselves; its arrays of bytes would be cut short, and a few lines
    that nest them make billions of values out of nothing.
    """

    def __getitem__(self, key: Any) -> Any:  # noqa: ANN401 - an index or a slice
        if isinstance(key, slice) and key.stop is not None and key.stop > len(self):
            message = "beyond the end of the message"
            raise IndexError(message)
        return super().__getitem__(key)


def _decoder(message: RecordedMessage) -> Any:  # noqa: ANN401 - made from the definition
    # Comments have no meaning here, and the library's time grows with the square of their length.
    text = re.sub(rb"#.*", b"", message.schema.data)
    if len(text) > LARGEST_DEFINITION:
        reason = "longer than a message definition"
        raise ValueError(reason)
    with redirect_stderr(StringIO()):  # the library also prints the errors that it raises
        return DecoderFactory().decoder_for(message.message_encoding, replace(message.schema, data=text))


def _unpacked(records: Iterator[McapRecord], size: int) -> Iterator[McapRecord]:
    """Records of a file of some size, those of its chunks in their place."""
    left = LARGEST_CHUNK + MOST_EXPANSION * size
    for record in records:
        if isinstance(record, Chunk):
            left -= record.uncompressed_size
            if record.uncompressed_size > LARGEST_CHUNK or left < 0:
                message = f"a chunk of {record.uncompressed_size} bytes once decompressed, more than is read"
                raise ValueError(message)
            yield from breakup_chunk(_decompressed(record), validate_crc=True)
        else:
            yield record


def _decompressed(chunk: Chunk) -> Chunk:
    """Chunk without compression, within a limit: the library trusts any length that a frame claims."""
    if chunk.compression not in {"zstd", "lz4"}:
        return chunk
    source = BytesIO(chunk.data)
    frames = ZstdDecompressor().stream_reader(source) if chunk.compression == "zstd" else LZ4FrameFile(source)
    data = frames.read(chunk.uncompressed_size + 1)
    if len(data) != chunk.uncompressed_size:
        message = f"a chunk that is not of the {chunk.uncompressed_size} bytes it claims"
        raise ValueError(message)
    return replace(chunk, compression="", data=data)


def is_recording(path: Path) -> bool:
    """Return whether a path is a rosbag2 directory or an MCAP file, rather than text.

    Parameters
    ----------
    path : Path

    Returns
    -------
    bool

    Raises
    ------
    LogError
        If the file cannot be read.

    Examples
    --------
    >>> from pathlib import Path
    >>> from yawdamp_ros.logs import is_recording
    >>> is_recording(Path("steering_run")), is_recording(Path("steering_run") / "metadata.yaml")
    (True, False)
    """
    if path.is_dir():
        return True
    try:
        with regular(path).open("rb") as stream:
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
        information = parse_yaml(read_text(metadata, LARGEST_METADATA), LARGEST_METADATA)[
            "rosbag2_bagfile_information"
        ]
        storage, names = information["storage_identifier"], information["relative_file_paths"]
        mode = str(information.get("compression_mode") or "").upper()
        # The last part of each path: a run is read from its own directory. A file listed twice is read once.
        files = list(dict.fromkeys(directory / Path(name).name for name in names))
    except OSError as error:
        raise LogError(metadata, f"cannot be read: {error.strerror}") from error
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise LogError(metadata, "not the metadata of a rosbag2 recording") from error
    if mode == "MESSAGE":
        raise LogError(
            metadata,
            "compression_mode MESSAGE: expected messages that are not compressed each by itself; "
            "ros2 bag convert writes them so",
        )
    if storage != "mcap" or any(file.suffix != ".mcap" for file in files):
        raise LogError(metadata, f"storage {storage!r}: expected uncompressed files of storage 'mcap'")
    if not files:
        raise LogError(metadata, "lists no file")
    return files
