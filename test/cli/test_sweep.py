"""The command `sweep`: what scripts and people read of it, and what an interruption leaves."""

import json
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import psutil
import pytest

from yawdamp_ros import linear_model, load_vehicle
from yawdamp_ros.analysis import MEASURES, least_damping_ratio
from yawdamp_ros.cli import run

REAR_AXLES = "units.0.axles.1.cornering_stiffness,units.0.axles.2.cornering_stiffness"


def answer(capsys: pytest.CaptureFixture[str], *arguments: str) -> dict[str, object]:
    assert run(["sweep", *arguments, "--format", "json"]) == 0
    captured = capsys.readouterr()
    assert captured.err == ""
    return json.loads(captured.out)


def rows(path: Path) -> np.ndarray:
    return np.genfromtxt(path, delimiter=",", skip_header=1)


def test_one_parameter_gives_a_curve_and_its_boundary(capsys: pytest.CaptureFixture[str]) -> None:
    report = answer(capsys, "--vary", f"{REAR_AXLES}=2e5:6e5:5", "--speed", "22.2222")
    assert report["columns"] == [REAR_AXLES, "largest_real_part"]
    assert [row[0] for row in report["rows"]] == [2e5, 3e5, 4e5, 5e5, 6e5]
    (boundary,) = report["stability_boundaries"]
    assert round(boundary["value"], -2) == 244.2e3
    assert (boundary["unstable"], boundary["kind"]) == ("below", "monotonic")
    assert report["fraction_unstable"] == 0.2


