"""The yaw damping coefficient is the damping ratio, and not half of it."""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import eig

from random_vehicles import built_in_but_changed, made_up
from yawdamp_ros import linear_model, load_vehicle
from yawdamp_ros.analysis import (
    MEASURES,
    AnalysisError,
    assess,
    damping_of_peaks,
    failed,
    modes,
    pulse_decay,
    yaw_damping_coefficient,
)
from yawdamp_ros.analysis.answers import Answers, stack_of
from yawdamp_ros.dynamics import LinearModel
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
    assert yaw_damping_coefficient(model) == pytest.approx(lightest.damping_ratio, rel=0.01)


@given(st.floats(0.01, 0.6), st.floats(0.5, 5.0), st.floats(0.0, math.tau))
def test_coefficient_of_a_damped_sine_is_its_damping_ratio(
    damping: float, frequency: float, phase: float
) -> None:
    time = np.linspace(0.0, 12.0 / (damping * frequency), 20_000)
    swing = np.sin(frequency * math.sqrt(1.0 - damping**2) * time + phase)
    values = np.exp(-damping * frequency * time) * swing
    assert damping_of_peaks(values) == pytest.approx(damping, rel=2e-3)


def test_growing_swings_have_a_negative_coefficient() -> None:
    time = np.linspace(0.0, 60.0, 5000)
    values = np.exp(0.1 * time) * np.sin(2.0 * time)
    assert damping_of_peaks(values) == pytest.approx(-0.1 / math.hypot(0.1, 2.0), rel=1e-3)


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
        assert yaw_damping_coefficient(model) == pytest.approx(expected, rel=0.01)


def test_motion_that_does_not_swing_has_none() -> None:
    time = np.linspace(0.0, 10.0, 1000)
    for values in (np.exp(-time), 3.0 + np.exp(-0.1 * time) * np.sin(5.0 * time), np.zeros(100)):
        with pytest.raises(AnalysisError, match="does not swing"):
            damping_of_peaks(values)


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
        yaw_damping_coefficient(model)


def softened(front: float, rear: float) -> Vehicle:
    """A-double with other tyres on the tractor's driven axles and on the last semitrailer."""
    changes = [f"units.0.axles.{axle}.cornering_stiffness={front}" for axle in (1, 2)]
    return load_vehicle(
        "a_double", [*changes, *(f"units.3.axles.{axle}.cornering_stiffness={rear}" for axle in range(3))]
    )


@pytest.mark.parametrize(
    "front, rear, damping, passed", [(3.236e5, 2.671e4, 0.1225, False), (3.193e5, 6.64e4, 0.1928, True)]
)
def test_slow_motion_beside_the_swing_does_not_change_its_damping(
    front: float, rear: float, damping: float, passed: object
) -> None:
    findings = {finding.measure.name: finding for finding in assess(softened(front, rear))}
    assert findings["yaw_damping_coefficient"].value == pytest.approx(damping, abs=5e-5)
    assert findings["yaw_damping_coefficient"].passed is passed


def test_excited_modes_on_either_side_of_the_level_are_told() -> None:
    finding = {found.measure.name: found for found in assess(softened(3.236e5, 2.671e4))}
    assert finding["yaw_damping_coefficient"].ambiguity == (
        "yaw_damping_coefficient could be read as 0.1225 to 0.444, on either side of its level"
    )
    sure = {found.measure.name: found for found in assess(softened(3.193e5, 6.64e4))}
    assert not sure["yaw_damping_coefficient"].ambiguity


