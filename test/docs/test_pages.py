"""Every page of the manual does what it shows, with the code as it is."""

import pkgutil
import re
from pathlib import Path

import pytest

import pages
import reproduce

ROOT = Path(__file__).parents[2]
ON_A_GRAPH = re.compile(
    r"^(\$ )?(yawdamp|python -m yawdamp_ros|ros2 \w+ yawdamp_ros) (sim|replay)\b", re.MULTILINE
)


def page(name: str) -> object:
    text = (ROOT / name).read_text(encoding="utf-8")
    graph = [pytest.mark.graph] if ON_A_GRAPH.search(text) else []
    return pytest.param(name, marks=[*graph, pytest.mark.timeout(300)])


@pytest.mark.parametrize("name", [page(name) for name in pages.PAGES])
def test_a_page_shows_what_its_blocks_print(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    assert (
        reproduce.differences((ROOT / name).read_text(encoding="utf-8"), pages.executed(name, tmp_path)) == []
    )


def test_what_is_not_run_has_a_reason() -> None:
    for name in pages.PAGES:
        for reason in re.findall(r"<!-- not run:(.*?)-->", (ROOT / name).read_text(encoding="utf-8")):
            assert len(reason.split()) > 2, name


def test_every_file_that_a_page_names_is_there() -> None:
    for path in [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *(ROOT / "docs").rglob("*.md")]:
        if pages.MADE.isdisjoint(path.parts):
            named = re.findall(
                r"`((?:yawdamp_ros|test|docs|config|examples)/[\w/.]+\.\w+)`", path.read_text()
            )
            assert [name for name in named if not (ROOT / name).exists()] == [], path.name


def test_every_name_of_the_library_that_a_page_gives_is_there() -> None:
    for path in [ROOT / "README.md", *(ROOT / "docs").rglob("*.md")]:
        for name in re.findall(r"`yawdamp_ros((?:\.\w+)+)`", path.read_text(encoding="utf-8")):
            assert pkgutil.resolve_name(f"yawdamp_ros{name}"), f"{path.name}: {name}"
