"""Files that mean no good, and what a command may make of them."""

import io
import json
import struct
import zlib
from collections.abc import Iterable, Mapping, Sequence
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

from hypothesis import strategies as st
from mcap.reader import make_reader
from mcap.writer import CompressionType, Writer

from yawdamp_ros.cli import run

METADATA_NAME = "yawdamp_ros"
LONGEST_ANSWER = 12_000
"""Characters on standard error: a thousand and what names the command, each written out at worst."""

NASTY = (
    b"\0",
    b"\xff",
    b"\n",
    b'"',
    b"'",
    b",",
    b"\x1b[2J",
    b"\xef\xbb\xbf",
    b"\xed\xa0\x80",
    b"1e400",
    b"-0.0",
    b".nan",
    b".inf",
    b"0x1F",
    b"1_000",
    b"017",
    b"0o17",
    b"2012-02-30",
    b"yes",
    b"null",
    b"nan",
    b"9" * 5000,
    b"\xff" * 8,
    b"&a [*a, *a]",
    b"*a",
    b"!!python/object/apply:os.system [touch executed]",
    b"!!int ''",
    b"!!bool maybe",
    b"? [1]\n: 2\n",
    b"<<: *a\n",
    b"[" * 200,
    b"{a: " * 200,
)
"""What readers trip over, put anywhere."""


@st.composite
def damaged(draw: st.DrawFn, whole: bytes) -> bytes:
    """A valid file with a few things done to it."""
    data = bytearray(whole)
    for _ in range(draw(st.integers(1, 6))):
        start = draw(st.integers(0, len(data)))
        end = draw(st.integers(start, min(len(data), start + 64)))
        what = draw(st.sampled_from(("cut", "overwrite", "insert", "delete", "repeat", "bit")))
        if what == "cut":
            del data[start:]
        elif what == "overwrite":
            data[start:end] = draw(st.binary(min_size=end - start, max_size=end - start))
        elif what == "insert":
            data[start:start] = draw(st.sampled_from(NASTY))
        elif what == "delete":
            del data[start:end]
        elif what == "repeat":
            data[start:start] = data[start:end] * draw(st.integers(1, 50))
        elif data:
            data[start % len(data)] ^= 1 << draw(st.integers(0, 7))
    return bytes(data)


def answer(*arguments: str | Path) -> tuple[int, str]:
    """Exit status and standard error of a command, run in this process."""
    errors = io.StringIO()
    with redirect_stderr(errors), redirect_stdout(io.StringIO()):
        status = run([str(argument) for argument in arguments])
    return status, errors.getvalue()


def refusal(*arguments: str | Path) -> str:
    """The one line with which a command refuses a file, the first of the arguments that is a path."""
    status, errors = answer(*arguments)
    assert status == 2, errors
    return checked(errors, _named(arguments))


def accepted_or_refused(*arguments: str | Path, statuses: Iterable[int] = (0,)) -> bool:
    """Whether a command takes a file; if it does not, it says so in one line that names it."""
    status, errors = answer(*arguments)
    if status != 2:
        assert status in statuses
        assert all(line.startswith("warning: ") for line in errors.splitlines())
        return True
    checked(errors, _named(arguments))
    return False


def _named(arguments: Sequence[str | Path]) -> str:
    return next((str(argument) for argument in arguments if isinstance(argument, Path)), "")


def checked(errors: str, named: str) -> str:
    """Standard error, once it is held to be one line of bounded length that names a file."""
    lines = [line for line in errors.split("\n") if not line.startswith("warning: ")]
    assert len(lines) == 2, errors[:2000]
    assert lines[1] == ""
    assert lines[0].isprintable()
    assert named in lines[0]
    assert len(errors) < LONGEST_ANSWER
    assert "Traceback" not in errors
    return lines[0]


FLOAT64 = ("std_msgs/msg/Float64", b"float64 data\n")
CDR = b"\0\1\0\0"


