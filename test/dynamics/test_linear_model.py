from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given

from strategies import vehicles
from yawdamp_ros import linear_model, load_vehicle
from yawdamp_ros.dynamics import DynamicsError
from yawdamp_ros.stepping import Stepper
from yawdamp_ros.vehicle import Vehicle


@given(vehicles())
def test_lateral_acceleration_is_the_change_of_lateral_velocity_and_the_turn(vehicle: Vehicle) -> None:
    model = linear_model(vehicle)
    count = len(vehicle.units)
    stepper = Stepper(model, 0.01)
    stepper.steer(0.01)
    for _ in range(20):
        stepper.advance()
    before = stepper.sample()
    rates = model.state_matrix @ stepper.state + model.input_matrix * 0.01
    velocity_change = model.output_matrix[:count] @ rates
    expected = velocity_change + vehicle.speed * before.yaw_rate
    np.testing.assert_allclose(before.lateral_acceleration, expected, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("speed", [0.0, 1e-300, -1.0, float("nan"), float("inf")])
def test_a_speed_that_is_none_is_refused(speed: float) -> None:
    with pytest.raises(DynamicsError, match=r"speed: .*: expected a speed of at least 0.01 m/s"):
        linear_model(load_vehicle("interlink"), speed)


def test_an_unknown_model_is_refused_with_the_known_ones() -> None:
    with pytest.raises(DynamicsError, match="model: 'exact': expected one of consistent"):
        linear_model(load_vehicle("interlink"), model="exact")


def test_numbers_too_far_apart_for_a_model_are_refused() -> None:
    vehicle = load_vehicle("interlink")
    tiny = tuple(replace(unit, mass=5e-324, yaw_inertia=5e-324) for unit in vehicle.units)
    with pytest.raises(DynamicsError, match="the numbers of interlink are too far apart to compute with"):
        linear_model(replace(vehicle, units=tiny))
