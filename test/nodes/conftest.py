"""What tests of nodes share."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from graph import Graph


@pytest.fixture
def graph(tmp_path: Path) -> Iterator[Graph]:
    """A graph of this test's own, with the test's directory as working directory."""
    made = Graph(tmp_path)
    yield made
    made.close()
