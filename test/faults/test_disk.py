import resource
import shutil
import struct
import subprocess
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mcap.exceptions import EndOfFile
from mcap.records import Message
from mcap.stream_reader import StreamReader
from sensor_msgs.msg import Imu
from std_srvs.srv import SetBool

from graph import Graph, outcome, stop, until, values
from runs import PERIOD, recorded, run_directory, simulated_times
from yawdamp_ros.cli import run
from yawdamp_ros.logs import LogError, McapLog
from yawdamp_ros.runs import RunWriter, make_run_directory

pytestmark = pytest.mark.graph

OUTPUTS = 17
"""Messages of a sample of the interlink."""


def record(graph: Graph, *, wanted: bool) -> Any:  # noqa: ANN401 - a generated message
    return graph.call("/yawdamp_sim/record", SetBool, SetBool.Request(data=wanted))


def more_samples(graph: Graph, count: int) -> None:
    before = len(graph.received["/truck/imu"])
    until(lambda: len(graph.received["/truck/imu"]) >= before + count, f"{count} samples more")


def kept(path: Path) -> list[int]:
    """Times of the truck's samples that can be read, alike by this project and by MCAP's own reader."""
    ours = simulated_times(path)
    theirs = 0
    (file,) = path.glob("*.mcap")
    with file.open("rb") as stream, suppress(EndOfFile, struct.error):  # it ends in the middle
        for one in StreamReader(stream, validate_crcs=True).records:
            theirs += isinstance(one, Message)
    assert theirs == len(list(McapLog(path).messages()))
    return ours


def start_time(path: Path) -> int:
    """Stamp of the node's first sample by the stamps in force when a recording began [ns]."""
    log = McapLog(path)
    next(log.messages())  # the metadata comes before it
    return int(log.metadata["yawdamp_ros"]["start_time_ns"])


