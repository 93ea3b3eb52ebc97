import math

import pytest

from yawdamp_ros.stepping import SpeedInput, Verdict


def test_the_newest_speed_is_held() -> None:
    source = SpeedInput(20.0)
    assert source.speed == 20.0
    assert source.offer(21.5) is Verdict.ACCEPTED
    assert source.speed == 21.5


@pytest.mark.parametrize(
    "speed, verdict",
    [
        (math.nan, Verdict.NOT_FINITE),
        (math.inf, Verdict.NOT_FINITE),
        (-math.inf, Verdict.NOT_FINITE),
        (-0.1, Verdict.BACKWARDS),
    ],
)
def test_what_is_no_speed_forwards_is_rejected_and_counted(speed: float, verdict: Verdict) -> None:
    source = SpeedInput(20.0)
    assert source.offer(speed) is verdict
    assert source.speed == 20.0
    assert {key for key, count in source.counts.items() if count} == {verdict}


@pytest.mark.parametrize("speed, clamped", [(0.0, 1.0), (0.99, 1.0), (71.0, 70.0)])
def test_what_the_model_cannot_follow_is_clamped_and_counted(speed: float, clamped: float) -> None:
    source = SpeedInput(20.0)
    assert source.offer(speed) is Verdict.CLAMPED
    assert source.speed == clamped
    assert source.counts[Verdict.CLAMPED] == 1
