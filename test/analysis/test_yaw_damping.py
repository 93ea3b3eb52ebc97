"""The yaw damping coefficient is the damping ratio, and not half of it."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from yawdamp_ros import linear_model, load_vehicle
from yawdamp_ros.analysis import AnalysisError, modes, pulse_decay, yaw_damping_coefficient
from yawdamp_ros.stepping import Stepper
from yawdamp_ros.vehicle import Axle, Unit, Vehicle


def shifted(vehicle: Vehicle, index: int, forward: float) -> Vehicle:
    """Vehicle with one unit's centre of gravity moved; hitches and axles stay where they are."""

    def moved(position: float | None) -> float | None:
        return None if position is None else position - forward

    unit = vehicle.units[index]
    axles = tuple(
        Axle(axle.position - forward, axle.cornering_stiffness, axle.steered) for axle in unit.axles
    )
    changed: Unit = replace(
        unit, axles=axles, front_hitch=moved(unit.front_hitch), rear_hitch=moved(unit.rear_hitch)
    )
    return replace(vehicle, units=(*vehicle.units[:index], changed, *vehicle.units[index + 1 :]))


@pytest.mark.parametrize(
    "name, unit, forward, speed, damping",
    [
        ("truck_trailer", 1, -2.5, 44.0, 0.05),
        ("truck_trailer", 1, -2.25, 40.0, 0.11),
        ("truck_trailer", 1, -1.0, 40.0, 0.26),
        ("interlink_quarter_stiffness", 2, -2.5, 40.0, 0.11),
        ("interlink_quarter_stiffness", 2, -1.75, 20.0, 0.29),
        ("interlink_rated_tyres", 2, -2.75, 35.0, 0.22),
        ("interlink_rated_tyres", 2, -1.75, 30.0, 0.30),
        ("interlink", 2, -1.5, 30.0, 0.40),
        ("interlink_swapped", 2, 0.25, 30.0, 0.45),
        ("truck_trailer", 1, -1.0, 24.5, 0.5),
    ],
)
def test_decay_of_one_light_mode_gives_its_damping_ratio_within_1_percent(
    name: str, unit: int, forward: float, speed: float, damping: float
) -> None:
    model = linear_model(shifted(load_vehicle(name), unit, forward), speed)
    lightest, _, *others = modes(model)
    assert all(mode.eigenvalue.real < 1.5 * lightest.eigenvalue.real for mode in others)
    assert lightest.damping_ratio == pytest.approx(damping, abs=0.012)
    assert yaw_damping_coefficient(pulse_decay(model)) == pytest.approx(lightest.damping_ratio, rel=0.01)


@given(st.floats(0.01, 0.6), st.floats(0.5, 5.0), st.floats(0.0, math.tau))
def test_coefficient_of_a_damped_sine_is_its_damping_ratio(
    damping: float, frequency: float, phase: float
) -> None:
    time = np.linspace(0.0, 12.0 / (damping * frequency), 20_000)
    swing = np.sin(frequency * math.sqrt(1.0 - damping**2) * time + phase)
    values = np.exp(-damping * frequency * time) * swing
    assert yaw_damping_coefficient(values) == pytest.approx(damping, rel=2e-3)


def test_growing_swings_have_a_negative_coefficient() -> None:
    time = np.linspace(0.0, 60.0, 5000)
    values = np.exp(0.1 * time) * np.sin(2.0 * time)
    assert yaw_damping_coefficient(values) == pytest.approx(-0.1 / math.hypot(0.1, 2.0), rel=1e-3)


def test_growth_of_one_mode_gives_its_negative_damping_ratio() -> None:
    growing = shifted(load_vehicle("truck_trailer"), 1, -3.0)
    # Its slowest mode takes so long that the fastest outgrows all numbers meanwhile.
    heavy = [
        replace(
            unit,
            mass=1e7,
            yaw_inertia=1e10,
            axles=tuple(replace(axle, cornering_stiffness=0.001) for axle in unit.axles),
        )
        for unit in load_vehicle("interlink").units
    ]
    for vehicle in (growing, replace(load_vehicle("interlink"), units=tuple(heavy))):
        model = linear_model(vehicle, 60.0)
        expected = min(mode.damping_ratio for mode in modes(model))
        assert expected < 0.0
        assert yaw_damping_coefficient(pulse_decay(model)) == pytest.approx(expected, rel=0.01)


def test_first_swings_with_a_second_mode_in_them_are_left_out() -> None:
    time = np.linspace(0.0, 60.0, 50_000)
    light = np.exp(-0.2 * time) * np.sin(2.0 * time)
    heavy = 2.0 * np.exp(-1.0 * time) * np.sin(3.1 * time + 1.0)
    true = 0.2 / math.hypot(0.2, 2.0)
    assert yaw_damping_coefficient(light + heavy) == pytest.approx(true, rel=1e-3)
    assert abs(yaw_damping_coefficient(light + heavy, settling=0.0) / true - 1.0) > 0.02


def test_motion_that_does_not_swing_has_none() -> None:
    time = np.linspace(0.0, 10.0, 1000)
    for values in (np.exp(-time), 3.0 + np.exp(-0.1 * time) * np.sin(5.0 * time), np.zeros(100)):
        with pytest.raises(AnalysisError, match="does not swing"):
            yaw_damping_coefficient(values)


def test_decay_is_what_the_simulator_does_after_a_pulse() -> None:
    model = linear_model(load_vehicle("a_double"))
    step = 1.0 / (100.0 * np.abs(np.linalg.eigvals(model.state_matrix)).max())
    stepper = Stepper(model, step)
    stepper.steer(1.0)
    for _ in range(round(0.5 / step)):
        stepper.advance()
    stepper.steer(0.0)
    rates = []
    for _ in range(500):
        rates.append(stepper.sample().yaw_rate[-1])
        stepper.advance()
    # The pulse is a whole number of the simulator's steps, and 0.5 s but for that.
    np.testing.assert_allclose(pulse_decay(model)[:500], rates, atol=0.01 * np.abs(rates).max())


def test_crawling_vehicle_does_not_swing() -> None:
    model = linear_model(load_vehicle("truck_trailer"), 0.5)
    with pytest.raises(AnalysisError, match="does not swing"):
        yaw_damping_coefficient(pulse_decay(model))
