import resource
import signal
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path

import pytest
from mcap.exceptions import EndOfFile
from mcap.reader import make_reader
from mcap.records import DataEnd, Message
from mcap.stream_reader import StreamReader
from mcap_ros2.decoder import DecoderFactory
from rosbags.highlevel import AnyReader
from ruamel.yaml import YAML

from yawdamp_ros.logs import LogError
from yawdamp_ros.runs import (
    BackgroundWriter,
    Channel,
    RunWriter,
    default_run_directory,
    make_run_directory,
)

FLOAT64 = "std_msgs/msg/Float64"
NAMES = ("steering", "yaw")
CHANNELS = {"steering": Channel("/steering", FLOAT64), "yaw": Channel("/truck/yaw", FLOAT64)}
ONE = b"\x00\x01\x00\x00" + bytes(6) + b"\xf0\x3f"  # 1.0 in little-endian CDR


def writer_in(directory: Path) -> RunWriter:
    return RunWriter(
        make_run_directory(directory, numbered=False),
        CHANNELS,
        {"vehicle.yaml": "name: x\n"},
        {"yawdamp_ros": {"speed": "20.0"}},
    )


@pytest.fixture
def run(tmp_path: Path) -> Path:
    writer = writer_in(tmp_path / "run")
    messages = [(NAMES[index % 2], 5_000_000_000 + index * 1_000_000, ONE) for index in range(1000)]
    for begin in range(0, 1000, 50):
        writer.write(messages[begin : begin + 50])
    writer.close()
    return tmp_path / "run"


def test_rosbags_opens_it_and_reads_every_message(run: Path) -> None:
    with AnyReader([run]) as reader:
        assert reader.duration == 999_000_001
        messages = [
            (connection.topic, time, reader.deserialize(data, connection.msgtype).data)
            for connection, time, data in reader.messages()
        ]
    assert len(messages) == 1000
    assert messages[0] == ("/steering", 5_000_000_000, 1.0)
    assert messages[-1] == ("/truck/yaw", 5_999_000_000, 1.0)


def test_the_bare_file_is_complete_too(run: Path) -> None:
    with AnyReader([run / "run_0.mcap"]) as reader:
        assert sum(1 for _ in reader.messages()) == 1000


def test_the_mcap_reader_finds_checksums_indexes_and_what_explains_the_run(run: Path) -> None:
    with (run / "run_0.mcap").open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()], validate_crcs=True)
        assert reader.get_header().profile == "ros2"
        summary = reader.get_summary()
        assert summary is not None
        assert summary.statistics is not None
        assert summary.statistics.message_count == 1000
        assert all(index.compression == "zstd" for index in summary.chunk_indexes)
        assert {schema.encoding for schema in summary.schemas.values()} == {"ros2msg"}
        assert [attachment.name for attachment in reader.iter_attachments()] == ["vehicle.yaml"]
        assert {record.name for record in reader.iter_metadata()} == {"yawdamp_ros", "rosbag2"}
        values = {decoded.data for _, _, _, decoded in reader.iter_decoded_messages()}
    assert values == {1.0}
    with (run / "run_0.mcap").open("rb") as file:
        data_end = next(record for record in StreamReader(file).records if isinstance(record, DataEnd))
    assert data_end.data_section_crc != 0


def test_channels_carry_the_profile_that_metadata_yaml_carries(run: Path) -> None:
    yaml = YAML(typ="safe", pure=True)
    information = yaml.load(run / "metadata.yaml")["rosbag2_bagfile_information"]
    assert information["version"] == 9
    with (run / "run_0.mcap").open("rb") as file:
        summary = make_reader(file).get_summary()
    assert summary is not None
    channels = {channel.topic: channel for channel in summary.channels.values()}
    for entry in information["topics_with_message_count"]:
        topic = entry["topic_metadata"]
        offered = yaml.load(channels[topic["name"]].metadata["offered_qos_profiles"])
        assert offered == topic["offered_qos_profiles"]
        assert len(offered[0]) == 9
        assert topic["type_description_hash"].startswith("RIHS01_")
        assert entry["message_count"] == 500


