import math

import pytest

from yawdamp_ros.stepping import HeldInput, Verdict


def speed() -> HeldInput:
    return HeldInput(20.0, 1.0, 70.0, backwards=False)


def test_the_newest_value_is_held_and_its_age_counted_in_steps() -> None:
    source = speed()
    assert (source.value, source.steps_since_command(9)) == (20.0, None)
    assert source.offer(21.5, 3) is Verdict.ACCEPTED
    assert (source.value, source.steps_since_command(9)) == (21.5, 6)


@pytest.mark.parametrize(
    "value, verdict",
    [
        (math.nan, Verdict.NOT_FINITE),
        (math.inf, Verdict.NOT_FINITE),
        (-math.inf, Verdict.NOT_FINITE),
        (-0.1, Verdict.BACKWARDS),
    ],
)
def test_what_is_no_speed_forwards_is_rejected_and_counted(value: float, verdict: Verdict) -> None:
    source = speed()
    assert source.offer(value, 1) is verdict
    assert (source.value, source.steps_since_command(1)) == (20.0, None)
    assert {key for key, count in source.counts.items() if count} == {verdict}


@pytest.mark.parametrize("value, clamped", [(0.0, 1.0), (0.99, 1.0), (71.0, 70.0)])
def test_what_the_model_cannot_follow_is_clamped_and_counted(value: float, clamped: float) -> None:
    source = speed()
    assert source.offer(value, 0) is Verdict.CLAMPED
    assert source.value == clamped
    assert source.counts[Verdict.CLAMPED] == 1
