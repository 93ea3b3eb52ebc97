"""Steady turns, by the closed form of the two-axle vehicle and by what linear tyres imply."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from yawdamp_ros.analysis import AnalysisError, static_gains, steady_steering, steady_turn
from yawdamp_ros.dynamics import linear_model
from yawdamp_ros.vehicle import builtin_vehicles, load_vehicle


def test_two_axle_vehicle_has_its_wheelbase_and_the_textbook_understeer_gradient() -> None:
    steering = steady_steering(linear_model(load_vehicle("single_vehicle")))
    wheelbase = 0.9271 + 1.5621
    front_mass, rear_mass = 1031.9 * 1.5621 / wheelbase, 1031.9 * 0.9271 / wheelbase
    assert steering.equivalent_wheelbase == pytest.approx(wheelbase)
    assert steering.understeer_gradient == pytest.approx(front_mass / 77500 - rear_mass / 116250)


def test_yaw_rate_gain_of_the_single_vehicle_is_the_published_one() -> None:
    assert static_gains(linear_model(load_vehicle("single_vehicle")))["car/yaw_rate"] == pytest.approx(
        4.4355, abs=5e-5
    )


@pytest.mark.parametrize("model", ["consistent", "published"])
@given(speed=st.floats(2.0, 50.0))
def test_steer_angle_is_geometry_plus_understeer_at_every_speed(model: str, speed: float) -> None:
    vehicle = load_vehicle("interlink")
    steering = steady_steering(linear_model(vehicle, 20.0, model))
    turn = steady_turn(linear_model(vehicle, speed, model))
    curvature = 1.0 / speed
    assert turn.steering_angle == pytest.approx(
        steering.equivalent_wheelbase * curvature + steering.understeer_gradient * speed
    )


@given(st.sampled_from(builtin_vehicles()), st.floats(2.0, 30.0))
def test_static_gains_are_those_of_the_steady_turn(name: str, speed: float) -> None:
    model = linear_model(load_vehicle(name), speed)
    gains, turn = static_gains(model), steady_turn(model)
    for unit in model.vehicle.unit_names:
        assert gains[f"{unit}/yaw_rate"] == pytest.approx(1.0 / turn.steering_angle)
        assert gains[f"{unit}/lateral_acceleration"] == pytest.approx(speed / turn.steering_angle)


def test_a_root_at_the_origin_leaves_no_static_gains() -> None:
    model = linear_model(load_vehicle("single_vehicle"))
    singular = dataclasses.replace(model, state_matrix=np.zeros_like(model.state_matrix))
    with pytest.raises(AnalysisError, match="a root at the origin"):
        static_gains(singular)


def test_without_steered_tyres_no_angle_holds_a_turn() -> None:
    model = linear_model(load_vehicle("single_vehicle"))
    with pytest.raises(AnalysisError, match="no steer angle holds a steady turn"):
        steady_turn(dataclasses.replace(model, input_matrix=np.zeros_like(model.input_matrix)))
