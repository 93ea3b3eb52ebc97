from hypothesis import given
from hypothesis import strategies as st

from yawdamp_ros.stepping import Pacer


def test_a_period_is_due_once_it_is_over() -> None:
    pacer = Pacer(10, most=5, now=1000)
    assert [pacer.due(now) for now in (1009, 1010, 1011, 1045)] == [(0, 0), (1, 0), (0, 0), (3, 0)]


def test_what_is_too_late_is_given_up_once() -> None:
    pacer = Pacer(10, most=5, now=0)
    assert pacer.due(200) == (5, 15)
    assert pacer.due(209) == (0, 0)
    assert pacer.due(210) == (1, 0)


def test_time_that_stood_is_not_due() -> None:
    pacer = Pacer(10, most=5, now=0)
    assert pacer.due(20) == (2, 0)
    pacer.pause(24)
    pacer.pause(100)
    assert pacer.due(500) == (0, 0)
    pacer.resume(1000)
    pacer.resume(2000)
    assert pacer.due(1005) == (0, 0)
    assert pacer.due(1006) == (1, 0)


@given(st.lists(st.integers(0, 100), max_size=50), st.integers(1, 10))
def test_periods_simulated_and_given_up_make_up_the_time_that_went_by(waits: list[int], most: int) -> None:
    pacer, now, total = Pacer(7, most, 0), 0, 0
    for wait in waits:
        now += wait
        due = pacer.due(now)
        assert 0 <= due.periods <= most
        total += sum(due)
        assert total == now // 7
