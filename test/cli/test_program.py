import os
import subprocess
import sys

import pytest

from yawdamp_ros import __version__
from yawdamp_ros.cli import run

CODE = "import sys; sys.argv = [sys.argv[1]]; from yawdamp_ros.cli.program import program; print(program())"


@pytest.mark.parametrize(
    "script, variables, typed",
    [
        ("/usr/bin/yawdamp", {}, "yawdamp"),
        ("/site-packages/yawdamp_ros/__main__.py", {}, "python -m yawdamp_ros"),
        ("/ws/bin/yawdamp", {"YAWDAMP_TYPED": "ros2 run yawdamp_ros"}, "ros2 run yawdamp_ros"),
    ],
)
def test_the_program_is_named_as_it_was_typed(script: str, variables: dict[str, str], typed: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", CODE, script],
        env={**os.environ, **variables},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout == f"{typed}\n"


def test_errors_name_what_was_typed(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["assess", "--vehicle", "nothing"]) == 2
    assert capsys.readouterr().err.startswith("yawdamp assess: nothing: ")
    command = [sys.executable, "-m", "yawdamp_ros", "assess", "--vehicle", "nothing"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.stderr.startswith("python -m yawdamp_ros assess: nothing: ")


def test_version_is_that_of_the_package(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["--version"]) == 0
    assert capsys.readouterr().out == f"yawdamp_ros {__version__}\n"
