import math

import pytest

from yawdamp_ros.stepping import SpeedInput


def test_the_newest_speed_is_held() -> None:
    source = SpeedInput(20.0)
    assert source.speed == 20.0
    assert source.offer(21.5)
    assert source.speed == 21.5


@pytest.mark.parametrize("speed", [math.nan, math.inf, -math.inf, -0.1])
def test_what_is_no_speed_forwards_is_refused_and_counted(speed: float) -> None:
    source = SpeedInput(20.0)
    assert not source.offer(speed)
    assert (source.speed, source.rejected, source.clamped) == (20.0, 1, 0)


@pytest.mark.parametrize("speed, clamped", [(0.0, 1.0), (0.99, 1.0), (71.0, 70.0)])
def test_what_the_model_cannot_follow_is_clamped_and_counted(speed: float, clamped: float) -> None:
    source = SpeedInput(20.0)
    assert not source.offer(speed)
    assert (source.speed, source.rejected, source.clamped) == (clamped, 0, 1)
