"""The committed documents say what the code gives."""

import importlib.util
import re
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest

DOCS = Path(__file__).parents[2] / "docs"


@pytest.fixture(scope="module")
def reproduce() -> ModuleType:
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(DOCS))
        spec = importlib.util.spec_from_file_location("reproduce", DOCS / "reproduce.py")
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
    return module


def test_reproduction_is_not_stale() -> None:
    command = [sys.executable, str(DOCS / "reproduce.py"), "--check"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=100)
    assert (done.returncode, done.stderr) == (0, "")


def test_every_figure_and_table_of_the_report_is_held_against_the_models() -> None:
    text = (DOCS / "report_reproduction.md").read_text(encoding="utf-8")
    named = set()
    for first, last in re.findall(r"[Ff]igures? (\d+)(?: (?:to|and) (\d+))?", text):
        named |= set(range(int(first), int(last or first) + 1))
    assert named >= {4, 7, 8, 10, 11, *range(17, 46)}
    for heading in ("### Table 3", "### Table 5", "### Table 6", "### Appendix B"):
        assert heading in text


@pytest.mark.parametrize("document", ["report_reproduction.md", "theory.md"])
def test_every_picture_and_document_linked_is_there(document: str) -> None:
    text = (DOCS / document).read_text(encoding="utf-8")
    for target in re.findall(r"\]\(([^)#]+)\)", text):
        assert (DOCS / target).is_file(), target


@pytest.mark.parametrize("computed", ["0.124 rad", "0.125 rad", "0.123 rad"])
def test_the_rounding_of_a_last_digit_is_forgiven(computed: str, reproduce: ModuleType) -> None:
    assert reproduce.differences("0.124 rad", computed) == []


@pytest.mark.parametrize(
    "committed, computed",
    [
        ("0.124 rad", "0.126 rad"),
        ("-0.124 rad", "0.124 rad"),
        ("0.124 rad", "0.12 rad"),
        ("7 roots", "8 roots"),
        ("stable", "unstable"),
        ("one line", "one line\nand another"),
    ],
)
def test_any_other_difference_is_told(committed: str, computed: str, reproduce: ModuleType) -> None:
    assert reproduce.differences(committed, computed)
