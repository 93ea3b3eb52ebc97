"""The nonlinear model behind `Motion`: the same bits however a run is cut, and an end that is named."""

import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from yawdamp_ros.manoeuvres import LaneChange, Step
from yawdamp_ros.simulation import MODELS, make_motion, simulate
from yawdamp_ros.simulation.nonlinear_motion import NonlinearMotion
from yawdamp_ros.stepping import AppliedInput
from yawdamp_ros.vehicle import load_vehicle

INTERLINK = load_vehicle("interlink")
ANGLES = 0.02 * np.sin(np.arange(1, 601) / 100.0)


def motion() -> NonlinearMotion:
    return NonlinearMotion(INTERLINK, 20.0, 0.001)


def test_it_is_one_of_the_models() -> None:
    assert isinstance(make_motion(INTERLINK, "nonlinear", 20.0, 0.001), NonlinearMotion)
    assert "nonlinear" in MODELS


@settings(max_examples=10)
@given(st.lists(st.integers(1, 599), max_size=5))
def test_a_run_has_the_same_bits_however_it_is_cut(cuts: list[int]) -> None:
    whole, pieces = motion(), motion()
    expected = whole.run(ANGLES)
    for part in np.split(ANGLES, sorted(set(cuts))):
        found = pieces.run(part)
    assert found.yaw.tolist() == expected.yaw.tolist()
    assert found.x.tolist() == expected.x.tolist()
    assert pieces.snapshot()["state"] == whole.snapshot()["state"]


def test_samples_of_many_instants_are_those_of_each() -> None:
    several, each = motion(), motion()
    table = several.run(ANGLES, 100)
    for index, part in enumerate(np.split(ANGLES, 6)):
        one = each.run(part)
        assert int(table.step[index]) == int(one.step)
        assert table.lateral_acceleration[index].tolist() == one.lateral_acceleration.tolist()
        assert table.extra["roll"][index].tolist() == one.extra["roll"].tolist()


def test_a_snapshot_through_json_goes_on_with_the_same_bits() -> None:
    original, copy = motion(), motion()
    original.run(ANGLES[:300])
    original.apply(AppliedInput(300, "acceleration", -1.0))
    copy.restore(json.loads(json.dumps(original.snapshot(), allow_nan=False)))
    assert original.run(ANGLES[300:]).yaw.tolist() == copy.run(ANGLES[300:]).yaw.tolist()


def test_inputs_repeat_a_run() -> None:
    driven, repeated = motion(), motion()
    driven.apply(AppliedInput(0, "friction", 0.3))
    told = driven.run(ANGLES[:100]).inputs
    driven.apply(AppliedInput(100, "trailer_2/brake", 1.0))
    told += driven.run(ANGLES[100:200]).inputs
    for applied in told:
        repeated.advance(applied.step - repeated.step)
        repeated.apply(applied)
    repeated.advance(200 - repeated.step)
    assert repeated.sample().yaw.tolist() == driven.sample().yaw.tolist()
    assert {applied.name for applied in told} == {"speed", "steering", "friction", "trailer_2/brake"}


def test_a_brake_demand_slows_the_combination_down() -> None:
    braked = motion()
    braked.apply(AppliedInput(0, "acceleration", -2.0))
    braked.advance(2000)
    assert braked.speed == pytest.approx(20.0 - 4.0, abs=0.4)


def test_a_speed_ends_a_demanded_acceleration() -> None:
    driven = motion()
    driven.apply(AppliedInput(0, "acceleration", -2.0))
    driven.advance(2000)
    driven.apply(AppliedInput(2000, "speed", 15.0))
    driven.advance(8000)
    assert driven.speed == pytest.approx(15.0, abs=0.05)


def test_small_steering_gives_the_linear_motion() -> None:
    lane_change = LaneChange(amplitude=1e-4)
    linear = simulate(INTERLINK, lane_change, 6.0, sample_period=0.01)
    nonlinear = simulate(INTERLINK, lane_change, 6.0, sample_period=0.01, model="nonlinear")
    # Roll, load transfer and the tyres' lag remain at any amplitude: some per cent.
    peak = np.abs(linear.yaw_rate).max()
    assert np.abs(nonlinear.yaw_rate - linear.yaw_rate).max() < 0.1 * peak


def test_a_rollover_ends_the_run_and_is_named() -> None:
    a_double = load_vehicle("a_double")
    response = simulate(a_double, LaneChange(), 15.0, sample_period=0.01, model="nonlinear")
    assert response.events[-1].name == "rollover"
    assert response.events[-1].where in a_double.unit_names
    assert response.events[-1].final
    assert response.time[-1] < 0.001 * response.events[-1].step < 15.0
    assert np.isfinite(response.yaw).all()
    assert "wheel_lift" in {event.name for event in response.events}


def test_a_motion_that_cannot_be_followed_ends_with_a_unit_and_no_nan() -> None:
    response = simulate(INTERLINK, Step(amplitude=0.5), 15.0, step_size=0.1, model="nonlinear")
    assert response.events[-1].final
    assert response.events[-1].name == "divergence"
    assert response.events[-1].where in INTERLINK.unit_names
    assert np.isfinite(response.yaw_rate).all()
