"""Statements of CONTRIBUTING.md on the tests are true."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[1]
TEXT = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
CLOCK = re.compile(r"\btime\.(sleep|time|time_ns|monotonic|perf_counter)\b")
SHARED = {"test/graph.py", "test/test_contributing.py"}


def test_the_tests_that_look_at_a_clock_are_those_it_names() -> None:
    readers = {
        path.relative_to(ROOT).as_posix()
        for path in (ROOT / "test").rglob("*.py")
        if "soak" not in path.parts and CLOCK.search(path.read_text(encoding="utf-8"))
    }
    assert readers - SHARED == set(re.findall(r"`(test/[\w/]+\.py)`(?=[,` |][^\n]*\|)", TEXT))
