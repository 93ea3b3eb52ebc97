import numpy as np
import pytest
from scipy.signal import cont2discrete, dlsim

from yawdamp_ros import linear_model, load_vehicle, simulate
from yawdamp_ros.manoeuvres import Chirp, Sine
from yawdamp_ros.stepping import SteppingError


def test_a_response_is_that_of_scipys_discrete_system() -> None:
    vehicle, steering = load_vehicle("interlink"), Chirp()
    response = simulate(vehicle, steering, 15.0)
    model = linear_model(vehicle)
    system = cont2discrete(
        (
            model.state_matrix,
            model.input_matrix[:, None],
            model.output_matrix,
            model.feedthrough[:, None],
        ),
        0.001,
    )
    _, outputs, _ = dlsim(system, response.steering_angle)
    names = model.output_names
    for index, unit in enumerate(vehicle.unit_names):
        np.testing.assert_allclose(
            response.yaw_rate[:, index], outputs[:, names.index(f"{unit}/yaw_rate")], atol=1e-10
        )
        np.testing.assert_allclose(
            response.lateral_acceleration[:, index],
            outputs[:, names.index(f"{unit}/lateral_acceleration")],
            atol=1e-9,
        )


def test_yaw_is_the_integral_of_yaw_rate() -> None:
    response = simulate(load_vehicle("interlink"), Sine(), 10.0)
    means = 0.5 * (response.yaw_rate[1:] + response.yaw_rate[:-1])
    np.testing.assert_allclose(np.cumsum(means, axis=0) * 0.001, response.yaw[1:], atol=2e-7)


def test_articulation_is_the_difference_of_yaw() -> None:
    response = simulate(load_vehicle("interlink"), Sine(), 5.0, sample_period=0.01)
    np.testing.assert_allclose(response.articulation, -np.diff(response.yaw, axis=1), atol=1e-15)


def test_samples_are_on_the_grid_from_the_first_instant_to_the_last() -> None:
    response = simulate(load_vehicle("truck_trailer"), Sine(), 2.0, sample_period=0.01)
    np.testing.assert_allclose(response.time, np.arange(201) / 100, atol=1e-15)
    assert response.yaw.shape == (201, 2)
    assert response.articulation.shape == (201, 1)


def test_speed_is_that_asked_for() -> None:
    vehicle = load_vehicle("interlink")
    response = simulate(vehicle, lambda _: 0.0, 1.0, speed=10.0)
    assert response.x[-1, 0] == pytest.approx(10.0)


@pytest.mark.parametrize("duration", [-1.0, float("nan"), float("inf"), 1e308, 1e10])
def test_a_duration_that_is_none_is_refused(duration: float) -> None:
    with pytest.raises(SteppingError, match="duration: "):
        simulate(load_vehicle("interlink"), Sine(), duration)


def test_an_array_is_steering_step_by_step() -> None:
    steering = Sine()
    angles = [steering(step / 1000) for step in range(2001)]
    by_function = simulate(load_vehicle("interlink"), steering, 2.0)
    for given in (angles, np.array(angles)):
        by_array = simulate("interlink", given, 2.0)
        np.testing.assert_array_equal(by_array.yaw_rate, by_function.yaw_rate)
        np.testing.assert_array_equal(by_array.steering_angle, by_function.steering_angle)
    without_end = simulate("interlink", angles[:-1], 2.0)
    np.testing.assert_array_equal(without_end.yaw_rate[:-1], by_function.yaw_rate[:-1])


@pytest.mark.parametrize("steering", [0.1, [0.1] * 10, np.zeros((2000, 1)), [np.nan] * 2000, "step", None])
def test_steering_that_is_none_is_refused(steering: object) -> None:
    with pytest.raises(
        SteppingError, match=r"^steering: .*expected a function of time in s, or 2000 finite angles, one for"
    ):
        simulate("interlink", steering, 2.0)  # type: ignore[arg-type] - that is the mistake


def test_a_motion_beyond_all_numbers_is_refused() -> None:
    skidding = [f"units.0.axles.{axle}.cornering_stiffness=50000" for axle in (1, 2)]
    vehicle = load_vehicle("interlink", skidding)
    with pytest.raises(SteppingError, match=r"interlink: unstable, beyond all numbers at 101 s"):
        simulate(vehicle, lambda _: 0.1, 1000.0, step_size=1.0)
