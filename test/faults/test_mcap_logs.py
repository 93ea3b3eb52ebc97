"""MCAP files and rosbag2 directories of every kind that should not be."""

import os
import struct
import subprocess
import sys
import zlib
from pathlib import Path

import pytest
import zstandard
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mcap.writer import CompressionType

from faults.hostile import (
    CDR,
    FLOAT64,
    HEADER,
    accepted_or_refused,
    answer,
    checked,
    chunk,
    damaged,
    float64,
    prefixed,
    record,
    recording,
    refusal,
    steering_recording,
)
from yawdamp_ros.logs import read_steering_mcap

pytestmark = pytest.mark.timeout(60)

LOG = steering_recording()
PLAIN = steering_recording(compression=CompressionType.NONE)
STRANGE = settings(max_examples=100, suppress_health_check=[HealthCheck.function_scoped_fixture])
SCHEMA = record(3, struct.pack("<H", 1) + prefixed(FLOAT64[0]) + prefixed("ros2msg") + prefixed(FLOAT64[1]))
CHANNEL = record(4, struct.pack("<HH", 1, 1) + prefixed("/steering") + prefixed("cdr") + prefixed(""))
JOINT_STATE = "sensor_msgs/msg/JointState"


def message(data: bytes = float64(0.1), time: int = 0, channel: int = 1) -> bytes:
    return record(5, struct.pack("<HIQQ", channel, 0, time, time) + data)


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "log.mcap"


def simulated(file: Path) -> tuple[str | Path, ...]:
    return ("simulate", "--log", file, "--duration", "0.01", "--output", str(file.with_name("out.csv")))


@STRANGE
@given(
    content=st.one_of(damaged(LOG), damaged(PLAIN), st.binary(max_size=300).map(lambda tail: HEADER + tail))
)
def test_a_damaged_log_is_taken_or_refused_in_one_line(file: Path, content: bytes) -> None:
    file.write_bytes(content)
    accepted_or_refused(*simulated(file))


def test_a_log_that_ends_anywhere_is_taken_or_refused_in_one_line(file: Path) -> None:
    whole = recording([(0, float64(0.1)), (10_000_000, float64(0.2))], compression=CompressionType.NONE)
    taken = 0
    for length in range(0, len(whole), 11):
        file.write_bytes(whole[:length])
        taken += accepted_or_refused(*simulated(file))
    assert 0 < taken < len(whole)


@STRANGE
@given(
    schema=damaged(b"std_msgs/Header header\nstring[] name\nfloat64[<=3] position\nuint8[4] x 1 # [m]\n"),
    data=st.binary(max_size=60),
)
def test_any_definition_and_any_bytes_are_read_or_refused_in_one_line(
    file: Path, schema: bytes, data: bytes
) -> None:
    file.write_bytes(recording([(0, CDR + data)], schema=(JOINT_STATE, schema)))
    accepted_or_refused(*simulated(file))
    accepted_or_refused("plot", file, "--output", str(file.with_suffix(".svg")))


@pytest.mark.parametrize(
    "compression",
    [CompressionType.NONE, CompressionType.LZ4, CompressionType.ZSTD],
    ids=lambda kind: kind.name,
)
def test_every_compression_is_read(file: Path, compression: CompressionType) -> None:
    file.write_bytes(steering_recording(compression=compression))
    log = read_steering_mcap(file)
    assert (len(log.angles), log.warning) == (20, "")


def nested(levels: int) -> bytes:
    """A definition each part of which holds two of the next: a few lines that stand for billions of bytes."""
    parts = [b"a/M0 one\n"]
    parts += [
        b"=" * 80 + b"\nMSG: a/M%d\na/M%d one\na/M%d other\n" % (level, level + 1, level + 1)
        for level in range(levels)
    ]
    return b"".join(parts) + b"=" * 80 + b"\nMSG: a/M%d\nuint8[1] x\n" % levels


