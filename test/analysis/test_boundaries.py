"""Boundaries of stability: the claims of Frerichs (2012) on both models, and closed forms."""

import math
from collections.abc import Callable, Sequence

import numpy as np
import pytest

from random_vehicles import built_in_but_changed
from yawdamp_ros.analysis import (
    critical_speed,
    eigenvalue_locus,
    find_boundaries,
    least_damping_ratio,
    rightmost,
    speed_boundaries,
    zero_damping_speed,
)
from yawdamp_ros.analysis.speed_brackets import speed_brackets
from yawdamp_ros.analysis.steady_state import steady_steering
from yawdamp_ros.dynamics import LinearModel, linear_model
from yawdamp_ros.dynamics.speed_family import SpeedParts, StateMatrices
from yawdamp_ros.vehicle import load_vehicle

SPEED = 80 / 3.6
INTERLINK = load_vehicle("interlink")


def stiffness(*axles: int) -> list[str]:
    """Keys of axles as the report numbers them, 1 to 7."""
    places = [(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (2, 0), (2, 1)]
    return ["units.{}.axles.{}.cornering_stiffness".format(*places[axle - 1]) for axle in axles]


def varied(keys: Sequence[str], model: str, speed: float = SPEED) -> Callable[[float], LinearModel]:
    def at(value: float) -> LinearModel:
        return linear_model(load_vehicle("interlink", [f"{key}={value!r}" for key in keys]), speed, model)

    return at


@pytest.mark.parametrize(
    "keys, lowest, highest, model, crossings",
    [
        (stiffness(1), 20e3, 1.81e6, "published", []),
        (stiffness(1), 20e3, 1.81e6, "consistent", []),
        (stiffness(2, 3), 200e3, 600e3, "published", [(301.7e3, "monotonic")]),
        (stiffness(2, 3), 200e3, 600e3, "consistent", [(244.2e3, "monotonic")]),
        (stiffness(4, 5), 20e3, 1e6, "published", []),
        (stiffness(4, 5), 20e3, 1e6, "consistent", []),
        (stiffness(6, 7), 20e3, 1e6, "published", [(255.3e3, "oscillatory")]),
        (stiffness(6, 7), 20e3, 1e6, "consistent", []),
        (["units.1.mass"], 4156, 36000, "published", []),
        (["units.1.mass"], 4156, 36000, "consistent", []),
        (["units.2.mass"], 4415, 40000, "published", []),
        (["units.2.mass"], 4415, 40000, "consistent", []),
        (["units.0.mass"], 1000, 10000, "consistent", []),
    ],
)
def test_report_s_claims_on_stability(
    keys: list[str], lowest: float, highest: float, model: str, crossings: list[tuple[float, str]]
) -> None:
    values = np.linspace(lowest, highest, 16).tolist()
    found = eigenvalue_locus(varied(keys, model), values).boundaries
    assert [(round(b.value, -2), b.kind) for b in found] == crossings
    assert not any(b.unstable_above for b in found)


def test_published_model_is_unstable_with_a_truck_below_2457_kg() -> None:
    values = np.linspace(1000, 10000, 16).tolist()
    (boundary,) = eigenvalue_locus(varied(["units.0.mass"], "published"), values).boundaries
    assert boundary.value == pytest.approx(2456.5, abs=0.05)
    assert (boundary.kind, boundary.unstable_above) == ("oscillatory", False)


def test_published_model_is_unstable_below_12_2_m_s_and_never_above() -> None:
    (boundary,) = speed_boundaries(INTERLINK, "published")
    assert boundary.value == pytest.approx(12.2, abs=0.05)
    assert (boundary.kind, boundary.unstable_above) == ("oscillatory", False)
    assert critical_speed([boundary]) is None


def test_consistent_interlink_has_no_critical_speed() -> None:
    assert speed_boundaries(INTERLINK) == ()


def test_critical_speed_of_an_oversteering_car_is_the_textbook_one() -> None:
    # Where the steer angle (L + K u^2) / R of a steady turn vanishes.
    car = load_vehicle("single_vehicle", ["units.0.axles.1.cornering_stiffness=4e4"])
    steering = steady_steering(linear_model(car))
    (boundary,) = speed_boundaries(car)
    assert boundary.kind == "monotonic"
    assert boundary.unstable_above
    assert critical_speed([boundary]) == pytest.approx(
        math.sqrt(-steering.equivalent_wheelbase / steering.understeer_gradient)
    )


def test_crossing_lies_on_the_imaginary_axis_and_not_on_the_grid() -> None:
    at = varied(stiffness(6, 7), "published")
    (boundary,) = eigenvalue_locus(at, [1e5, 1e6]).boundaries
    eigenvalues = np.linalg.eigvals(at(boundary.value).state_matrix)
    nearest = eigenvalues[np.argmax(eigenvalues.real)]
    assert abs(nearest.real) < 1e-9
    assert abs(nearest.imag) == pytest.approx(boundary.frequency)


def test_a_falling_scan_finds_the_same_boundary() -> None:
    at = varied(stiffness(2, 3), "consistent")
    (rising,) = eigenvalue_locus(at, [2e5, 6e5]).boundaries
    (falling,) = eigenvalue_locus(at, [6e5, 2e5]).boundaries
    assert falling.value == pytest.approx(rising.value)
    assert falling.unstable_above == rising.unstable_above


def test_an_eigenvalue_through_infinity_is_no_crossing() -> None:
    def pole(value: float) -> complex:
        return complex(1.0 / (value - 1.4))

    (boundary,) = find_boundaries(pole, [(1.0, pole(1.0)), (2.0, pole(2.0))])
    assert boundary.kind == "jump"
    assert boundary.value == pytest.approx(1.4)


def test_zero_damping_speed_is_that_of_the_first_mode_that_swings() -> None:
    # The trailer's load far back: it sways; the car's rear tyres soft: it spins, and swings at no speed.
    trailer = load_vehicle("truck_trailer", ["units.1.front_hitch=11.483", "units.1.axles.0.position=0.24"])
    (sway,) = speed_boundaries(trailer)
    assert sway.kind == "oscillatory"
    assert zero_damping_speed([sway]) == critical_speed([sway]) == sway.value
    assert least_damping_ratio(linear_model(trailer, sway.value)) == pytest.approx(0.0, abs=1e-9)
    (spin,) = speed_boundaries(load_vehicle("single_vehicle", ["units.0.axles.1.cornering_stiffness=4e4"]))
    assert zero_damping_speed([spin]) is None


def test_critical_speeds_of_random_vehicles_are_those_of_a_finer_scan() -> None:
    generator, speeds = np.random.default_rng(23), np.linspace(0.5, 70.0, 1391)
    lost = 0
    for _ in range(40):
        vehicle = built_in_but_changed(generator)
        growth = np.linalg.eigvals(linear_model(vehicle, speeds).state_matrix).real.max(axis=1)
        places = np.flatnonzero((growth[:-1] <= 0.0) & (growth[1:] > 0.0))
        found = critical_speed(speed_boundaries(vehicle))
        if len(places):
            lost += 1
            assert speeds[places[0]] <= found <= speeds[places[0] + 1]
            assert abs(rightmost(linear_model(vehicle, found).state_matrix).real) < 1e-9
        else:
            assert found is None
    assert lost > 5


def test_two_changes_within_a_step_of_the_scan_are_seen() -> None:
    """An eigenvalue that is positive from 19.97 to 20.03 m/s alone."""
    # Re = 1 - (u - 20)^2 / 0.03^2 is no sum of 1, u and 1/u; near 20 m/s u/2 + 200/u is a parabola.
    slack = 0.5 * 20.03 + 200.0 / 20.03
    matrices = StateMatrices(SpeedParts(*(np.full((1, 1, 1), part) for part in (slack, -200.0, -0.5))))
    found = speed_brackets(matrices)
    assert found.refined(matrices) == pytest.approx([400.0 / 20.03, 20.03], abs=1e-9)
    assert found.unstable_above.tolist() == [True, False]


@pytest.mark.parametrize("model", ["consistent", "published"])
def test_matrices_of_any_speed_follow_from_three(model: str) -> None:
    matrices = StateMatrices.of(INTERLINK, model, 1)
    for speed in (0.5, 3.0, 22.0, 70.0):
        expected = linear_model(INTERLINK, speed, model).state_matrix
        np.testing.assert_allclose(matrices.at(speed)[0], expected, atol=1e-13 * np.abs(expected).max())
