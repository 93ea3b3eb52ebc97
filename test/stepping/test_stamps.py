from hypothesis import given
from hypothesis import strategies as st

from yawdamp_ros.stepping.stamps import Stamps

STEP, PERIOD, START = 1_000_000, 10_000_000, 1_700_000_000_000_000_000
CLOCKS = st.integers(START - 10**15, START + 10**15)


@given(CLOCKS, st.integers(0, 10**9))
def test_after_following_a_clock_a_stamp_is_within_the_tolerance_of_it(clock: int, step: int) -> None:
    stamps = Stamps(STEP, START)
    stamps.follow(step, clock, PERIOD)
    assert abs(stamps.of(step) - clock) <= PERIOD


@given(CLOCKS, st.integers(0, 10**9))
def test_the_jump_told_is_all_that_it_takes_to_repeat_the_stamps(clock: int, step: int) -> None:
    followed, repeated = Stamps(STEP, START), Stamps(STEP, START)
    repeated.jump(followed.follow(step, clock, PERIOD))
    assert [followed.of(later) for later in (step, step + 7)] == [
        repeated.of(later) for later in (step, step + 7)
    ]


def test_a_clock_within_the_tolerance_leaves_the_stamps_on_the_grid() -> None:
    stamps = Stamps(STEP, START)
    for difference in (-PERIOD, 0, PERIOD):
        assert stamps.follow(10, START + 10 * STEP + difference, PERIOD) == 0
    assert stamps.of(10) == START + 10 * STEP


def test_the_step_of_a_stamp_is_found_again() -> None:
    stamps = Stamps(STEP, START)
    stamps.jump(-3 * 10**9)
    assert stamps.at(stamps.of(1234)) == 1234
