import math
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from yawdamp_ros.stepping import SteeringActuator


@given(st.lists(st.floats(-1.0, 1.0), min_size=1, max_size=50))
def test_without_lag_and_limit_it_passes_commands_on_unchanged(commands: list[float]) -> None:
    actuator = SteeringActuator(0.001, time_constant=0.0, rate_limit=0.0)
    assert [actuator.follow(command) for command in commands] == commands


def test_a_lag_closes_exponentially() -> None:
    actuator = SteeringActuator(0.001, time_constant=0.2, rate_limit=0.0)
    angles = [actuator.follow(0.1) for _ in range(1000)]
    for step in (1, 200, 1000):
        assert angles[step - 1] == pytest.approx(0.1 * (1.0 - math.exp(-0.001 * step / 0.2)), rel=1e-12)


def test_a_rate_limit_is_a_ramp_that_arrives_exactly() -> None:
    actuator = SteeringActuator(0.01, time_constant=0.0, rate_limit=0.5)
    angles = [actuator.follow(-0.0175) for _ in range(5)]
    assert angles == pytest.approx([-0.005, -0.010, -0.015, -0.0175, -0.0175])
    assert angles[-1] == -0.0175


@given(st.lists(st.floats(-1.0, 1.0), min_size=2, max_size=100))
def test_nothing_turns_the_wheels_faster_than_the_limit(commands: list[float]) -> None:
    actuator = SteeringActuator(0.01, time_constant=0.05, rate_limit=0.3)
    angles = [0.0, *(actuator.follow(command) for command in commands)]
    assert max(abs(b - a) for a, b in pairwise(angles)) <= 0.003 + 1e-12
