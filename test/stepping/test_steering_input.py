import pytest

from yawdamp_ros.stepping import SteeringInput, Verdict


def steering_input(**settings: float) -> SteeringInput:
    defaults = {
        "ratio": 1.0,
        "limit": 0.5,
        "timeout_steps": 100,
        "zero_on_timeout": False,
        "max_age": 0.0,
    }
    return SteeringInput(**{**defaults, **settings})  # type: ignore[arg-type]


def test_wheels_point_straight_ahead_until_the_first_command() -> None:
    source = steering_input(zero_on_timeout=True)
    assert source.at(10_000) == 0.0
    assert not source.timed_out(10_000)


def test_the_newest_command_wins_and_is_held() -> None:
    source = steering_input()
    source.offer(0.1, 5)
    source.offer(0.2, 5)
    assert [source.at(step) for step in (6, 105, 106, 10_000)] == [0.2] * 4


def test_a_hand_wheel_angle_is_divided_by_the_ratio() -> None:
    source = steering_input(ratio=16.0)
    source.offer(1.6, 0)
    assert source.at(1) == 0.1


@pytest.mark.parametrize("command", [float("nan"), float("inf"), float("-inf")])
def test_what_is_no_angle_is_rejected_counted_and_forgotten(command: float) -> None:
    source = steering_input()
    source.offer(0.1, 0)
    assert source.offer(command, 1) is Verdict.NOT_FINITE
    assert source.at(2) == 0.1
    assert source.counts[Verdict.NOT_FINITE] == 1


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_an_angle_past_the_limit_is_clamped_and_counted(sign: float) -> None:
    source = steering_input(ratio=2.0)
    assert source.offer(sign * 1e308, 0) is Verdict.CLAMPED
    assert source.at(1) == sign * 0.5
    assert source.offer(sign * 1.0, 1) is Verdict.ACCEPTED
    assert source.at(2) == sign * 0.5
    assert source.counts[Verdict.CLAMPED] == 1


def test_silence_zeroes_the_wheels_only_past_the_timeout_and_only_if_asked() -> None:
    source = steering_input(zero_on_timeout=True)
    source.offer(0.1, 50)
    assert [source.at(step) for step in (51, 150, 151)] == [0.1, 0.1, 0.0]
    source.offer(0.2, 200)
    assert source.at(201) == 0.2


def test_a_rejected_command_does_not_end_a_silence() -> None:
    source = steering_input(zero_on_timeout=True)
    source.offer(0.1, 0)
    source.offer(float("nan"), 90)
    assert source.at(101) == 0.0


@pytest.mark.parametrize("age", [0.6, 3600.0, -0.6, -3600.0])
def test_a_stamp_that_is_not_of_now_is_refused_and_counted(age: float) -> None:
    source = steering_input(max_age=0.5)
    source.offer(0.1, 0, age=0.4)
    assert source.offer(0.2, 1, age=age) is Verdict.STALE
    assert source.at(2) == 0.1
    assert source.counts[Verdict.STALE] == 1


def test_stamps_do_not_count_where_there_are_none_or_any_age_will_do() -> None:
    assert steering_input(max_age=0.5).offer(0.1, 0) is Verdict.ACCEPTED
    assert steering_input(max_age=0.0).offer(0.1, 0, age=3600.0) is Verdict.ACCEPTED


def test_silence_is_the_steps_since_the_last_command() -> None:
    source = steering_input()
    assert source.steps_since_command(7) is None
    source.offer(0.1, 7)
    assert source.steps_since_command(12) == 5