def test_a_latched_channel_carries_its_own_profile_in_the_file_and_beside_it(tmp_path: Path) -> None:
    yaml = YAML(typ="safe", pure=True)
    directory = make_run_directory(tmp_path / "run", numbered=False)
    channels = {**CHANNELS, "mode": Channel("/mode", FLOAT64, latched=True)}
    RunWriter(directory, channels, {}, {}).close()
    with (directory / "run_0.mcap").open("rb") as file:
        reader = make_reader(file)
        summary, records = reader.get_summary(), {entry.name: entry for entry in reader.iter_metadata()}
    assert summary is not None
    durability = {
        channel.topic: yaml.load(channel.metadata["offered_qos_profiles"])[0]["durability"]
        for channel in summary.channels.values()
    }
    assert durability == {"/steering": "volatile", "/truck/yaw": "volatile", "/mode": "transient_local"}
    inside = yaml.load(records["rosbag2"].metadata["serialized_metadata"])
    assert yaml.load(directory / "metadata.yaml") == {"rosbag2_bagfile_information": inside}


def test_a_directory_that_exists_is_none_for_a_run(tmp_path: Path) -> None:
    (tmp_path / "run").mkdir()
    with pytest.raises(LogError, match="run: cannot be recorded to: File exists"):
        make_run_directory(tmp_path / "run", numbered=False)


def test_a_run_is_never_written_over(tmp_path: Path) -> None:
    writer_in(tmp_path / "run").close()
    before = (tmp_path / "run" / "run_0.mcap").read_bytes()
    with pytest.raises(LogError, match="run: cannot be recorded to: File exists"):
        RunWriter(tmp_path / "run", CHANNELS, {}, {})
    assert (tmp_path / "run" / "run_0.mcap").read_bytes() == before


def test_a_place_that_cannot_be_written_is_named(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(LogError, match="file/run: cannot be recorded to: Not a directory"):
        writer_in(tmp_path / "file" / "run")


def test_what_was_flushed_survives_a_kill(tmp_path: Path) -> None:
    writer = writer_in(tmp_path / "run")
    writer.write([(NAMES[0], index, ONE) for index in range(100)])
    writer.flush()
    with (tmp_path / "run" / "run_0.mcap").open("rb") as file:
        records = StreamReader(file).records
        kept: list[Message] = []
        with suppress(EndOfFile):  # the file has no end yet
            kept.extend(record for record in records if isinstance(record, Message))
    assert len(kept) == 100
    writer.close()


def test_directories_of_runs_that_start_at_once_never_coincide(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    wanted = default_run_directory("interlink")
    with ThreadPoolExecutor(8) as pool:
        made = list(pool.map(lambda _: make_run_directory(wanted, numbered=True), range(64)))
    assert len(set(made)) == 64
    assert wanted in made
    assert all(path.parts[0] == "runs" and "interlink" in path.name and path.is_dir() for path in made)


def test_a_number_does_not_make_a_place_writable(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(LogError, match="file/run: cannot be recorded to: Not a directory"):
        make_run_directory(tmp_path / "file" / "run", numbered=True)


@pytest.fixture
def small_disk() -> Iterator[None]:
    """A limit on file sizes, which fails as a full disk does."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, before[1]))
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, before)
    signal.signal(signal.SIGXFSZ, handler)


@pytest.mark.usefixtures("small_disk")
def test_a_full_disk_is_counted_and_does_not_stop_whoever_writes(tmp_path: Path) -> None:
    background = BackgroundWriter(writer_in(tmp_path / "run"))
    noise = [index.to_bytes(8, "little") * 16 for index in range(20_000)]
    for index, data in enumerate(noise):
        background.offer([(NAMES[0], index, data)])
    background.close()
    assert background.failure is not None
    assert "cannot be recorded to" in str(background.failure)
    assert 0 < background.lost <= len(noise)


def test_the_background_writer_loses_nothing_in_good_order(tmp_path: Path) -> None:
    background = BackgroundWriter(writer_in(tmp_path / "run"))
    for index in range(5000):
        background.offer([(NAMES[index % 2], index, ONE)])
    background.close()
    assert (background.failure, background.lost) == (None, 0)
    with AnyReader([tmp_path / "run"]) as reader:
        assert [time for _, time, _ in reader.messages()] == list(range(5000))
