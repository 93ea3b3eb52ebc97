"""Work goes to an executor a few pieces ahead of what was asked for, and comes back in order."""

from collections.abc import Iterator

import pytest

from yawdamp_ros.cli.executors import AHEAD, mapping


@pytest.mark.parametrize("threads", [True, False])
def test_results_come_in_order_and_no_more_is_taken_than_is_under_way(*, threads: bool) -> None:
    taken = []

    def pieces() -> Iterator[float]:
        for index in range(200):
            taken.append(index)
            yield -float(index)

    with mapping(200, 2, None, threads=threads) as mapped:
        for index, result in enumerate(mapped(abs, pieces())):
            assert result == index
            assert len(taken) <= index + 1 + AHEAD * 2
