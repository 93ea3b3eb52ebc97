"""Rearward amplification in time and by frequency agree with each other and with a long run."""

import numpy as np
import pytest

from yawdamp_ros import linear_model, load_vehicle, simulate
from yawdamp_ros.analysis import (
    AnalysisError,
    amplification_at,
    peak_amplification,
    rearward_amplification,
)
from yawdamp_ros.manoeuvres import Sine


def test_ratio_is_of_the_largest_magnitudes_of_the_ends() -> None:
    values = np.array([[0.0, 9.0, 0.0], [1.0, 9.0, 2.0], [-2.0, 9.0, -5.0]])
    assert rearward_amplification(values) == 2.5


def test_standstill_is_refused() -> None:
    with pytest.raises(AnalysisError, match="does not move"):
        rearward_amplification(np.zeros((5, 3)))


@pytest.mark.parametrize("name", ["interlink", "interlink_rated_tyres", "a_double"])
def test_peak_gain_is_that_of_a_long_sine_run_within_0_1_percent(name: str) -> None:
    model = linear_model(load_vehicle(name))
    peak = peak_amplification(model)
    run = simulate(model.vehicle, Sine(0.01, peak.frequency), 40.0, step_size=0.0005, sample_period=0.001)
    settled = run.lateral_acceleration[run.time > 25.0]
    assert rearward_amplification(settled) == pytest.approx(peak.gain, rel=1e-3)


@pytest.mark.parametrize("name", ["interlink", "a_double"])
def test_no_other_frequency_amplifies_more(name: str) -> None:
    model = linear_model(load_vehicle(name))
    peak = peak_amplification(model)
    assert amplification_at(model, np.array([peak.frequency]))[0] == pytest.approx(peak.gain)
    assert amplification_at(model, np.linspace(0.0, 4.0, 5000)).max() <= peak.gain * (1 + 1e-12)


def test_steady_turn_amplifies_nothing() -> None:
    model = linear_model(load_vehicle("a_double"))
    assert amplification_at(model, np.array([0.0]))[0] == pytest.approx(1.0)


def test_single_vehicle_has_a_gain_of_1_at_0_hz() -> None:
    peak = peak_amplification(linear_model(load_vehicle("single_vehicle")))
    assert (peak.gain, peak.frequency) == (1.0, 0.0)


def test_unstable_vehicle_has_no_steady_sine() -> None:
    car = load_vehicle("single_vehicle", ["units.0.axles.1.cornering_stiffness=3e4"])
    with pytest.raises(AnalysisError, match="unstable at 50 m/s: no sine is ever steady"):
        peak_amplification(linear_model(car, 50.0))
