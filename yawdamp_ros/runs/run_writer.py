"""A run on disk: a rosbag2 directory with one MCAP file that explains itself."""

import errno
import os
import time
from collections.abc import Mapping, Sequence
from contextlib import suppress
from io import BufferedWriter, StringIO
from pathlib import Path
from textwrap import indent
from typing import Any, NamedTuple

from yawdamp_ros.logs import LogError
from yawdamp_ros.runs.message_definitions import MessageDefinition, message_definition

CHUNK_SIZE = 4 * 1024 * 1024
"""Size of a chunk [bytes]. Every chunk has an index entry in memory, so that small ones would fill it."""
QUEUE_DEPTH = 10
"""Queue depth of every publisher, as recorded, and of every subscription."""
_INFINITE = {"sec": 9223372036, "nsec": 854775807}
_QOS = {
    "history": "keep_last",
    "depth": QUEUE_DEPTH,
    "reliability": "reliable",
    "durability": "volatile",
    "deadline": _INFINITE,
    "lifespan": _INFINITE,
    "liveliness": "automatic",
    "liveliness_lease_duration": _INFINITE,
    "avoid_ros_namespace_conventions": False,
}


class Channel(NamedTuple):
    """A topic of a run.

    Attributes
    ----------
    topic : str
        Fully qualified.
    type_name : str
        Message type, as in ``sensor_msgs/msg/Imu``.
    latched : bool
        Whether its last message is for subscribers that come later, too.

    Examples
    --------
    >>> from yawdamp_ros.runs import Channel
    >>> Channel("/steering", "std_msgs/msg/Float64").qos["reliability"]
    'reliable'
    """

    topic: str
    type_name: str
    latched: bool = False

    @property
    def qos(self) -> dict[str, Any]:
        """Profile under which it is offered."""
        return {**_QOS, "durability": "transient_local"} if self.latched else _QOS


SerialisedMessage = tuple[str, int, bytes]
"""Name of its channel, simulated time [ns], and the message in CDR."""


class RunWriter:
    """Writer of a run directory; each call returns when the data is handed to the file.

    Parameters
    ----------
    directory : Path
        Existing empty directory: nothing in it is overwritten.
    channels : mapping of str to Channel
        Channels by the names used in writing messages.
    attachments : mapping of str to str
        Texts by file name, such as the vehicle file.
    metadata : mapping of str to mapping of str to str
        Records by name: what else is needed to explain the run and to run it again.

    Raises
    ------
    LogError
        If the directory cannot be written, here and from every method.

    Examples
    --------
    >>> from pathlib import Path
    >>> from struct import pack
    >>> from yawdamp_ros.runs import Channel, RunWriter, make_run_directory
    >>> directory = make_run_directory(Path("run"), numbered=False)
    >>> writer = RunWriter(directory, {"steering": Channel("/steering", "std_msgs/msg/Float64")}, {}, {})
    >>> writer.write([("steering", 0, bytes([0, 1, 0, 0]) + pack("<d", 0.02))])
    >>> writer.close()
    >>> sorted(path.name for path in directory.iterdir())
    ['metadata.yaml', 'run_0.mcap']
    """

    def __init__(
        self,
        directory: Path,
        channels: Mapping[str, Channel],
        attachments: Mapping[str, str],
        metadata: Mapping[str, Mapping[str, str]],
    ) -> None:
        # Imported here: it loads slowly, and a node is on the graph by now.
        from mcap.writer import CompressionType, Writer  # noqa: PLC0415

        self.directory = directory
        self._channels = dict(channels)
        self._definitions: dict[str, MessageDefinition] = {}
        self._counts = dict.fromkeys(channels, 0)
        self._taken = self._flushed = 0
        self._first_time: int | None = None
        self._last_time = 0
        self._path = directory / f"{directory.name}_0.mcap"
        self._file: BufferedWriter | None = None
        self._failed = False
        try:
            for name, channel in channels.items():
                self._definitions[name] = message_definition(channel.type_name)
            self._file = self._path.open("xb")
            self._writer = Writer(
                self._file,
                chunk_size=CHUNK_SIZE,
                compression=CompressionType.ZSTD,
                enable_data_crcs=True,
            )
            self._writer.start(profile="ros2", library="yawdamp_ros")
            self._register()
            for name, text in attachments.items():
                self._writer.add_attachment(0, 0, name, "text/plain", text.encode())
            for name, record in metadata.items():
                self._writer.add_metadata(name, dict(record))
            self._writer.flush()
        except OSError as error:
            raise self._failure(error) from error

    @property
    def unflushed(self) -> int:
        """Messages since the last flush, which a failure may have lost."""
        return self._taken - self._flushed

    def write(self, messages: Sequence[SerialisedMessage]) -> None:
        """Append messages."""
        self._taken += len(messages)
        add, ids, counts = self._writer.add_message, self._ids, self._counts
        try:
            for channel, log_time, data in messages:
                add(ids[channel], log_time, data, log_time, counts[channel])
                counts[channel] += 1
        except OSError as error:
            raise self._failure(error) from error
        if messages:
            times = [messages[0][1], messages[-1][1]]
            self._first_time = min(times) if self._first_time is None else self._first_time
            self._last_time = max(self._last_time, *times)

    def flush(self) -> None:
        """Flush written data to the operating system, so that a kill does not lose it."""
        try:
            self._writer.flush()
            self._check_place()
        except OSError as error:
            raise self._failure(error) from error
        self._flushed = self._taken

    def close(self) -> None:
        """Finish the file and write metadata.yaml; a file that failed before is not changed."""
        if self._failed:
            return
        try:
            information = _dump_yaml(self._information())
            self._writer.add_metadata("rosbag2", {"serialized_metadata": information})
            self._writer.finish()
            self._check_place()
            self._close_file()
            self._flushed = self._taken
            # The file gets its name when it is complete: readers trust it, and do without if it is missing.
            unfinished = self.directory / "metadata.yaml.unfinished"
            text = f"rosbag2_bagfile_information:\n{indent(information, '  ')}"
            unfinished.write_text(text, encoding="utf-8")
            unfinished.replace(self.directory / "metadata.yaml")
        except OSError as error:
            raise self._failure(error) from error

    def _register(self) -> None:
        schemas: dict[str, int] = {}
        self._ids: dict[str, int] = {}
        # Written once for each of the two: the first message of a node waits for this.
        kinds = {channel.latched: channel.qos for channel in self._channels.values()}
        profiles = {latched: _dump_yaml([qos]) for latched, qos in kinds.items()}
        for name, channel in self._channels.items():
            topic, type_name = channel.topic, channel.type_name
            definition = self._definitions[name]
            if type_name not in schemas:
                schemas[type_name] = self._writer.register_schema(
                    type_name, "ros2msg", definition.text.encode()
                )
            self._ids[name] = self._writer.register_channel(
                topic=topic,
                message_encoding="cdr",
                schema_id=schemas[type_name],
                metadata={
                    "offered_qos_profiles": profiles[channel.latched],
                    "topic_type_hash": definition.type_hash,
                },
            )

    def _information(self) -> dict[str, Any]:
        start = self._first_time or 0
        span = {
            "starting_time": {"nanoseconds_since_epoch": start},
            "duration": {"nanoseconds": max(self._last_time - start, 0)},
            "message_count": sum(self._counts.values()),
        }
        return {
            "version": 9,
            "storage_identifier": "mcap",
            **span,
            "topics_with_message_count": [
                {
                    "topic_metadata": {
                        "name": channel.topic,
                        "type": channel.type_name,
                        "serialization_format": "cdr",
                        "offered_qos_profiles": [channel.qos],
                        "type_description_hash": self._definitions[name].type_hash,
                    },
                    "message_count": self._counts[name],
                }
                for name, channel in self._channels.items()
            ],
            "compression_format": "",
            "compression_mode": "",
            "relative_file_paths": [self._path.name],
            "files": [{"path": self._path.name, **span}],
            "custom_data": None,
            "ros_distro": "jazzy",
        }

    def _check_place(self) -> None:
        # Writing to a removed file succeeds, but keeps nothing.
        if self._file is not None and not os.fstat(self._file.fileno()).st_nlink:
            self._flushed = 0
            raise FileNotFoundError(errno.ENOENT, "the file was removed while it was written")

    def _close_file(self) -> None:
        if self._file is not None:
            self._file.close()

    def _failure(self, error: OSError) -> LogError:
        self._failed = True
        with suppress(OSError):  # flushing the buffer fails again; the descriptor is freed nevertheless
            self._close_file()
        return LogError(self.directory, f"cannot be recorded to: {error.strerror}")


