"""Fixtures that all tests share."""

import os
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

# A ROS domain for each of the workers: a node that a test starts without a graph meets no other worker's.
_WORKER = int(os.environ.get("PYTEST_XDIST_WORKER", "gw0").removeprefix("gw"))
os.environ["ROS_DOMAIN_ID"] = str(20 * (_WORKER % 5 + 1))

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
