"""A fit finds what a made drive was made of, and says what it cannot see."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lfilter

from made_drives import TRUTH, made_drive, source_of
from yawdamp_ros.drives import Channel, Drive, DriveError, identify, inputs_of, predict
from yawdamp_ros.drives.identification import predictor_of
from yawdamp_ros.drives.noise_model import fitted
from yawdamp_ros.vehicle import load_vehicle

SEEDS = 3


def test_the_truth_lies_within_most_intervals() -> None:
    inside = 0
    for seed in range(SEEDS):
        found = identify(made_drive("truck_trailer", seed), source_of("truck_trailer"))
        inside += sum(found[name].low <= truth <= found[name].high for name, truth in TRUTH.items())
        for name, truth in TRUTH.items():
            assert found[name].value == pytest.approx(truth, rel=0.1)
            assert found[name].seen
    # Of 9 intervals of 95 %, 7 or more hold the truth in 992 of 1000 such sets.
    assert inside >= 3 * SEEDS - 2


def test_the_identified_vehicle_explains_the_part_it_was_not_fitted_to() -> None:
    found = identify(made_drive("truck_trailer", 3), source_of("truck_trailer"))
    for before, after in zip(found.before, found.checked, strict=True):
        assert after.r_squared > max(before.r_squared, 0.9)
        assert after.rms_error < 2.0 * after.noise
    vehicle = load_vehicle("truck_trailer", found.overrides)
    own = load_vehicle("truck_trailer")
    assert vehicle.units[1].yaw_inertia / own.units[1].yaw_inertia == pytest.approx(
        found["inertia"].value, rel=1e-5
    )


def test_at_one_speed_a_steering_offset_is_no_different_from_those_of_sensors() -> None:
    times = 0.01 * np.arange(6001)
    angles = 0.02 * np.sin(times)
    steering = Channel("steering", "made", times, angles)
    outputs = predict(load_vehicle("truck_trailer"), inputs_of(Drive("made", {"steering": steering}), 20.0))
    noise = 0.003 * np.random.default_rng(8).normal(size=6001)
    held = {"steering": angles, "truck/yaw_rate": outputs["truck/yaw_rate"] + noise}
    drive = Drive("made", {name: Channel(name, "made", times, values) for name, values in held.items()})
    found = identify(drive, source_of("truck_trailer"), ("steering_offset",), speed=20.0)
    told = "steering_offset cannot be told from offset of truck/yaw_rate: correlations above 0.98"
    assert told in found.warnings


def test_what_straight_driving_does_not_show_is_said() -> None:
    times = 0.01 * np.arange(6001)
    rng = np.random.default_rng(4)
    held = {
        "steering": 1e-5 * rng.normal(size=6001),
        "speed": np.full(6001, 20.0),
        "truck/yaw_rate": 0.003 * rng.normal(size=6001),
    }
    drive = Drive("made", {name: Channel(name, "made", times, values) for name, values in held.items()})
    found = identify(drive, source_of("truck_trailer"), ("stiffness",))
    assert not found["stiffness"].seen
    assert found.warnings[0].startswith("stiffness cannot be seen in this drive: anything from ")


def test_a_key_of_the_vehicle_and_the_steering_are_fitted_alike() -> None:
    truth = {"units.1.mass": 14000.0, "steering_offset": 0.0}
    drive = made_drive("truck_trailer", 5, truth=truth)
    steering = drive["steering"]
    doubled = replace(
        drive, channels={**drive.channels, "steering": replace(steering, values=2.0 * steering.values)}
    )
    found = identify(doubled, source_of("truck_trailer"), ("units.1.mass", "steering_ratio"))
    assert found["steering_ratio"].value == pytest.approx(2.0, rel=0.02)
    assert found["units.1.mass"].low < 14000.0 < found["units.1.mass"].high
    assert found.overrides == [f"units.1.mass={found['units.1.mass'].value:.6g}"]


def test_friction_is_seen_by_the_nonlinear_model_where_tyres_saturate() -> None:
    predictor, truth = predictor_of("nonlinear"), {"friction": 0.4}
    drive = made_drive("truck_trailer", 2, 30.0, truth=truth, predictor=predictor, steering=0.025)
    found = identify(drive, source_of("truck_trailer"), ("friction",), predictor=predictor)
    friction = found["friction"]
    assert (friction.seen, friction.parameter.start) == (True, 0.8)
    assert friction.value == pytest.approx(0.4, rel=0.05)
    assert found.overrides == [f"friction={friction.value:.6g}"]


def test_a_drive_on_which_the_model_rolls_over_is_refused() -> None:
    drive, predictor = made_drive("truck_trailer", 2, 30.0, steering=0.1), predictor_of("nonlinear")
    with pytest.raises(DriveError, match=r"made: the model's motion ends \d+\.\d s into the drive"):
        identify(drive, source_of("truck_trailer"), predictor=predictor)


def test_steering_that_was_recorded_late_is_told_from_the_vehicle() -> None:
    drive = made_drive("truck_trailer", 9)
    steering = drive["steering"]
    late = replace(steering, times=steering.times + 0.06, values=steering.values)
    shifted = replace(drive, channels={**drive.channels, "steering": late})
    found = identify(shifted, source_of("truck_trailer"))
    assert found["steering_delay"].value == pytest.approx(-0.06, abs=0.01)
    assert found["stiffness"].value == pytest.approx(TRUTH["stiffness"], rel=0.04)


def test_a_lag_of_the_steering_is_found() -> None:
    drive = made_drive("truck_trailer", 6, truth={})
    step, lag = 0.01, 0.3
    wheel = drive["steering"].values
    kept = np.exp(-step / lag)
    # The hand that the wheels follow with the lag: the lag undone.
    hand = np.append(wheel[:1], (wheel[1:] - kept * wheel[:-1]) / (1.0 - kept))
    command = replace(drive["steering"], values=np.append(hand[1:], hand[-1]))
    found = identify(
        replace(drive, channels={**drive.channels, "steering": command}),
        source_of("truck_trailer"),
        ("steering_time_constant",),
    )
    assert found["steering_time_constant"].value == pytest.approx(lag, rel=0.1)


@pytest.mark.parametrize(
    "name, problem",
    [
        ("stifness", "stifness: expected one of stiffness, inertia, stiffness.UNIT"),
        ("stiffness.dolly", "stiffness.dolly: expected one of"),
    ],
)
def test_a_parameter_that_is_none_is_refused(name: str, problem: str) -> None:
    with pytest.raises(DriveError, match=problem):
        identify(made_drive("truck_trailer", 0, 10.0), source_of("truck_trailer"), (name,))


def test_a_drive_without_measurements_is_refused() -> None:
    drive = made_drive("truck_trailer", 0, 10.0)
    bare = replace(drive, channels={"steering": drive["steering"]})
    with pytest.raises(DriveError, match="nothing measured to fit to; expected one of yaw_rate"):
        identify(bare, source_of("truck_trailer"))


def test_coloured_noise_is_whitened() -> None:
    rng = np.random.default_rng(7)
    noise = np.zeros((20_000, 2))
    mixed = rng.normal(size=(20_000, 2)) @ np.array([[1.0, 0.5], [0.0, 1.0]])
    for index in range(1, len(noise)):
        noise[index] = 0.9 * noise[index - 1] + mixed[index]
    white = fitted(noise).whitened(noise)
    np.testing.assert_allclose(np.cov(white.T), np.eye(2), atol=0.03)
    for lag in (1, 2, 5):
        assert np.abs(white[lag:].T @ white[:-lag] / len(white)).max() < 0.03


def test_the_freedom_of_a_slow_spectrum_is_what_its_scatter_shows() -> None:
    rng = np.random.default_rng(11)
    levels, freedoms, orders = [], [], []
    for _ in range(200):
        slow = lfilter([1.0], [1.0, -0.95], rng.normal(size=3300))[300:]
        model = fitted((slow + 3.2 * rng.normal(size=3000))[:, np.newaxis])
        levels.append(2.0 * np.log(model.factor[0, 0] / (1.0 - model.coefficients.sum())))
        freedoms.append(model.freedom)
        orders.append(model.order)
    scattered = 2.0 / np.var(levels)
    assert np.mean(freedoms) == pytest.approx(scattered, rel=0.3)
    # The limit for noise of a short memory says far more.
    assert 3000 / (2.0 * np.mean(orders)) > 1.5 * scattered
