"""Every measure of a combination, against its levels."""

import numpy as np
import pytest

from yawdamp_ros import linear_model, load_vehicle
from yawdamp_ros.analysis import (
    MEASURES,
    AnalysisError,
    Finding,
    assess,
    failed,
    run_lane_change,
    steer_axle_position,
)
from yawdamp_ros.vehicle import builtin_vehicles


def found(vehicle: str, *overrides: str, **settings: float) -> dict[str, Finding]:
    findings = assess(load_vehicle(vehicle, overrides), **settings)
    return {finding.measure.name: finding for finding in findings}


def test_measures_are_those_of_the_field() -> None:
    assert list(MEASURES) == [
        "least_damping_ratio",
        "yaw_damping_coefficient",
        "understeer_gradient",
        "critical_speed",
        "rearward_amplification",
        "rearward_amplification_steer_axle",
        "rearward_amplification_yaw_rate",
        "rearward_amplification_peak_gain",
        "rearward_amplification_peak_frequency",
        "high_speed_transient_offtracking",
        "steady_offtracking",
    ]


@pytest.mark.parametrize("vehicle", builtin_vehicles())
def test_every_builtin_can_be_assessed(vehicle: str) -> None:
    findings = found(vehicle)
    missing = [name for name, finding in findings.items() if finding.value is None]
    assert set(missing) <= {"critical_speed"}


def test_each_measure_is_taken_at_its_standard_s_speed() -> None:
    findings = found("truck_trailer")
    assert findings["yaw_damping_coefficient"].speed == pytest.approx(80 / 3.6)
    assert findings["high_speed_transient_offtracking"].speed == pytest.approx(88 / 3.6)
    assert findings["least_damping_ratio"].speed == 20.0


def test_a_speed_that_is_given_is_that_of_all() -> None:
    assert {finding.speed for finding in found("truck_trailer", speed=15.0).values()} == {15.0}


def test_a_double_fails_where_b_doubles_pass() -> None:
    double, interlink = found("a_double"), found("interlink_rated_tyres")
    assert double["high_speed_transient_offtracking"].passed is False
    assert interlink["high_speed_transient_offtracking"].passed is True
    assert failed(double.values())
    assert not failed(interlink.values())
    assert double["rearward_amplification"].value > interlink["rearward_amplification"].value


def test_rollover_threshold_decides_on_rearward_amplification() -> None:
    name = "rearward_amplification_steer_axle"
    assert found("a_double")[name].passed is None
    assert found("a_double", srt=0.42)[name].passed is True
    assert found("a_double", srt=0.4)[name].passed is False


def test_amplification_over_the_steer_axle_is_over_what_the_lane_change_prescribes() -> None:
    run = run_lane_change(linear_model(load_vehicle("a_double"), 88.0 / 3.6))
    turning = np.gradient(run.yaw_rate[:, 0], run.time)
    axle = run.lateral_acceleration[:, 0] + steer_axle_position(load_vehicle("a_double")) * turning
    expected = np.abs(run.lateral_acceleration[:, -1]).max() / np.abs(axle).max()
    linear, nonlinear = (
        {each.measure.name: each.value for each in assess(load_vehicle("a_double"), model)}
        for model in ("consistent", "nonlinear")
    )
    assert linear["rearward_amplification_steer_axle"] == pytest.approx(expected, rel=1e-3)
    ratio = nonlinear["rearward_amplification_steer_axle"] / nonlinear["rearward_amplification"]
    assert 1.05 < ratio < 1.3


def test_another_level_than_that_of_the_threshold_can_still_be_failed() -> None:
    name = "rearward_amplification"
    assert found("a_double", speed=28.0)[name].value > 2.2
    assert found("a_double", speed=28.0)[name].passed is False


def test_unstable_vehicle_fails_and_says_what_it_has_no_value_for() -> None:
    findings = found("single_vehicle", "units.0.axles.1.cornering_stiffness=3e4", speed=40.0)
    assert findings["least_damping_ratio"].passed is False
    assert findings["critical_speed"].value < 40.0
    assert findings["rearward_amplification"].value is None
    assert findings["rearward_amplification"].passed is None
    assert "unstable" in findings["rearward_amplification"].reason


@pytest.mark.parametrize("srt", [0.0, -1.0, float("nan"), float("inf")])
def test_a_threshold_is_a_positive_number(srt: float) -> None:
    with pytest.raises(AnalysisError, match=r"srt: .*: expected a static rollover threshold in g"):
        found("interlink", srt=srt)
