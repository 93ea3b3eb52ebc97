"""The walk through an assessment shows what its commands print."""

import re
import subprocess
import sys
from collections.abc import Callable

import pytest

from shown import DOCS, differences_of, printed, shown

TEXT = (DOCS / "assessment.md").read_text(encoding="utf-8")
SHOWN = shown("assessment.md")


@pytest.fixture(scope="module")
def differences() -> Callable[[str, str], list[str]]:
    return differences_of()


@pytest.mark.parametrize("command, output", SHOWN, ids=range(len(SHOWN)))
def test_output_is_what_the_command_prints(
    command: str, output: str, differences: Callable[[str, str], list[str]]
) -> None:
    assert output
    assert differences(output, printed(command)) == []


def test_every_command_has_its_output() -> None:
    assert len(SHOWN) == 7


def test_verdicts_are_those_of_the_exit_status() -> None:
    for vehicle, status in (("docs/interlink_payload.yaml", 0), ("a_double", 1)):
        command = [sys.executable, "-m", "yawdamp_ros", "assess", "--vehicle", vehicle, "--srt", "0.35"]
        assert subprocess.run(command, cwd=DOCS.parent, capture_output=True, check=False).returncode == status


def test_everything_linked_is_there() -> None:
    for target in re.findall(r"\]\(([^)#]+)", TEXT):
        assert (DOCS / target).is_file(), target
