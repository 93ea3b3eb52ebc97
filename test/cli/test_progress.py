"""What a person sees at a terminal, and a pipe does not."""

import os
import pty
import subprocess
import sys
from pathlib import Path


def shown_at_a_terminal(*arguments: str) -> str:
    """What a command shows where its output is a terminal."""
    terminal, theirs = pty.openpty()
    command = [sys.executable, "-m", "yawdamp_ros", *arguments]
    with subprocess.Popen(command, stderr=theirs, stdout=theirs) as process:
        os.close(theirs)
        shown = b""
        while True:
            try:
                shown += os.read(terminal, 65536)
            except OSError:  # the other side has closed
                break
    os.close(terminal)
    assert process.returncode == 0, shown.decode()
    return shown.decode()


def test_a_progress_bar_is_for_terminals(tmp_path: Path) -> None:
    options = ["simulate", "--manoeuvre", "step", "--duration", "20", "--output"]
    shown = shown_at_a_terminal(*options, str(tmp_path / "a.csv"))
    assert "simulating" in shown
    assert "/ 20.0 s" in shown
    piped = subprocess.run(
        [sys.executable, "-m", "yawdamp_ros", *options, str(tmp_path / "b.csv")],
        capture_output=True,
        check=True,
        text=True,
    )
    assert piped.stderr == ""
    assert "\x1b" not in piped.stdout
    assert "simulating" not in piped.stdout
    assert "lateral acceleration [m/s²]" in piped.stdout


def test_a_run_of_unknown_length_has_a_bar_too(tmp_path: Path) -> None:
    options = ["--manoeuvre", "step", "--duration", "5", "--output", str(tmp_path / "run")]
    shown_at_a_terminal("simulate", *options)
    assert "every value is bit-identical" in shown_at_a_terminal("resimulate", str(tmp_path / "run"))