@pytest.mark.parametrize(
    "schema",
    [
        b"",
        b"\xff\xfe",
        b"float64",
        b"float64 data data data",
        b"float64 1data\n",
        b"float64[ data\n",
        b"float64] data\n",
        b"float64[-1] data\n",
        b"float64[9999999999999] data\n",
        b"uint8[9999999999999] data\n",
        b"string<=x data\n",
        b"wstring data\n",
        b"Nowhere data\n",
        b"std_msgs/Float64 data\n",
        b"float64 data\nfloat64 data\n",
        b"float64 __class__\n",
        b"int32 X=" + b"9" * 5000 + b"\n",
        b"string[] x [" + b"'" * 500 + b"]\n",
        b"a/B[4000000000] x\n" + b"=" * 80 + b"\nMSG: a/B\nuint8[1] x\n",
        nested(40),
        b"float64 x #" + b" " * 1_000_000 + b"\nfloat64 data2\n",
        b"float64 x #" + b"[" * 1_000_000 + b"\nfloat64 data2\n",
        b"".join(b"float64 x%d\n" % index for index in range(100_000)),
        b"=" * 200_000,
        b"MSG: a/B\n" * 5000,
    ],
    ids=range(25),
)
def test_a_definition_that_is_none_is_refused(file: Path, schema: bytes) -> None:
    file.write_bytes(recording([(0, float64(0.1))], schema=(FLOAT64[0], schema)))
    said = refusal(*simulated(file))
    assert "/steering: message" in said
    assert "std_msgs/msg/Float64" in said


@pytest.mark.parametrize(
    "content, said",
    [
        (b"", "empty; expected an MCAP file"),
        (b"\x89MCAP1\r\n", "not an MCAP file"),
        (HEADER, "no steering in it; its topics: none; "),
        (HEADER + record(5, b"", 2**63), "no steering in it"),
        (HEADER + record(3, b"", 2**64 - 1), "no steering in it"),
        (
            HEADER
            + record(9, struct.pack("<QQ", 0, 0) + prefixed("a") + prefixed("b") + struct.pack("<Q", 2**63)),
            "damaged",
        ),
        (
            HEADER
            + record(9, struct.pack("<QQ", 0, 0) + prefixed("a") + prefixed("b") + struct.pack("<Q", 2**40)),
            "damaged",
        ),
        (HEADER + message(), "no steering in it"),
        (HEADER + CHANNEL + message(), "no steering in it"),
        (
            HEADER
            + record(4, struct.pack("<HH", 1, 0) + prefixed("/s") + prefixed("cdr") + prefixed(""))
            + message(),
            "no steering in it",
        ),
        (HEADER + SCHEMA + CHANNEL + message(b""), "/steering: message at 0 ns is no std_msgs/msg/Float64"),
        (HEADER + SCHEMA + CHANNEL + message(time=2**64 - 1), "expected a time that ROS can hold"),
        (HEADER + SCHEMA + CHANNEL + message(float64(1e300)), "1e+300: expected an angle within 10000 rad"),
        (HEADER + SCHEMA + CHANNEL + message() + message(time=2 * 10**18), "it lasts 2e+09 s"),
        (HEADER + SCHEMA.replace(b"ros2msg", b"\x1b[2J\n\0\0"), "damaged"),
        (
            b"\x89MCAP0\r\n" + record(1, prefixed("ros2\x1b[2J\n" * 10_000) + prefixed("")),
            r"profile 'ros2\x1b[2J\n",
        ),
        (HEADER + chunk(b"garbage", size=100), "damaged"),
        (HEADER + chunk(b"garbage", size=100, compression="lz4"), "damaged"),
        (HEADER + chunk(b"garbage", size=2**63), "damaged"),
        (HEADER + chunk(b"garbage", size=7, compression="\x1b[2J\n"), "damaged"),
        (HEADER + chunk(zstandard.compress(SCHEMA), size=len(SCHEMA), crc=1), "crc validation failed"),
        (HEADER + chunk(zstandard.compress(SCHEMA), size=len(SCHEMA) - 1, crc=0), "not of the"),
        (HEADER + chunk(zstandard.compress(bytes(2**24)), size=100), "not of the 100 bytes it claims"),
        (HEADER + chunk(zstandard.compress(bytes(2**24)), size=2**24), "damaged"),
    ],
    ids=range(24),
)
def test_what_is_no_log_is_refused_by_what_is_wrong_with_it(file: Path, content: bytes, said: str) -> None:
    file.write_bytes(content)
    assert said in refusal(*simulated(file))


