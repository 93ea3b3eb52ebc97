"""Start of commands, beside Python that imports NumPy."""

import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path

from rows import Row, by_turns

TIMES = 7
NUMPY = [sys.executable, "-c", "import numpy"]
YAWDAMP = [sys.executable, "-m", "yawdamp_ros"]
HELP_LIMIT, COMMAND_LIMIT = "<= 1.7", "<= 6.7"
"""Limits of help and of commands, as multiples of NumPy's import: 0.25 s and 1 s at its 0.15 s."""


def of_commands(directory: Path) -> list[Row]:
    """Help, and commands that do little else than start."""
    log, run = directory / "log.csv", directory / "run"
    log.write_text("time,steering_angle\n0,0\n0.1,0.01\n0.2,0\n")
    simulate = [*YAWDAMP, "simulate", "--log", str(log), "--output"]
    _took([*simulate, str(run)])
    commands = {
        "--help": ([*YAWDAMP, "--help"], HELP_LIMIT),
        "assess --help": ([*YAWDAMP, "assess", "--help"], HELP_LIMIT),
        "show": ([*YAWDAMP, "show"], COMMAND_LIMIT),
        "assess": ([*YAWDAMP, "assess"], COMMAND_LIMIT),
        "simulate": ([*simulate, str(directory / "run.csv")], COMMAND_LIMIT),
        "resimulate": ([*YAWDAMP, "resimulate", str(run)], COMMAND_LIMIT),
        "plot": ([*YAWDAMP, "plot", str(run), "--output", str(directory / "run.png")], COMMAND_LIMIT),
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
