"""Sweeps on the two worker processes of a cluster: equal results, interrupted, with a worker killed."""

import signal
import subprocess
import sys
import time
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import psutil
import pytest

from yawdamp_ros.cli import run

if TYPE_CHECKING:
    from collections.abc import Iterator

    from distributed import LocalCluster

pytestmark = pytest.mark.skipif(find_spec("distributed") is None, reason="needs distributed, an extra")

OPTIONS = ["--range", "units.1.mass=5000:30000", "--measure", "critical_speed"]


@pytest.fixture(scope="module")
def cluster() -> "Iterator[LocalCluster]":
    import distributed  # noqa: PLC0415 - an extra

    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, protocol="tcp://", host="127.0.0.1", dashboard_address=None
    ) as cluster:
        yield cluster


def sweep(points: int, output: Path, *more: str) -> list[str]:
    return ["sweep", "--random", str(points), *OPTIONS, "--output", str(output), *more]


def rows(path: Path) -> np.ndarray:
    return np.genfromtxt(path, delimiter=",", skip_header=1)


@pytest.fixture(scope="module")
def here(tmp_path_factory: pytest.TempPathFactory) -> np.ndarray:
    output = tmp_path_factory.mktemp("here") / "x.csv"
    assert run(sweep(2500, output)) == 0
    return rows(output)


def begun(output: Path, cluster: "LocalCluster") -> subprocess.Popen[str]:
    command = [sys.executable, "-m", "yawdamp_ros", *sweep(2500, output)]
    process = subprocess.Popen(
        [*command, "--scheduler", cluster.scheduler_address],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    while not (output.exists() and output.read_text().count("\n") > 1):
        assert process.poll() is None
        time.sleep(0.02)
    return process


def test_an_interrupted_sweep_goes_on_and_gives_what_one_process_gives(
    cluster: "LocalCluster", here: np.ndarray, tmp_path: Path
) -> None:
    output = tmp_path / "x.csv"
    with begun(output, cluster) as process:
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=60)
    assert (process.returncode, errors) == (130, "python -m yawdamp_ros sweep: interrupted\n")
    written = output.read_text()
    assert 500 <= written.count("\n") - 1 < 2500
    assert run(sweep(2500, output, "--scheduler", cluster.scheduler_address)) == 0
    assert output.read_text().startswith(written)
    np.testing.assert_allclose(rows(output), here, rtol=1e-9)


def test_a_killed_worker_is_survived(cluster: "LocalCluster", here: np.ndarray, tmp_path: Path) -> None:
    output = tmp_path / "x.csv"
    with begun(output, cluster) as process:
        psutil.Process(next(iter(cluster.workers.values())).pid).kill()
        _, errors = process.communicate(timeout=100)
    assert (process.returncode, errors) == (0, "")
    np.testing.assert_allclose(rows(output), here, rtol=1e-9)