def test_a_small_file_of_terabytes_is_not_decompressed(file: Path) -> None:
    bomb = chunk(zstandard.compress(bytes(2**24)), size=2**24)
    file.write_bytes(HEADER + bomb * 1000)
    assert len(bomb) < 10_000
    assert "damaged" in refusal(*simulated(file))


def test_messages_before_the_damage_are_taken_with_a_warning(file: Path) -> None:
    data = message(time=1) + message(time=2)
    file.write_bytes(
        HEADER
        + SCHEMA
        + CHANNEL
        + chunk(data, size=len(data), compression="", crc=zlib.crc32(data))
        + b"\x06"
    )
    status, errors = answer(*simulated(file))
    assert status == 0
    assert errors.startswith(f"warning: {file}: unfinished or damaged, read up to there: ")
    assert errors.count("\n") == 1


@pytest.mark.parametrize(
    "names",
    [
        "../secret.mcap",
        "{}/secret.mcap",
        "..",
        ".",
        "",
        "/",
        '"a\\0.mcap"',
        '"\\uD800.mcap"',
        "secret\\n.mcap",
        "3",
        "[a.mcap]",
        "x" * 5000 + ".mcap",
    ],
)
def test_a_bag_reads_no_file_but_its_own(tmp_path: Path, names: str) -> None:
    bag = tmp_path / "bag"
    bag.mkdir()
    (tmp_path / "secret.mcap").write_bytes(LOG)
    (bag / "metadata.yaml").write_text(
        "rosbag2_bagfile_information:\n  storage_identifier: mcap\n"
        f"  relative_file_paths: [{names.format(tmp_path)}]\n"
    )
    for command in (simulated(bag), ("plot", bag), ("resimulate", bag)):
        refusal(*command)
    assert sorted(path.name for path in tmp_path.rglob("*")) == ["bag", "metadata.yaml", "secret.mcap"]


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[" * 100_000,
        "a: &a [*a]\n",
        "rosbag2_bagfile_information: !!python/object/apply:os.system [touch executed]\n",
        "\0",
        "x" * 2_000_000,
        "rosbag2_bagfile_information: {storage_identifier: "
        + "x" * 100_000
        + ", relative_file_paths: [a.mcap]}\n",
        'rosbag2_bagfile_information: {storage_identifier: "\\e[2J\\n", relative_file_paths: [a.mcap]}\n',
    ],
    ids=range(8),
)
def test_metadata_that_is_none_is_refused(tmp_path: Path, text: str) -> None:
    (tmp_path / "metadata.yaml").write_text(text)
    assert "metadata" in refusal(*simulated(tmp_path))
    assert [path.name for path in tmp_path.iterdir()] == ["metadata.yaml"]


def test_what_never_ends_is_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "log.mcap")
    assert "cannot be read: not a regular file" in refusal(*simulated(tmp_path / "log.mcap"))
    assert "cannot be read: not a regular file" in refusal(*simulated(tmp_path))


def test_a_hundred_megabytes_of_nothing_are_refused(file: Path) -> None:
    with file.open("wb") as opened:
        opened.write(HEADER)
        opened.truncate(100_000_000)
    assert "zeros in place of a record" in refusal(*simulated(file))


def test_the_command_itself_refuses_in_one_line(file: Path) -> None:
    file.write_bytes(recording([(0, float64(0.1))], schema=(FLOAT64[0], b"float64")))
    command = [sys.executable, "-m", "yawdamp_ros", *map(str, simulated(file))]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (2, "")
    checked(done.stderr, str(file))
