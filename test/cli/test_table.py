"""Tables at a terminal of 80 columns, which is where they are read first."""

import os
import pty
import re
import struct
import subprocess
import sys
import termios
from fcntl import ioctl

ENDINGS = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]")


def lines_at(columns: int, *arguments: str) -> list[str]:
    """What a terminal of a width shows of a command."""
    terminal, theirs = pty.openpty()
    ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 50, columns, 0, 0))
    command = [sys.executable, "-m", "yawdamp_ros", *arguments]
    kept = {name: value for name, value in os.environ.items() if name != "COLUMNS"}
    environment = {**kept, "TERM": "xterm"}
    with subprocess.Popen(command, env=environment, stdout=theirs, stderr=subprocess.DEVNULL) as process:
        os.close(theirs)
        shown = b""
        while True:
            try:
                shown += os.read(terminal, 65536)
            except OSError:  # the other side has closed
                break
    os.close(terminal)
    assert process.returncode in {0, 1}
    return ENDINGS.sub("", shown.decode()).split("\r\n")


def test_an_assessment_shows_value_unit_and_verdict_whole() -> None:
    lines = lines_at(80, "assess", "--vehicle", "a_double", "--srt", "0.4")
    assert max(map(len, lines)) <= 80
    shown = "\n".join(lines)
    assert re.search(r"^high_speed_transient_ +1\.018 +m +24\.44 +FAIL +PBS", shown, flags=re.MULTILINE)
    assert re.search(
        r"^yaw_damping_coefficient +0\.3721 +22\.22 +pass +PBS: >= 0\.15 *$", shown, flags=re.MULTILINE
    )
    assert re.search(r"^understeer_gradient +0 +rad/\(m/s2\) +22\.22 +n/a", shown, flags=re.MULTILINE)
    assert "Definitions" not in shown


def test_modes_show_every_number_whole_and_break_names_of_units() -> None:
    lines = lines_at(80, "stability")
    assert max(map(len, lines)) <= 80
    shown = "\n".join(lines)
    assert re.search(r"-1\.8023 \+ 2\.0647i +0\.6576 +2\.7407 +2\.0647 *$", shown, flags=re.MULTILINE)
    assert "0.587 at  135 deg" in shown
    assert "…" not in shown


def test_a_map_that_is_too_wide_comes_in_parts() -> None:
    lines = lines_at(80, "sweep", "--vary", "speed=10:40:4", "--vary", "units.2.mass=5000:40000:12")
    # The distribution below is a sentence, which the terminal wraps.
    assert max(len(line) for line in lines if not line.startswith("largest_real_part, 1/s")) <= 80
    shown = "\n".join(lines)
    assert "…" not in shown
    assert {"5000", "27272.7", "30454.5", "40000"} <= set(shown.split())
    assert sum(line.startswith("40 ") for line in lines) == 2


def test_eigenvalues_over_a_parameter_are_whole() -> None:
    lines = lines_at(80, "stability", "--vehicle", "a_double", "--vary", "speed=10:40:4")
    assert max(map(len, lines)) <= 80
    assert "…" not in "".join(lines)
    assert "-0.5933 + 2.1792i" in "".join(lines)


def test_a_wide_terminal_shows_whole_names_and_levels() -> None:
    shown = "\n".join(lines_at(200, "assess", "--srt", "0.4"))
    assert "PBS: <= 0.6, 0.8, 1.0, 1.2 for levels 1 to 4; RTAC: <= 0.8" in shown
    assert "rearward_amplification_peak_frequency" in shown
