"""Modes of the interlink, by Table 6 of Frerichs (2012) and by what eigenvalues obey."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from yawdamp_ros.analysis import least_damping_ratio, modes, rightmost
from yawdamp_ros.dynamics import linear_model
from yawdamp_ros.vehicle import builtin_vehicles, load_vehicle

INTERLINK = load_vehicle("interlink")


def test_modes_of_the_published_model_come_in_the_order_of_table_6() -> None:
    found = modes(linear_model(INTERLINK, 80 / 3.6, "published"))
    np.testing.assert_allclose(
        [mode.eigenvalue for mode in found],
        [-5.7256 + 23.2396j, -5.7256 - 23.2396j, -2.3315 + 1.3318j, -2.3315 - 1.3318j, -0.1135, -0.0917],
        atol=5.1e-5,
    )
    assert [mode.damping_ratio for mode in found] == pytest.approx(
        [0.239219, 0.239219, 0.868321, 0.868321, 1.0, 1.0], abs=1e-5
    )


def test_damping_ratios_of_the_consistent_interlink_at_80_km_h() -> None:
    found = modes(linear_model(INTERLINK, 80 / 3.6))
    assert [round(mode.damping_ratio, 3) for mode in found] == [0.658, 0.658, 0.754, 0.754, 0.754, 0.754]


def test_damping_ratios_of_the_consistent_interlink_at_34_m_s() -> None:
    found = modes(linear_model(INTERLINK, 34.0))
    assert [round(mode.damping_ratio, 3) for mode in found[::2]] == [0.479, 0.516, 0.584]


def test_lightest_mode_is_the_last_trailers() -> None:
    lightest = modes(linear_model(INTERLINK))[0]
    assert lightest.moving_units == ("trailer_2",)
    assert abs(lightest.yaw_rates[2]) == pytest.approx(1.0)


@given(st.sampled_from(builtin_vehicles()), st.floats(1.0, 60.0))
def test_modes_hold_every_eigenvalue_with_its_vector(name: str, speed: float) -> None:
    model = linear_model(load_vehicle(name), speed)
    found = modes(model)
    assert len(found) == len(model.state_matrix)
    assert sum(mode.eigenvalue for mode in found).real == pytest.approx(np.trace(model.state_matrix))
    assert found[0].damping_ratio == least_damping_ratio(model)
    for mode in found:
        assert np.abs(mode.yaw_rates).max() == pytest.approx(1.0)
        assert mode.undamped_frequency**2 == pytest.approx(
            mode.damped_frequency**2 + (mode.damping_ratio * mode.undamped_frequency) ** 2
        )


@given(st.floats(1.0, 60.0))
def test_a_model_is_stable_when_its_rightmost_eigenvalue_is_on_the_left(speed: float) -> None:
    model = linear_model(INTERLINK, speed, "published")
    assert (rightmost(model.state_matrix).real < 0.0) == (least_damping_ratio(model) > 0.0)


def test_an_eigenvalue_at_the_origin_has_no_damping() -> None:
    model = linear_model(load_vehicle("single_vehicle"))
    at_rest = dataclasses.replace(model, state_matrix=np.zeros_like(model.state_matrix))
    assert [mode.damping_ratio for mode in modes(at_rest)] == [0.0, 0.0]
