"""Sweeps on a cluster of worker processes, and the memory that a million points take."""

import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

import psutil
from distributed import LocalCluster

from rows import Row, by_turns

SWEEP = [sys.executable, "-m", "yawdamp_ros", "sweep", "--range", "units.1.mass=5000:30000"]
POINTS = 60_000
"""Points beside which the start of the command, which no worker shortens, counts little."""
FEW, MANY = 100_000, 1_000_000


def of_clusters(directory: Path) -> list[Row]:
    """A sweep by two workers against one, and a long sweep against a short one."""
    parquet = [directory / f"{count}.parquet" for count in (FEW, MANY)]
    few, many = (
        _largest_memory([*SWEEP, "--random", str(count), "--jobs", "1", "--output", str(output)])
        for count, output in zip((FEW, MANY), parquet, strict=True)
    )
    what = f"memory of a sweep of {MANY:,} points into Parquet"
    return [_two_workers(), Row(what, f"{FEW:,} points", [many], [few], "MB", "<= 1.25")]


def _two_workers() -> Row:
    command = [*SWEEP, "--random", str(POINTS), "--measure", "critical_speed", "--scheduler"]
    options = {"threads_per_worker": 1, "protocol": "tcp://", "host": "127.0.0.1", "dashboard_address": None}
    with LocalCluster(n_workers=1, **options) as one, LocalCluster(n_workers=2, **options) as two:
        alone, together = by_turns(
            lambda: _took([*command, one.scheduler_address]),
            lambda: _took([*command, two.scheduler_address]),
            2,
        )
    what = f"a sweep of {POINTS:,} critical speeds by one worker of `dask.distributed`"
    return Row(what, "by two workers", alone, together, "s", ">= 1.8")


def _took(command: Sequence[str]) -> float:
    begin = time.perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # noqa: S603
    return time.perf_counter() - begin


def _largest_memory(command: Sequence[str]) -> float:
    """Largest resident memory in MB that is seen of a command."""
    largest = 0
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:  # noqa: S603
        probe = psutil.Process(process.pid)
        while process.poll() is None:
            try:
                largest = max(largest, probe.memory_info().rss)
            except psutil.NoSuchProcess:
                break
            time.sleep(0.02)
    return largest / 1e6
