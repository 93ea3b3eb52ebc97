"""How long commands take to start, beside Python that imports NumPy."""

import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path

from rows import Row, by_turns

TIMES = 7
NUMPY = [sys.executable, "-c", "import numpy"]
YAWDAMP = [sys.executable, "-m", "yawdamp_ros"]
OF_HELP, OF_COMMANDS = "<= 1.7", "<= 6.7"
"""Of what NumPy takes, some 0.15 s of an idle machine: 0.25 s and 1 s."""


def of_commands(directory: Path) -> list[Row]:
    """Help, and commands that do little else than start."""
    log, run = directory / "log.csv", directory / "run"
    log.write_text("time,steering_angle\n0,0\n0.1,0.01\n0.2,0\n")
    simulate = [*YAWDAMP, "simulate", "--log", str(log), "--output"]
    _took([*simulate, str(run)])
    commands = {
        "--help": ([*YAWDAMP, "--help"], OF_HELP),
        "assess --help": ([*YAWDAMP, "assess", "--help"], OF_COMMANDS),
        "show": ([*YAWDAMP, "show"], OF_COMMANDS),
        "assess": ([*YAWDAMP, "assess"], OF_COMMANDS),
        "simulate": ([*simulate, str(directory / "run.csv")], OF_COMMANDS),
        "resimulate": ([*YAWDAMP, "resimulate", str(run)], OF_COMMANDS),
        "plot": ([*YAWDAMP, "plot", str(run), "--output", str(directory / "run.png")], OF_COMMANDS),
    }

    def start(command: Sequence[str]) -> Callable[[], float]:
        return lambda: _took(command)

    numpy = '`python -c "import numpy"`'
    return [
        Row(f"`yawdamp {name}`", numpy, *by_turns(start(command), start(NUMPY), TIMES), "s", wanted)
        for name, (command, wanted) in commands.items()
    ]


def _took(command: Sequence[str]) -> float:
    begin = time.perf_counter()
    subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)  # noqa: S603
    return time.perf_counter() - begin