def recording(  # noqa: PLR0913 - each is one thing that can be wrong with it
    messages: Sequence[tuple[int, bytes]],
    *,
    schema: tuple[str, bytes] = FLOAT64,
    topic: str = "/steering",
    attachments: Mapping[str, bytes] | None = None,
    metadata: Mapping[str, Mapping[str, str]] | None = None,
    compression: CompressionType = CompressionType.ZSTD,
) -> bytes:
    """An MCAP file of one topic, its messages given as log time and bytes."""
    stream = io.BytesIO()
    writer = Writer(stream, compression=compression)
    writer.start(profile="ros2")
    for name, data in (attachments or {}).items():
        writer.add_attachment(0, 0, name, "text/plain", data)
    for name, record in (metadata or {}).items():
        writer.add_metadata(name, dict(record))
    schema_id = writer.register_schema(schema[0], "ros2msg", schema[1])
    channel = writer.register_channel(topic, "cdr", schema_id)
    for time, data in messages:
        writer.add_message(channel, time, data, time)
    writer.finish()
    return stream.getvalue()


def float64(value: float) -> bytes:
    """A Float64 in CDR."""
    return CDR + struct.pack("<d", value)


def steering_recording(count: int = 20, compression: CompressionType = CompressionType.ZSTD) -> bytes:
    """A valid steering log as MCAP."""
    return recording(
        [(index * 10_000_000, float64(0.01 * index)) for index in range(count)], compression=compression
    )


def record(opcode: int, content: bytes, length: int | None = None) -> bytes:
    """An MCAP record, its length as it is or as it claims to be."""
    return struct.pack("<BQ", opcode, len(content) if length is None else length) + content


def prefixed(text: str | bytes) -> bytes:
    """A string as MCAP records hold it."""
    data = text.encode() if isinstance(text, str) else text
    return struct.pack("<I", len(data)) + data


def chunk(data: bytes, *, size: int, compression: str = "zstd", crc: int | None = 0) -> bytes:
    """A chunk record of compressed data that claims a size."""
    found = zlib.crc32(data) if crc is None else crc
    content = struct.pack("<QQQI", 0, 0, size, found) + prefixed(compression)
    return record(6, content + struct.pack("<Q", len(data)) + data)


HEADER = b"\x89MCAP0\r\n" + record(1, prefixed("ros2") + prefixed(""))


def rewritten(
    run_file: Path, target: Path, changes: Mapping[str, str | None], data: Mapping[str, bytes] | None = None
) -> Path:
    """A copy of a recorded run whose metadata or messages say something else; None leaves an entry out."""
    with run_file.open("rb") as file, target.open("wb") as output:
        reader, writer = make_reader(file), Writer(output)
        writer.start(profile="ros2")
        for attachment in reader.iter_attachments():
            text = changes.get(attachment.name, attachment.data.decode())
            writer.add_attachment(0, 0, attachment.name, "text/plain", (text or "").encode())
        for entry in reader.iter_metadata():
            changed = {**entry.metadata, **changes} if entry.name == METADATA_NAME else entry.metadata
            writer.add_metadata(entry.name, {key: text for key, text in changed.items() if text is not None})
        channels: dict[int, int] = {}
        for schema, channel, message in reader.iter_messages(log_time_order=False):
            assert schema is not None
            if channel.id not in channels:
                schema_id = writer.register_schema(schema.name, schema.encoding, schema.data)
                channels[channel.id] = writer.register_channel(channel.topic, "cdr", schema_id)
            content = (data or {}).get(channel.topic, message.data)
            writer.add_message(channels[channel.id], message.log_time, content, message.publish_time)
        writer.finish()
    return target


def run_metadata(run_file: Path) -> dict[str, str]:
    """What a recorded run says of itself."""
    with run_file.open("rb") as file:
        return next(
            dict(entry.metadata) for entry in make_reader(file).iter_metadata() if entry.name == METADATA_NAME
        )


def changed_json(text: str, **changes: object) -> str:
    """A JSON object with some of its members changed."""
    return json.dumps({**json.loads(text), **changes})
