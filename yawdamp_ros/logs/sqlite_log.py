"""Recorded messages from a rosbag2 directory with sqlite3 storage, by the rosbags package (an extra)."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from mcap.records import Schema

from yawdamp_ros.files import read_text
from yawdamp_ros.logs.errors import LogError
from yawdamp_ros.logs.mcap_log import LARGEST_METADATA, RecordedMessage

LARGEST_MESSAGE = 1 << 24
"""Largest message [bytes]; a longer one is no measurement."""


class SqliteLog:
    """The messages of a recording in the order of their times; an interface like `McapLog`'s.

    Parameters
    ----------
    path : Path
        A rosbag2 directory whose metadata.yaml names the storage sqlite3.

    Attributes
    ----------
    warning : str
        Always empty: SQLite reads a file whole or not at all.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.warning = ""

    def messages(self) -> Iterator[RecordedMessage]:
        """Every message.

        Raises
        ------
        LogError
            If the package rosbags is missing, or it cannot read the recording.
        """
        try:
            from rosbags.rosbag2 import Reader  # noqa: PLC0415 - an extra
        except ImportError as error:
            raise LogError(
                self.path, "sqlite3 storage needs the package rosbags: pip install 'yawdamp_ros[bags]'"
            ) from error
        try:
            with Reader(self.path) as reader:
                schemas = {each.id: _schema(each) for each in reader.connections}
                for connection, log_time, data in reader.messages():
                    if len(data) <= LARGEST_MESSAGE:
                        yield RecordedMessage(
                            self.path,
                            connection.topic,
                            connection.msgtype,
                            log_time,
                            bytes(data),
                            schemas[connection.id],
                            "cdr",
                        )
        except LogError:
            raise
        except Exception as error:  # the libraries may raise anything for bad bytes
            reason = str(error).partition("\n")[0]
            raise LogError(self.path, f"cannot be read: {reason}") from error


def is_sqlite(path: Path) -> bool:
    """Return whether a path is a rosbag2 directory with sqlite3 storage."""
    metadata = path / "metadata.yaml"
    try:
        return path.is_dir() and "storage_identifier: sqlite3" in read_text(metadata, LARGEST_METADATA)
    except (OSError, UnicodeDecodeError):
        return False


def _schema(connection: Any) -> Schema:  # noqa: ANN401 - rosbags' record
    """Definition in the file or, for older files without one, that of ROS 2 Jazzy."""
    from rosbags.interfaces import MessageDefinitionFormat  # noqa: PLC0415
    from rosbags.typesys import Stores, get_typestore  # noqa: PLC0415
    from rosbags.typesys.base import TypesysError  # noqa: PLC0415

    definition, text = connection.msgdef, connection.msgdef.data
    encoding = "ros2idl" if definition.format == MessageDefinitionFormat.IDL else "ros2msg"
    if definition.format == MessageDefinitionFormat.NONE:
        try:
            text, _ = get_typestore(Stores.ROS2_JAZZY).generate_msgdef(connection.msgtype, ros_version=2)
        except (KeyError, TypesysError):
            text, encoding = "", "no definition"
    return Schema(data=text.encode(), encoding=encoding, id=connection.id, name=connection.msgtype)