def shares(model: LinearModel) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Eigenvalues of the pairs, and of each its amplitude after the pulse, over the largest and over all.

    By left and right eigenvectors, independently of the package.
    """
    values, left, right = eig(model.state_matrix, left=True)
    held = np.expm1(values * 0.5) / values
    last_rate = right[len(model.vehicle.units)]
    inputs = left.conj().T @ model.input_matrix / np.einsum("ij,ij->j", left.conj(), right)
    sizes = np.abs(last_rate * inputs * held)
    pairs = values.imag > 0.0
    return values[pairs], sizes[pairs] / max(sizes[pairs], default=1.0), sizes[pairs] / sizes.sum()


@pytest.mark.parametrize("make", [made_up, built_in_but_changed])
def test_no_verdict_on_2000_random_vehicles_is_contradicted_by_their_modes(
    make: Callable[[np.random.Generator], Vehicle],
) -> None:
    level, generator = 0.15, np.random.default_rng(2026)
    measure = MEASURES["yaw_damping_coefficient"]
    counts = {"pass": 0, "fail": 0, "none": 0}
    for _ in range(2000):
        model = linear_model(make(generator), 80 / 3.6)
        if np.linalg.eigvals(model.state_matrix).real.max() >= 0.0:
            assert not measure.answers(stack_of(model)).values[0] >= level
            continue
        values, of_swings, of_all = shares(model)
        damping = -values.real / np.abs(values)
        seen = damping[(of_swings > 0.05) & (of_all > 1e-4)]
        try:
            found = measure.value(model)
        except AnalysisError:
            counts["none"] += 1
            assert not np.any(seen < 0.4)
            continue
        if found >= level:
            counts["pass"] += 1
            assert not np.any(seen < level)
        else:
            counts["fail"] += 1
            assert np.any(damping[of_swings > 0.005] < level)
        assert np.any(np.isclose(damping, found, rtol=1e-6))
    assert min(counts.values()) > 20


@pytest.mark.parametrize("speed", [80 / 3.6, 40.0])
def test_mode_that_swings_alone_has_the_same_damping_by_its_peaks(speed: float) -> None:
    """Only single vehicles have a mode that swings alone."""
    generator, compared = np.random.default_rng(7), 0
    while compared < 25:
        model = linear_model(built_in_but_changed(generator, "single_vehicle"), speed)
        values, of_swings, of_all = shares(model)
        alone = (of_swings > 1e-3).sum() == 1 and of_all.max(initial=0.0) > 0.499
        if alone and 0.0 < -values.real[0] / abs(values[0]) < 0.5:
            compared += 1
            assert damping_of_peaks(pulse_decay(model)) == pytest.approx(
                yaw_damping_coefficient(model), rel=2e-3
            )


def test_two_modes_that_beat_have_the_damping_of_the_lighter() -> None:
    """Two trailers that are alike but for a percent, behind a truck that hardly feels them."""
    for seed in range(5):
        generator = np.random.default_rng(seed)
        lighter, heavier = sorted(generator.uniform(0.05, 0.3, 2))
        state_matrix = np.zeros((4, 4))
        for index, (damping, frequency) in enumerate(((lighter, 3.0), (heavier, 3.05))):
            block = slice(2 * index, 2 * index + 2)
            real, imaginary = -damping * frequency, frequency * math.sqrt(1.0 - damping**2)
            state_matrix[block, block] = [[real, imaginary], [-imaginary, real]]
        mixing = generator.normal(size=(4, 4))
        model = replace(
            linear_model(load_vehicle("truck_trailer")),
            state_matrix=mixing @ state_matrix @ np.linalg.inv(mixing),
            input_matrix=mixing @ np.ones(4),
        )
        assert yaw_damping_coefficient(model) == pytest.approx(lighter, rel=1e-9)


def test_growth_without_a_swing_is_no_pass() -> None:
    car = load_vehicle("single_vehicle", ["units.0.axles.1.cornering_stiffness=3e4"])
    assert yaw_damping_coefficient(linear_model(car, 40.0)) == -1.0


def test_faint_mode_below_the_level_leaves_no_pass() -> None:
    answers = Answers(np.array([0.3]), {}, np.array([[0.1, 0.3]]))
    measure = replace(MEASURES["yaw_damping_coefficient"], answers=lambda _: answers)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("yawdamp_ros.analysis.assessment.MEASURES", {**MEASURES, measure.name: measure})
        finding = next(each for each in assess(load_vehicle("interlink")) if each.measure is measure)
        assert finding.passed is None
        assert failed([finding])
