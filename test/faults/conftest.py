from collections.abc import Iterator
from pathlib import Path

import pytest

from graph import Graph

TRANSPORTS = "FASTDDS_BUILTIN_TRANSPORTS"


@pytest.fixture
def graph(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Graph]:
    """The graph, its observer out of the shared memory that processes are killed in here."""
    monkeypatch.setenv(TRANSPORTS, "UDPv4")
    opened = Graph(tmp_path)
    del opened.environment[TRANSPORTS]
    yield opened
    opened.close()
