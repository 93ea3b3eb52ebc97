"""The prediction of a drive is what the stepper does under it."""

import numpy as np
import pytest

from yawdamp_ros import linear_model, load_vehicle
from yawdamp_ros.drives import Channel, Drive, inputs_of, predict
from yawdamp_ros.drives.by_motion import predict_by_motion
from yawdamp_ros.stepping import Stepper

TIMES = 0.01 * np.arange(1001)


def drive(angles: np.ndarray, **others: np.ndarray) -> Drive:
    held = {"steering": angles, **others}
    return Drive("made", {name: Channel(name, "made", TIMES, values) for name, values in held.items()})


@pytest.mark.parametrize("name", ["truck_trailer", "interlink"])
def test_a_drive_of_varying_speed_is_what_the_stepper_makes_of_it(name: str) -> None:
    vehicle = load_vehicle(name)
    angles = 0.03 * np.sin(TIMES) + 0.01 * np.sin(5.0 * TIMES)
    speed = 15.0 + 5.0 * np.sin(0.5 * TIMES)
    found = predict(vehicle, inputs_of(drive(angles, speed=speed), 20.0))
    stepper = Stepper(linear_model(vehicle, float(speed[0])), 0.001)
    rows = []
    for angle, now in zip(angles.tolist(), speed.tolist(), strict=True):
        stepper.change_speed(now)
        stepper.steer(angle)
        sample = stepper.sample()
        rows.append([*sample.yaw_rate, *sample.lateral_acceleration, *sample.articulation, *sample.yaw])
        stepper.advance(10)
    names = [
        *(
            f"{unit}/{quantity}"
            for quantity in ("yaw_rate", "lateral_acceleration")
            for unit in vehicle.unit_names
        ),
        *(f"articulation_{joint}" for joint in range(1, len(vehicle.units))),
        *(f"{unit}/yaw" for unit in vehicle.unit_names),
    ]
    for output, values in zip(names, np.array(rows).T, strict=True):
        np.testing.assert_allclose(found[output], values, atol=5e-4 * np.abs(values).max())


def test_a_drive_at_one_speed_is_exact() -> None:
    vehicle = load_vehicle("interlink")
    angles = 0.02 * np.sin(TIMES)
    found = predict(vehicle, inputs_of(drive(angles), 20.0))
    stepper = Stepper(linear_model(vehicle, 20.0), 0.01)
    for index, angle in enumerate(angles.tolist()):
        stepper.steer(angle)
        sample = stepper.sample()
        assert found["trailer_2/yaw_rate"][index] == pytest.approx(float(sample.yaw_rate[2]), abs=1e-12)
        stepper.advance()


def test_steering_between_two_instants_acts_by_its_mean() -> None:
    steering = Channel("steering", "made", np.array([0.0, 0.0025, 0.02]), np.array([0.0, 0.04, 0.08]))
    inputs = inputs_of(Drive("made", {"steering": steering}), 20.0)
    np.testing.assert_allclose(inputs.times, [0.0, 0.01, 0.02])
    np.testing.assert_allclose(inputs.steering, [0.0, 0.04, 0.08])
    np.testing.assert_allclose(inputs.mean_steering, [0.03, 0.04, 0.08])


def test_acceleration_stands_in_for_a_speed() -> None:
    inputs = inputs_of(drive(np.zeros(1001), acceleration=np.full(1001, 0.5)), 10.0)
    np.testing.assert_allclose(inputs.speed, 10.0 + 0.5 * TIMES, atol=1e-9)


def test_step_by_step_it_is_the_same() -> None:
    vehicle = load_vehicle("truck_trailer")
    made = drive(0.03 * np.sin(TIMES), speed=15.0 + np.sin(TIMES))
    inputs = inputs_of(made, 20.0)
    quick, slow = predict(vehicle, inputs), predict_by_motion(vehicle, inputs, "consistent")
    assert quick.keys() >= slow.keys()
    for output, values in slow.items():
        np.testing.assert_allclose(quick[output], values, atol=5e-4 * np.abs(values).max())
