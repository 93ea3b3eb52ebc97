"""Systems of linear equations."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from threads import answers_by_threads
from yawdamp_ros.dynamics.solving import solve


@given(st.integers(1, 60), st.integers(1, 5), st.integers(1, 4), st.integers(0, 2**32 - 1))
def test_the_solution_solves(size: int, columns: int, stack: int, seed: int) -> None:
    generator = np.random.default_rng(seed)
    factor = generator.standard_normal((stack, size, size))
    matrix = factor @ factor.swapaxes(1, 2) / size + np.eye(size)
    right = generator.standard_normal((stack, size, columns))
    np.testing.assert_allclose(matrix @ solve(matrix, right), right, atol=1e-13)


@pytest.mark.parametrize("kernels", ["", "Nehalem"], ids=["of the processor", "without AVX"])
def test_the_bits_do_not_depend_on_how_many_threads_there_are(kernels: str) -> None:
    program = """
import hashlib
import numpy as np
from yawdamp_ros.dynamics.solving import solve
generator = np.random.default_rng(0)
for size in range(1, 16):
    for columns in (1, 2 * size, 2 * size + 1):
        factor = generator.standard_normal((size, size))
        # Built without products of matrices, whose bits depend on threads, too.
        matrix = (factor[:, np.newaxis] * factor).sum(axis=-1) + np.eye(size)
        found = solve(matrix, generator.standard_normal((size, columns)))
        print(size, columns, hashlib.sha256(found.tobytes()).hexdigest())
"""
    assert len(answers_by_threads(program, kernels)) == 1
