import pytest
from hypothesis import given
from hypothesis import strategies as st

from yawdamp_ros.stepping import SteppingError, TimeGrid


@given(st.integers(1, 100_000), st.integers(1, 1000))
def test_a_period_of_whole_steps_is_accepted_and_kept_exactly(microseconds: int, steps: int) -> None:
    grid = TimeGrid.of(microseconds * 1e-6, microseconds * steps * 1e-6)
    assert grid.step_ns == microseconds * 1000
    assert grid.period_ns == grid.step_ns * steps


def test_times_do_not_drift() -> None:
    grid = TimeGrid.of(0.001, 0.01)
    assert grid.seconds(86_400_000) == 86_400.0
    assert grid.samples_in(15.0) == 1500


@pytest.mark.parametrize(
    "step_size, period",
    [
        (0.001, 0.0015),
        (0.01, 0.001),
        (0.001, 0.0),
        (0.0, 0.01),
        (1e-9, 0.01),
        (-1.0, 1.0),
        (float("nan"), 1.0),
        (0.001, float("inf")),
    ],
)
def test_what_does_not_fit_is_refused(step_size: float, period: float) -> None:
    with pytest.raises(SteppingError, match=r"(step_size|sample_period): "):
        TimeGrid.of(step_size, period)
