"""The prediction of a drive is what the stepper does under it."""

import numpy as np
import pytest

from yawdamp_ros import linear_model, load_vehicle
from yawdamp_ros.drives import Channel, Drive, Inputs, inputs_of, predict
from yawdamp_ros.drives.identification import predictor_of
from yawdamp_ros.simulation import make_motion
from yawdamp_ros.stepping import AppliedInput, Response, Stepper, TimeGrid
from yawdamp_ros.vehicle import Vehicle

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


def stepped(vehicle: Vehicle, inputs: Inputs, model: str) -> Response:
    """Run of a motion, five steps from one instant to the next."""
    motion = make_motion(vehicle, model, float(inputs.speed[0]), 0.002)
    motion.apply(AppliedInput(0, "steering", float(inputs.mean_steering[0])))
    samples = [motion.sample()]
    for speed, angle in zip(inputs.speed[1:].tolist(), inputs.mean_steering[1:].tolist(), strict=True):
        motion.advance(5)
        motion.apply(AppliedInput(motion.step, "speed", speed))
        motion.apply(AppliedInput(motion.step, "steering", angle))
        samples.append(motion.sample())
    return Response.of(samples, vehicle.unit_names, TimeGrid.of(0.002, 0.01))


@pytest.mark.parametrize("model, tolerance", [("consistent", 5e-4), ("nonlinear", 1e-9)])
def test_step_by_step_it_is_the_same(model: str, tolerance: float) -> None:
    vehicle = load_vehicle("truck_trailer")
    inputs = inputs_of(drive(0.03 * np.sin(TIMES), speed=15.0 + np.sin(TIMES)), 20.0)
    found, run = predictor_of(model)(vehicle, inputs), stepped(vehicle, inputs, model)
    for index, unit in enumerate(vehicle.unit_names):
        for quantity in ("yaw_rate", "lateral_acceleration", "yaw"):
            values = getattr(run, quantity)[:, index]
            np.testing.assert_allclose(
                found[f"{unit}/{quantity}"], values, atol=tolerance * np.abs(values).max()
            )
    angles = run.articulation[:, 0]
    np.testing.assert_allclose(found["articulation_1"], angles, atol=tolerance * np.abs(angles).max())


def test_after_a_rollover_the_nonlinear_model_says_nothing() -> None:
    made = drive(np.full(1001, 0.3), speed=np.full(1001, 25.0))
    found = predictor_of("nonlinear")(load_vehicle("tractor_semitrailer"), inputs_of(made, 25.0))
    unknown = np.isnan(found["tractor/yaw_rate"])
    assert 50 < np.argmax(unknown) < 900
    assert unknown[np.argmax(unknown) :].all()


def test_inputs_in_force_at_the_start_of_a_window_are_kept() -> None:
    times = np.arange(4.0)
    rare = np.array([0.0, 3.0])
    drive = Drive(
        "made",
        {
            "steering": Channel("steering", "made", times, 0.1 * times),
            "acceleration": Channel("acceleration", "made", rare, np.array([0.5, -0.5])),
            "yaw_rate": Channel("yaw_rate", "made", rare, rare),
        },
    )
    part = drive.window(1.5)
    assert (part["steering"].times.tolist(), part["yaw_rate"].times.tolist()) == ([0.5, 1.5], [1.5])
    assert part["acceleration"].times.tolist() == [0.0, 1.5]
    assert part["acceleration"].values.tolist() == [0.5, -0.5]