def test_two_parameters_give_a_map_and_its_boundary(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    picture, table = tmp_path / "map.svg", tmp_path / "map.csv"
    arguments = [
        *("--vary", f"{REAR_AXLES}=2e5:6e5:5", "--vary", "speed=10:30:4"),
        *("--measure", "least_damping_ratio", "--plot", str(picture), "--output", str(table)),
    ]
    assert run(["sweep", *arguments]) == 0
    text = capsys.readouterr().out
    assert "least_damping_ratio; rows" in text
    assert "boundary of stability: units.0.axles.1.cornering_stiffness (and 1 more) 2" in text
    assert rows(table).shape == (20, 4)
    assert table.read_text().splitlines()[0] == f'"{REAR_AXLES}",speed,largest_real_part,least_damping_ratio'
    assert picture.read_text(encoding="utf-8").lstrip().startswith("<?xml")


def test_loads_are_swept_as_they_are_set(capsys: pytest.CaptureFixture[str]) -> None:
    load = "units.1.load=[{mass: 12000, position: 0}]"
    report = answer(
        capsys,
        *("--vehicle", "truck_trailer", "--set", load, "--speed", "30"),
        *("--vary", "units.1.load.0.position=-3:3:3", "--measure", "least_damping_ratio"),
    )
    for position, _, ratio in report["rows"]:
        loaded = load_vehicle("truck_trailer", [load, f"units.1.load.0.position={position}", "speed=30"])
        assert ratio == pytest.approx(least_damping_ratio(linear_model(loaded)))


def test_random_vehicles_are_told_by_their_distribution(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    drawn = ["--random", "2000", "--range", f"{REAR_AXLES}=1e5:5e5", "--range", "speed=15:30"]
    first = answer(capsys, *drawn)
    assert len(first["rows"]) == 2000
    assert 0.1 < first["fraction_unstable"] < 0.5
    assert answer(capsys, *drawn) == first
    assert answer(capsys, *drawn, "--seed", "1") != first
    assert run(["sweep", *drawn, "--plot", str(tmp_path / "histogram.png")]) == 0
    text = capsys.readouterr().out
    assert f"unstable: {100 * first['fraction_unstable']:.4g} %" in text
    assert "largest_real_part, 1/s: least -" in text


@pytest.mark.parametrize("measure", ["rearward_amplification", "critical_speed"])
def test_what_has_no_value_is_null_in_json_and_nan_in_csv(
    measure: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    output = tmp_path / "x.csv"
    arguments = ["--vary", f"{REAR_AXLES}=2e5:6e5:2", "--measure", measure, "--output", str(output)]
    values = [row[-1] for row in answer(capsys, *arguments)["rows"]]
    assert sum(value is None for value in values) == 1
    assert np.isnan(rows(output)[:, -1]).tolist() == [value is None for value in values]
    assert run(["sweep", *arguments]) == 0
    assert "without a value: 50 %" in capsys.readouterr().out


def test_processes_give_what_one_gives(tmp_path: Path) -> None:
    arguments = ["--random", "120", "--range", "units.1.mass=5000:30000", "--measure", "steady_offtracking"]
    for jobs in ("1", "2"):
        assert run(["sweep", *arguments, "--jobs", jobs, "--output", str(tmp_path / f"{jobs}.csv")]) == 0
    np.testing.assert_allclose(rows(tmp_path / "1.csv"), rows(tmp_path / "2.csv"), rtol=1e-12)


def long_sweep(points: int, output: Path) -> list[str]:
    options = ["--range", "units.1.mass=5000:30000", "--measure", "critical_speed", "--jobs", "2"]
    command = [sys.executable, "-m", "yawdamp_ros", "sweep", "--random", str(points), *options]
    return [*command, "--output", str(output)]


@contextmanager
def under_way(command: list[str], output: Path) -> Iterator[subprocess.Popen[str]]:
    """A sweep that has written its first rows."""
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        while not (output.exists() and output.read_text().count("\n") > 1):
            assert process.poll() is None
            time.sleep(0.02)
        yield process


def test_interrupted_sweep_goes_on_from_its_file(tmp_path: Path) -> None:
    output = tmp_path / "long.csv"
    command = long_sweep(3500, output)
    with under_way(command, output) as process:
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=60)
    assert (process.returncode, errors) == (130, "python -m yawdamp_ros sweep: interrupted\n")
    written = output.read_text()
    assert 500 <= written.count("\n") - 1 < 3500
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=100)
    assert (done.returncode, done.stderr) == (0, "")
    assert output.read_text().startswith(written)
    assert len(rows(output)) == 3500


def test_worker_that_ends_is_one_line_and_leaves_what_is_written(tmp_path: Path) -> None:
    output = tmp_path / "long.csv"
    command = long_sweep(4000, output)
    with under_way(command, output) as process:
        children = psutil.Process(process.pid).children()
        next(child for child in children if "spawn_main" in " ".join(child.cmdline())).kill()
        _, errors = process.communicate(timeout=60)
    assert process.returncode == 2
    assert errors == (
        "python -m yawdamp_ros sweep: a worker process ended before its work did; what is written stands\n"
    )
    assert len(rows(output)) >= 500


def test_a_killed_sweep_leaves_no_worker_behind(tmp_path: Path) -> None:
    output = tmp_path / "long.csv"
    with under_way(long_sweep(4000, output), output) as process:
        workers = psutil.Process(process.pid).children()
        process.kill()
    _, alive = psutil.wait_procs(workers, timeout=60)
    assert alive == []


def test_a_finished_sweep_is_read_from_its_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["--vary", "speed=10:30:3", "--measure", "yaw_damping_coefficient"]
    output = tmp_path / "speeds.csv"
    first = answer(capsys, *arguments, "--output", str(output))
    before = output.stat().st_mtime_ns
    assert answer(capsys, *arguments, "--output", str(output)) == first
    assert output.stat().st_mtime_ns == before


def test_file_of_another_sweep_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    output = str(tmp_path / "speeds.csv")
    assert run(["sweep", "--vary", "speed=10:30:3", "--output", output]) == 0
    capsys.readouterr()
    for other in (["--vary", "speed=10:30:4"], ["--vary", "speed=10:30:3", "--set", "units.1.mass=16000"]):
        assert run(["sweep", *other, "--output", output]) == 2
        captured = capsys.readouterr()
        assert captured.out == ""
        assert captured.err == (
            f"yawdamp sweep: {output}: is there and is not of this sweep; "
            "expected a new name, or the same sweep\n"
        )


@pytest.mark.parametrize(
    "arguments, said",
    [
        ([], "expected either --vary KEY=A:B:N, once or twice, or --random N"),
        (["--vary", "speed=5:35:3", "--random", "5"], "expected either --vary"),
        (["--vary", "speed=5:35:3"] * 3, "--vary: 3 times; expected once or twice"),
        (["--vary", "speed=5:35:3"] * 2, "speed and speed: expected every key once"),
        (["--vary", "speed=5:35"], "speed=5:35: expected KEY=A:B:N"),
        (["--vary", "speed=5:35:3", "--range", "speed=5:35"], "--range: it goes with --random"),
        (["--vary", "speed=5:35:3", "--seed", "1"], "--seed: it goes with --random"),
        (["--vary", "speed=0:35:3"], "speed: 0.0: expected a speed in m/s"),
        (["--vary", "units.7.mass=5:35:3"], "units.7.mass: no such key to set"),
        (["--random", "5"], "--random: expected at least one --range"),
        (["--random", "0", "--range", "speed=5:35"], "--random: 0: expected a whole number, 1 or more"),
        (["--random", "5", "--range", "speed=35:5"], "--range: speed=35:5: expected KEY=A:B, A below B"),
        (["--random", "5", "--range", "speed=5:35", "--seed", "-1"], "--seed: -1: expected a whole number"),
        (["--vary", "speed=5:35:3", "--jobs", "0"], "--jobs: 0: expected a whole number, 1 or more"),
        (["--vary", "speed=5:35:3", "--measure", "comfort"], "argument --measure: invalid choice: 'comfort'"),
        (
            ["--vary", "speed=5:35:3", "--output", "x.txt"],
            "--output: x.txt: expected a name ending in .csv or",
        ),
        (["--vary", "speed=5:35:3", "--plot", "x.gif"], "--plot: x.gif: expected a name ending in .png"),
        (["--vehicle", "a_double", "--model", "published", "--vary", "speed=5:9:2"], "a_double has 4 units"),
        (["--vary", "speed=5:35:3", "--scheduler", "nowhere"], "--scheduler: nowhere: cannot be reached"),
    ],
)
def test_wrong_use_is_one_line_and_status_2(
    arguments: list[str], said: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("distributed")
    monkeypatch.setattr("yawdamp_ros.cli.executors.CONNECT_TIMEOUT", 0.5)
    assert run(["sweep", *arguments]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.count("\n") == 1
    assert said in captured.err


def test_without_dask_the_error_names_the_extra(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    assert run(["sweep", "--vary", "speed=5:35:3", "--scheduler", "tcp://127.0.0.1:1"]) == 2
    assert "pip install 'yawdamp_ros[cluster]'" in capsys.readouterr().err


def test_without_pyarrow_the_error_names_the_extra(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    assert run(["sweep", "--vary", "speed=5:35:3", "--output", "x.parquet"]) == 2
    assert "pip install 'yawdamp_ros[parquet]'" in capsys.readouterr().err


def test_help_lists_every_measure(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        run(["sweep", "--help"])
    text = capsys.readouterr().out
    assert all(name in text for name in MEASURES)
