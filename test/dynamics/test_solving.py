"""Systems of linear equations."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from yawdamp_ros.dynamics.solving import solve


@given(st.integers(1, 60), st.integers(1, 5), st.integers(1, 4), st.integers(0, 2**32 - 1))
def test_the_solution_solves(size: int, columns: int, stack: int, seed: int) -> None:
    generator = np.random.default_rng(seed)
    factor = generator.standard_normal((stack, size, size))
    matrix = factor @ factor.swapaxes(1, 2) / size + np.eye(size)
    right = generator.standard_normal((stack, size, columns))
    np.testing.assert_allclose(matrix @ solve(matrix, right), right, atol=1e-13)
