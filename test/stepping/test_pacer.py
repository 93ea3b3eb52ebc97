from hypothesis import given
from hypothesis import strategies as st

from yawdamp_ros.stepping import Pacer
from yawdamp_ros.stepping.pacer import CATCH_UP_NS

MS = 1_000_000


def test_a_period_is_due_once_it_is_over() -> None:
    pacer = Pacer(10, rate=1.0, now=1000)
    assert [pacer.due(now)[:2] for now in (1009, 1010, 1011, 1045)] == [(0, 0), (1, 0), (0, 0), (3, 0)]


def test_what_is_too_late_is_dropped_once() -> None:
    # A tenth of a second is five periods of 20 ms; ten are made up for all the same.
    pacer = Pacer(20 * MS, rate=1.0, now=0)
    assert pacer.due(1000 * MS)[:2] == (10, 40)
    assert pacer.due(1019 * MS)[:2] == (0, 0)
    assert pacer.due(1020 * MS)[:2] == (1, 0)


def test_a_tenth_of_a_second_is_made_up_for_at_any_rate() -> None:
    pacer = Pacer(MS, rate=1.0, now=0)
    assert pacer.due(150 * MS)[:2] == (100, 50)
    pacer.change_rate(20.0, 150 * MS)
    assert pacer.due(300 * MS)[:2] == (2000, 1000)


def test_time_that_stood_is_not_due() -> None:
    pacer = Pacer(10, rate=1.0, now=0)
    assert pacer.due(20)[:2] == (2, 0)
    pacer.pause(24)
    pacer.pause(100)
    assert pacer.due(500)[:2] == (0, 0)
    pacer.resume(1000)
    pacer.resume(2000)
    assert pacer.due(1005)[:2] == (0, 0)
    assert pacer.due(1006)[:2] == (1, 0)


@given(st.lists(st.integers(0, 2000 * 10**6), max_size=50))
def test_periods_simulated_and_dropped_make_up_the_time_that_went_by(waits: list[int]) -> None:
    pacer, now, total = Pacer(7 * MS, 1.0, 0), 0, 0
    for wait in waits:
        now += wait
        due = pacer.due(now)
        assert 0 <= due.periods <= 14
        total += due.periods + due.dropped
        assert total == now // (7 * MS)


def test_a_rate_scales_time_and_can_change_on_the_way() -> None:
    pacer = Pacer(10, rate=2.0, now=0)
    assert pacer.due(20)[:2] == (4, 0)
    pacer.change_rate(0.5, now=25)
    assert pacer.due(25)[:2] == (1, 0)
    assert pacer.due(44)[:2] == (0, 0)
    assert pacer.due(45)[:2] == (1, 0)


def test_as_fast_as_it_goes_is_always_due_but_in_a_pause() -> None:
    pacer = Pacer(10, rate=0.0, now=0)
    assert pacer.due(0) == pacer.due(1) == (CATCH_UP_NS // 10, 0, 0.0)
    pacer.pause(2)
    assert pacer.due(3) == (0, 0, 0.0)
    pacer.change_rate(1.0, 4)
    pacer.resume(100)
    assert pacer.due(110)[:2] == (1, 0)


def test_lateness_is_how_far_behind_the_grid_a_look_was() -> None:
    pacer = Pacer(10, rate=1.0, now=0)
    assert pacer.due(10).lateness == 0.0
    assert pacer.due(23).lateness == 3.0
    assert pacer.due(45).lateness == 15.0


def test_a_day_at_a_kilohertz_does_not_drift() -> None:
    pacer, done = Pacer(MS, 1.0, 0), 0
    for look in range(1, 864_001):
        done += pacer.due(look * 100 * MS + 7).periods
    assert done == 86_400_000
