"""Parameter files that should not be, as a node gets them: each is refused in one line, and status 2."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from faults.hostile import checked

pytestmark = pytest.mark.timeout(60)

NODE = "yawdamp_sim:\n  ros__parameters:\n"


def refused(path: Path) -> str:
    """What the node says of a parameter file, having started nothing."""
    before = sorted(path.parent.iterdir())
    options = ["--manoeuvre", "sine", "--duration", "0.05", "--ros-args", "--params-file", str(path)]
    # Without shared memory, whose ports all nodes of a machine share: Fast DDS prints that one is in use.
    environment = {**os.environ, "FASTDDS_BUILTIN_TRANSPORTS": "UDPv4"}
    done = subprocess.run(
        [sys.executable, "-m", "yawdamp_ros", "sim", *options],
        capture_output=True,
        text=True,
        check=False,
        cwd=path.parent,
        env=environment,
    )
    assert (done.returncode, done.stdout) == (2, ""), done.stderr
    assert sorted(path.parent.iterdir()) == before
    return checked(done.stderr, "python -m yawdamp_ros sim: ")


@pytest.mark.parametrize(
    "text, said",
    [
        (f"{NODE}    speed: 1.0e+400\n", "parameter speed: "),
        (f"{NODE}    use_sim_time: 3\n", "parameter use_sim_time: 3: expected true or false"),
        (
            f"{NODE}    vehicle_overrides: [true]\n",
            "vehicle_overrides: [True]: expected a list of strings",
        ),
        (f"{NODE}    vehicle: !!python/object/apply:os.system [touch executed]\n", "expected a string"),
        (f"{NODE}    speed: &a 20.0\n    duration: *a\n", "Will not support aliasing at line 4"),
        (f'{NODE}    "a\\nb\\e[2J": 1\n', r"parameter a\nb\x1b[2J: no such parameter"),
        (f"{NODE}    a: " + "{a: " * 20_000, "more than 1000 lists and mappings in brackets"),
        ("\x01}{", "file.yaml'. Error: Error parsing a event near line 0"),
        ("speed: 20.0\n" * 20_000, "file.yaml: cannot be read: longer than 131072 characters"),
    ],
    ids=range(9),
)
def test_a_parameter_file_that_is_none_is_refused_by_what_is_wrong_with_it(
    tmp_path: Path, text: str, said: str
) -> None:
    path = tmp_path / "file.yaml"
    path.write_text(text, encoding="utf-8")
    assert said in refused(path)


def test_what_is_no_file_is_not_waited_for(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe.yaml"
    os.mkfifo(pipe)
    assert f"{pipe}: cannot be read: not a regular file" in refused(pipe)
    assert "cannot be read: No such file or directory" in refused(tmp_path / "none.yaml")