def started(graph: Graph, *arguments: str) -> Any:  # noqa: ANN401 - a process
    graph.listen({"/truck/imu": Imu})
    process = graph.command("sim", *arguments)
    more_samples(graph, 20)
    return process


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A disk of 100 KiB."""
    place = tmp_path / "disk"
    place.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=100k", "tmpfs", str(place)]
    if subprocess.run(mount, capture_output=True, check=False).returncode:
        pytest.skip("nothing can be mounted here")
    yield place
    subprocess.run(["umount", "--lazy", str(place)], check=True)


def test_what_a_full_disk_loses_is_counted_and_a_recording_begins_anew(graph: Graph) -> None:
    process = started(graph)
    statuses = graph.statuses()
    first = run_directory(graph.directory)
    no_more = (100_000, resource.RLIM_INFINITY)  # lets a file grow no more, as a full disk does
    resource.prlimit(process.pid, resource.RLIMIT_FSIZE, no_more)
    until(lambda: values(statuses("recorder"))["state"] == "failed", "the failure")
    assert statuses("recorder").level == b"\2"
    more_samples(graph, 30)
    resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
    answer = record(graph, wanted=True)
    assert answer.success
    assert answer.message.startswith("recording: runs/")
    until(lambda: statuses("recorder").level == b"\0", "good order again")
    more_samples(graph, 30)
    lost = int(values(statuses("recorder"))["messages_lost"])
    status, _, errors = stop(process)
    assert status == 1
    assert "messages not recorded, the simulation goes on" in errors
    assert "Traceback" not in errors
    second = graph.directory / answer.message.removeprefix("recording: ")
    assert run(["resimulate", str(second)]) == 0
    before, after = kept(first), kept(second)
    # Counted in samples, for stamps jump where the node was late.
    published = (after[0] - start_time(second) - before[0] + start_time(first)) // PERIOD
    assert np.diff(before).tolist() == [PERIOD] * (len(before) - 1)
    # Every message is in the file or counted, those that were under way when it failed for certain.
    missing = OUTPUTS * (published - len(before))
    assert missing <= lost <= missing + OUTPUTS * 60


def test_a_disk_that_fills_midway_leaves_what_fitted(graph: Graph, small_disk: Path) -> None:
    process = started(graph, "--manoeuvre", "chirp", "--output", str(small_disk / "run"))
    statuses = graph.statuses()
    until(lambda: "No space left on device" in statuses("recorder").message, "the failure")
    assert statuses("recorder").level == b"\2"
    assert graph.set_parameter("/yawdamp_sim", "record_directory", "rescue").successful
    assert record(graph, wanted=True).message == "recording: rescue"
    more_samples(graph, 30)
    assert stop(process)[0] == 1
    assert np.diff(kept(small_disk / "run")).tolist() == [PERIOD] * (len(kept(small_disk / "run")) - 1)
    assert len(kept(small_disk / "run")) > 10
    assert run(["resimulate", str(small_disk / "run")]) == 0
    assert run(["resimulate", str(graph.directory / "rescue")]) == 0


def test_a_run_that_is_removed_midway_is_a_failure_and_not_written_on_in_silence(graph: Graph) -> None:
    process = started(graph)
    statuses = graph.statuses()
    shutil.rmtree(run_directory(graph.directory))
    until(lambda: "was removed while it was written" in statuses("recorder").message, "the failure")
    assert statuses("recorder").level == b"\2"
    assert int(values(statuses("recorder"))["messages_lost"]) > OUTPUTS * 20
    assert record(graph, wanted=True).success
    more_samples(graph, 30)
    assert stop(process)[0] == 1
    assert run(["resimulate", str(run_directory(graph.directory))]) == 0


def test_a_run_that_is_moved_midway_is_whole_but_for_its_metadata_and_that_is_said(graph: Graph) -> None:
    process = started(graph)
    run_directory(graph.directory).rename(graph.directory / "moved")
    more_samples(graph, 30)
    status, _, errors = stop(process)
    assert status == 1
    assert "cannot be recorded to: No such file or directory; 0 messages not recorded" in errors
    assert run(["resimulate", str(graph.directory / "moved")]) == 0


def test_a_place_that_cannot_be_recorded_to_is_named_with_the_reason(graph: Graph, small_disk: Path) -> None:
    (small_disk / "filler").write_bytes(bytes(100 * 1024))
    (graph.directory / "dangling").symlink_to("nowhere")
    for place, reason in (
        (graph.directory / "dangling", "File exists"),
        (graph.directory / ("n" * 300), "File name too long"),
        (small_disk / "run", "No space left on device"),
    ):
        with pytest.raises(LogError, match=f"{place}: cannot be recorded to: {reason}"):
            RunWriter(make_run_directory(place, numbered=False), {}, {}, {})
    subprocess.run(["mount", "-o", "remount,ro", str(small_disk)], check=True)
    status, _, errors = outcome(graph.command("sim", "--output", str(small_disk / "other")))
    assert (status, errors.count("\n")) == (2, 1)
    assert "other: cannot be recorded to: Read-only file system" in errors


def test_a_recording_that_cannot_start_leaves_the_one_before_it_alone(graph: Graph) -> None:
    process = started(graph, "--output", "run")
    (graph.directory / "file").touch()
    assert graph.set_parameter("/yawdamp_sim", "record_directory", "file/run").successful
    answer = record(graph, wanted=True)
    assert not answer.success
    assert "Not a directory" in answer.message
    more_samples(graph, 30)
    assert stop(process)[0] == 0
    found = [log_time for log_time, _ in recorded(graph.directory / "run")["/truck/imu"]]
    assert len(found) > 50
    assert np.diff(found).tolist() == [PERIOD] * (len(found) - 1)


def test_a_peer_can_have_runs_recorded_below_the_working_directory_only(tmp_path: Path) -> None:
    inside = tmp_path / "inside"
    inside.mkdir()
    (tmp_path / "outside").mkdir()
    (inside / "link").symlink_to(tmp_path / "outside")
    (inside / "loop").symlink_to("loop")
    graph = Graph(inside)
    process = graph.command("sim", "--output", str(tmp_path / "given"))
    before = sorted(tmp_path.rglob("*"))
    for place in (
        str(tmp_path / "outside" / "run"),
        "../run",
        "a/../../run",
        "a/../run",
        "link/run",
        "loop/run",
        "a\nb",
    ):
        answer = graph.set_parameter("/yawdamp_sim", "record_directory", place)
        assert not answer.successful
        assert "expected one below the working directory" in answer.reason
    # What was given at the start stays in force, and other parameters can be set beside it.
    assert graph.set_parameter("/yawdamp_sim", "max_steering_angle", 0.5).successful
    assert record(graph, wanted=True).message == f"recording: {tmp_path / 'given_2'}"
    assert graph.set_parameter("/yawdamp_sim", "record_directory", "a/run").successful
    for name in ("a/run", "a/run_2"):
        assert record(graph, wanted=True).message == f"recording: {name}"
    assert stop(process)[0] == 0
    graph.close()
    new = {path.relative_to(tmp_path) for path in set(tmp_path.rglob("*")) - set(before) if path.is_dir()}
    assert new == {Path(name) for name in ("given", "given_2", "inside/a", "inside/a/run", "inside/a/run_2")}
