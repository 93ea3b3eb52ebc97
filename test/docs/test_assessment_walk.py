"""The walk through an assessment shows what its commands print."""

import importlib.util
import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"
TEXT = (DOCS / "assessment.md").read_text(encoding="utf-8")
SHOWN = re.findall(r"```console\n\$ (.+)\n([^`]*)```", TEXT)


@pytest.fixture(scope="module")
def differences() -> Callable[[str, str], list[str]]:
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(DOCS))
        spec = importlib.util.spec_from_file_location("reproduce", DOCS / "reproduce.py")
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
    return module.differences


def printed(command: str) -> str:
    """What a command prints where the package is installed, without blanks at the ends of lines."""
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        ["bash", "-c", command],
        cwd=DOCS.parent,
        env={**os.environ, "PATH": path},
        capture_output=True,
        text=True,
        check=False,
        timeout=100,
    )
    assert done.stderr == ""
    return "".join(f"{line.rstrip()}\n" for line in done.stdout.splitlines())


@pytest.mark.parametrize("command, output", SHOWN, ids=range(len(SHOWN)))
def test_output_is_what_the_command_prints(
    command: str, output: str, differences: Callable[[str, str], list[str]]
) -> None:
    assert output
    assert differences(output, printed(command)) == []


def test_every_command_has_its_output() -> None:
    assert len(SHOWN) == TEXT.count("```console") == 7


def test_verdicts_are_those_of_the_exit_status() -> None:
    for vehicle, status in (("docs/interlink_payload.yaml", 0), ("a_double", 1)):
        command = [sys.executable, "-m", "yawdamp_ros", "assess", "--vehicle", vehicle, "--srt", "0.35"]
        assert subprocess.run(command, cwd=DOCS.parent, capture_output=True, check=False).returncode == status


def test_everything_linked_is_there() -> None:
    for target in re.findall(r"\]\(([^)#]+)", TEXT):
        assert (DOCS / target).is_file(), target
