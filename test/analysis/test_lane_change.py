"""The single lane change of SAE J2179: its closed form, and what vehicles make of it."""

import numpy as np
import pytest

from yawdamp_ros import linear_model, load_vehicle, simulate
from yawdamp_ros.analysis import (
    SAE_J2179,
    SAE_J2179_SPEED,
    AnalysisError,
    SingleLaneChange,
    axle_path,
    run_lane_change,
    steer_axle_position,
)
from yawdamp_ros.dynamics import LinearModel
from yawdamp_ros.vehicle import builtin_vehicles


def model_of(name: str, *overrides: str) -> LinearModel:
    return linear_model(load_vehicle(name, overrides), SAE_J2179_SPEED)


def test_displacement_and_length_are_those_of_the_standard() -> None:
    assert SAE_J2179.displacement == pytest.approx(1.464, abs=5e-4)
    assert SAE_J2179_SPEED / SAE_J2179.frequency == pytest.approx(61.1, abs=0.05)
    np.testing.assert_allclose(
        SAE_J2179.path(np.array([-1.0, 0.0, 1.25, 2.5, 9.0])), [0.0, 0.0, 0.732, 1.464, 1.464], atol=5e-4
    )


def test_path_is_the_acceleration_integrated_twice() -> None:
    change = SingleLaneChange(amplitude=2.0, frequency=0.5)
    time = np.linspace(0.0, 2.0, 20_001)
    acceleration = np.gradient(np.gradient(change.path(time), time), time)
    np.testing.assert_allclose(acceleration[5:-5], 2.0 * np.sin(np.pi * time[5:-5]), atol=2e-3)


@pytest.mark.parametrize("name", builtin_vehicles())
def test_steer_axle_follows_the_path(name: str) -> None:
    model = model_of(name)
    response = run_lane_change(model)
    path = axle_path(response, 0, steer_axle_position(model.vehicle))
    # The ground path is that of true headings, whose cosine differs from 1 by 0.1 %.
    np.testing.assert_allclose(path.y, SAE_J2179.path(response.time), atol=1.5e-3)
    end = np.searchsorted(response.time, 2.5)
    assert path.x[end] - path.x[0] == pytest.approx(61.1, abs=0.05)
    assert path.y[end] == pytest.approx(1.464, abs=1.5e-3)


@pytest.mark.parametrize("name", builtin_vehicles())
def test_steer_axle_s_acceleration_is_the_sine(name: str) -> None:
    model = model_of(name)
    response = run_lane_change(model)
    position = steer_axle_position(model.vehicle)
    acceleration = response.lateral_acceleration[:, 0] + position * np.gradient(
        response.yaw_rate[:, 0], response.time
    )
    during = slice(2, np.searchsorted(response.time, 2.5) - 1)
    expected = SAE_J2179.amplitude * np.sin(2.0 * np.pi * 0.4 * response.time)
    np.testing.assert_allclose(acceleration[during], expected[during], atol=2e-3)


@pytest.mark.parametrize("name", ["interlink", "a_double"])
def test_simulator_driven_with_that_steering_moves_alike(name: str) -> None:
    model = model_of(name)
    response = run_lane_change(model)
    # Held over each step: the angle in the middle of it.
    simulated = simulate(
        model.vehicle,
        lambda time: float(np.interp(time + 0.0005, response.time, response.steering_angle)),
        8.0,
        sample_period=0.005,
        speed=model.speed,
    )
    count = len(simulated.time)
    np.testing.assert_allclose(simulated.yaw_rate, response.yaw_rate[:count], atol=2e-5)
    np.testing.assert_allclose(simulated.y, response.y[:count], atol=2e-3)


def test_period_need_not_end_at_a_sample() -> None:
    change = SingleLaneChange(amplitude=1.0, frequency=0.3137)
    response = run_lane_change(model_of("truck_trailer"), change)
    path = axle_path(response, 0, 2.062)
    np.testing.assert_allclose(path.y, change.path(response.time), atol=3e-3)


def test_vehicle_comes_to_rest_in_the_next_lane() -> None:
    response = run_lane_change(model_of("a_double"))
    np.testing.assert_allclose(response.yaw[-1], 0.0, atol=1e-3)
    np.testing.assert_allclose(response.y[-1], 1.464, atol=0.01)


def test_rear_steered_vehicle_cannot_be_held_on_it() -> None:
    # Its unsteered axle runs ahead of the steered one: held there, the vehicle turns about, as a
    # forklift does that is driven backwards.
    forklift = model_of("single_vehicle", "units.0.axles.0.steered=false", "units.0.axles.1.steered=true")
    with pytest.raises(AnalysisError, match="cannot be held on a lane change: a zero at"):
        run_lane_change(forklift)


def test_published_interlink_cannot_be_held_on_it() -> None:
    published = linear_model(load_vehicle("interlink"), SAE_J2179_SPEED, "published")
    with pytest.raises(AnalysisError, match=r"interlink at 24.44 m/s: its steer axle cannot be held"):
        run_lane_change(published)


def test_unstable_vehicle_has_none() -> None:
    with pytest.raises(AnalysisError, match="unstable: there is no lane change"):
        run_lane_change(model_of("single_vehicle", "units.0.axles.1.cornering_stiffness=3e4"))
