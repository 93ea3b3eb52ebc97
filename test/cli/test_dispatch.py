import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from yawdamp_ros.cli import run
from yawdamp_ros.cli.dispatch import COMMANDS
from yawdamp_ros.share import share_directory


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_explains_itself_with_an_example(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        run([name, "--help"])
    assert caught.value.code == 0
    text = capsys.readouterr().out
    assert f"usage: yawdamp {name}" in text
    assert "example:" in text


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_is_an_executable_for_ros2_run(name: str) -> None:
    stub = share_directory() / "resource" / "commands" / name
    assert os.access(stub, os.X_OK)


def test_no_command_and_an_unknown_one_say_which_there_are(capsys: pytest.CaptureFixture[str]) -> None:
    assert run([]) == 2
    assert run(["fly"]) == 2
    captured = capsys.readouterr()
    for name in COMMANDS:
        assert name in captured.out
        assert name in captured.err


def test_help_is_status_0(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["--help"]) == 0
    assert "example:" in capsys.readouterr().out


def test_a_reader_that_goes_away_is_no_error() -> None:
    command = [sys.executable, "-m", "yawdamp_ros", "--help"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdout is not None
        process.stdout.close()
        assert process.stderr is not None
        assert b"Traceback" not in process.stderr.read()


def test_an_interrupt_of_offline_work_is_one_line(tmp_path: Path) -> None:
    options = ["--manoeuvre", "sine", "--duration", "36000", "--output", str(tmp_path / "run")]
    with subprocess.Popen(
        [sys.executable, "-m", "yawdamp_ros", "simulate", *options], stderr=subprocess.PIPE, text=True
    ) as process:
        while not (tmp_path / "run").exists():
            assert process.poll() is None
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate()
    assert (process.returncode, errors) == (130, "python -m yawdamp_ros simulate: interrupted\n")
    assert (tmp_path / "run" / "metadata.yaml").is_file()