def default_run_directory(vehicle_name: str) -> Path:
    """Return ``runs/<stamp>_<vehicle>`` below the working directory.

    Parameters
    ----------
    vehicle_name : str

    Returns
    -------
    Path

    Examples
    --------
    >>> from yawdamp_ros.runs import default_run_directory
    >>> default_run_directory("interlink").name.endswith("_interlink")
    True
    """
    stamp = time.strftime("%Y%m%d-%H%M%S")  # datetime refuses the offsets of odd time zones
    return Path("runs", f"{stamp}_{vehicle_name}")


def make_run_directory(wanted: Path, *, numbered: bool) -> Path:
    """Make the directory of a run.

    Parameters
    ----------
    wanted : Path
    numbered : bool
        Whether one with a number behind its name will do where that exists.

    Returns
    -------
    Path

    Raises
    ------
    LogError
        If it exists or cannot be made.

    Examples
    --------
    >>> from pathlib import Path
    >>> from yawdamp_ros.runs import make_run_directory
    >>> [make_run_directory(Path("run"), numbered=True).name for _ in range(2)]
    ['run', 'run_2']
    """
    path, repeat = wanted, 1
    while True:
        try:
            # No check before creation: another simulator may create it in between.
            path.mkdir(parents=True)
        except OSError as error:
            if not (numbered and os.path.lexists(path)):
                raise LogError(path, f"cannot be recorded to: {error.strerror}") from error
            repeat += 1
            path = wanted.with_name(f"{wanted.name}_{repeat}")
        else:
            return path


def _dump_yaml(data: object) -> str:
    from ruamel.yaml import YAML  # noqa: PLC0415 - as above

    yaml = YAML(typ="safe", pure=True)
    yaml.default_flow_style = False
    yaml.width = 1000
    # Every reader knows plain YAML; an anchor for a repeated profile is not plain.
    yaml.representer.ignore_aliases = lambda _: True
    stream = StringIO()
    yaml.dump(data, stream)
    return stream.getvalue()
