"""Standard output that is closed, full or of another encoding, and clocks and numbers at the edge."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from yawdamp_ros.cli import run


def outcome(
    arguments: list[str], tmp_path: Path, redirection: str = "", **environment: str
) -> tuple[int, str, str]:
    done = subprocess.run(
        ["bash", "-c", f'"$0" -m yawdamp_ros "$@" {redirection}', sys.executable, *arguments],
        cwd=tmp_path,
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=False,
    )
    assert "Traceback" not in done.stderr
    assert "Exception ignored" not in done.stderr
    return done.returncode, done.stdout, done.stderr


def test_a_full_output_is_said(tmp_path: Path) -> None:
    status, _, errors = outcome(["urdf"], tmp_path, "> /dev/full")
    assert (status, errors) == (2, "python -m yawdamp_ros urdf: standard output: No space left on device\n")


def test_a_closed_output_goes_nowhere(tmp_path: Path) -> None:
    assert outcome(["urdf"], tmp_path, ">&-") == (0, "", "")
    assert outcome(["urdf", "--vehicle", "nothing"], tmp_path, ">&- 2>&-")[0] == 2


def test_an_encoding_without_a_letter_has_it_escaped(tmp_path: Path) -> None:
    arguments = ["simulate", "--manoeuvre", "step", "--duration", "1", "--output", "run.csv"]
    status, output, errors = outcome(arguments, tmp_path, PYTHONIOENCODING="ascii")
    assert (status, errors.strip()) == (0, "")
    assert "[m/s\\xb2]" in output


@pytest.mark.parametrize("zone", ["XXX+167", "nonsense", ":/dev/null", "A" * 300])
def test_a_run_is_named_in_any_time_zone(zone: str, tmp_path: Path) -> None:
    arguments = ["simulate", "--manoeuvre", "step", "--duration", "0.1"]
    status, _, errors = outcome(arguments, tmp_path, TZ=zone)
    assert (status, errors.strip()) == (0, "")
    assert len(list((tmp_path / "runs").iterdir())) == 1


@pytest.mark.parametrize(
    "arguments, said",
    [
        (["--manoeuvre", "sine", "--duration", "1e308"], "duration: 1e+308: expected a time in s"),
        (["--manoeuvre", "sine", "--frequency", "1e308"], "frequency: 1e+308: expected a number above 0"),
        (["--manoeuvre", "chirp", "--sweep-time", "1e-308"], "sweep_time: 1e-308: expected a number above 0"),
        (["--manoeuvre", "step", "--step-size", "1e300"], "step_size: 1e+300: expected a time in s above 0"),
        (["--manoeuvre", "step", "--duration", "9e8"], "GB free: expected twice as much room"),
    ],
)
def test_numbers_at_the_edge_are_refused(
    arguments: list[str], said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["simulate", *arguments, "--output", str(tmp_path / "run.csv")]) == 2
    captured = capsys.readouterr()
    assert said in captured.err
    assert captured.err.count("\n") == 1
    assert not (tmp_path / "run.csv").exists()
