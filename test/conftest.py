"""Fixtures that all tests share."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from hypothesis import settings

if TYPE_CHECKING:
    from collections.abc import Iterator

    from graph import Graph

for directory in (Path(__file__).parent, Path(__file__).parents[1] / "docs"):
    sys.path.insert(0, str(directory))

# The same examples every time: a check that fails now and then is no check of a commit.
settings.register_profile("repeatable", derandomize=True, deadline=None)
settings.load_profile("repeatable")


@pytest.fixture
def graph(tmp_path: Path) -> "Iterator[Graph]":
    """A ROS graph of this test's own, with the test's directory as working directory."""
    from graph import Graph  # noqa: PLC0415 - tests that need no ROS do not import it

    made = Graph(tmp_path)
    yield made
    made.close()
