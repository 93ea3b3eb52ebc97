"""Points made part by part are those made at once."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from yawdamp_ros.analysis.points import Draws, Grid, Points

SPANS = [(5.0, 6.0), (-1.0, 1.0), (0.0, 0.5)]


@pytest.mark.parametrize("points", [Draws(SPANS, 1000, seed=7), Grid([[1.0, 2.0], range(25), range(20)])])
@given(start=st.integers(0, 1100), length=st.integers(0, 300))
def test_a_part_is_that_of_the_whole(points: Points, start: int, length: int) -> None:
    np.testing.assert_array_equal(points[start : start + length], points[:][start : start + length])
    assert len(points) == len(points[:]) == 1000


def test_draws_lie_in_their_ranges_and_repeat_with_their_seed() -> None:
    drawn = Draws(SPANS, 1000, seed=7)[:]
    assert drawn.shape == (1000, 3)
    for column, (low, high) in zip(drawn.T, SPANS, strict=True):
        assert low <= column.min() < column.max() <= high
        assert column.mean() == pytest.approx((low + high) / 2, abs=0.05 * (high - low))
    np.testing.assert_array_equal(drawn, Draws(SPANS, 1000, seed=7)[:])
    assert not np.array_equal(drawn, Draws(SPANS, 1000, seed=8)[:])


def test_draws_are_those_of_the_generator_of_that_seed() -> None:
    lows, highs = np.array(SPANS).T
    expected = np.random.default_rng(7).uniform(lows, highs, (1000, 3))
    np.testing.assert_array_equal(Draws(SPANS, 1000, seed=7)[:], expected)


def test_grid_varies_its_last_axis_fastest() -> None:
    assert Grid([[1.0, 2.0], [3.0, 4.0]])[:].tolist() == [[1, 3], [1, 4], [2, 3], [2, 4]]
