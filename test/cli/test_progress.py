"""What a person sees at a terminal, and a pipe does not."""

import os
import pty
import subprocess
import sys
from pathlib import Path


def test_a_progress_bar_is_for_terminals(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "yawdamp_ros", "simulate", "--manoeuvre", "step", "--duration", "20"]
    terminal, theirs = pty.openpty()
    with subprocess.Popen([*command, "--output", str(tmp_path / "a.csv")], stderr=theirs, stdout=theirs):
        os.close(theirs)
        shown = b""
        while True:
            try:
                shown += os.read(terminal, 65536)
            except OSError:  # the other side has closed
                break
    os.close(terminal)
    assert b"simulating" in shown
    assert b"/ 20.0 s" in shown
    piped = subprocess.run(
        [*command, "--output", str(tmp_path / "b.csv")], capture_output=True, check=True, text=True
    )
    assert piped.stderr == ""
    assert "\x1b" not in piped.stdout
    assert "simulating" not in piped.stdout
    assert "lateral acceleration [m/s²]" in piped.stdout
