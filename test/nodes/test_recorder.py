from pathlib import Path

import pytest

from yawdamp_ros.logs import LogError, McapLog
from yawdamp_ros.nodes.recorder import Recorder
from yawdamp_ros.nodes.states import RecorderState
from yawdamp_ros.runs import Channel, RunWriter

MESSAGE = ("value", 1_000, bytes(12))


def recorder() -> Recorder:
    def open_run(directory: Path) -> RunWriter:
        return RunWriter(directory, {"value": Channel("/value", "std_msgs/msg/Float64")}, {}, {})

    return Recorder(open_run)


def made(path: Path) -> Path:
    path.mkdir()
    return path


def kept(path: Path) -> int:
    return sum(1 for _ in McapLog(path).messages())


def test_nothing_is_recorded_before_the_start_nor_after_the_stop(tmp_path: Path) -> None:
    one = recorder()
    one.offer([MESSAGE])
    assert (one.state, one.detail) == (RecorderState.IDLE, "not recording")
    one.start(made(tmp_path / "run"))
    assert (one.state, one.detail) == (RecorderState.RECORDING, str(tmp_path / "run"))
    one.offer([MESSAGE, MESSAGE])
    one.stop()
    one.offer([MESSAGE])
    assert (one.state, one.lost, one.failure) == (RecorderState.IDLE, 0, None)
    assert kept(tmp_path / "run") == 2


def test_a_second_start_finishes_the_first_run(tmp_path: Path) -> None:
    one = recorder()
    for name in ("first", "second"):
        one.start(made(tmp_path / name))
        one.offer([MESSAGE])
    assert one.directory == tmp_path / "second"
    assert (tmp_path / "first" / "metadata.yaml").is_file()
    one.stop()
    assert (kept(tmp_path / "first"), kept(tmp_path / "second")) == (1, 1)


def test_a_start_that_fails_leaves_the_run_before_it_going(tmp_path: Path) -> None:
    one = recorder()
    one.start(made(tmp_path / "run"))
    with pytest.raises(LogError, match="cannot be recorded to"):
        one.start(tmp_path / "missing")
    one.offer([MESSAGE])
    assert one.state is RecorderState.RECORDING
    one.stop()
    assert kept(tmp_path / "run") == 1


def test_a_run_that_is_removed_is_a_failure_whose_loss_stays_counted(tmp_path: Path) -> None:
    one = recorder()
    run = made(tmp_path / "run")
    one.start(run)
    one.offer([MESSAGE])
    (run / "run_0.mcap").unlink()
    one.stop()
    assert one.state is RecorderState.FAILED
    assert "cannot be recorded to" in one.detail
    assert one.lost == 1
    one.start(made(tmp_path / "next"))
    assert (one.state, one.lost) == (RecorderState.RECORDING, 1)
    one.stop()
