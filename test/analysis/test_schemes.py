"""Schemes: limits as data, verdicts against them."""

from pathlib import Path

import pytest

from yawdamp_ros.analysis import (
    AnalysisError,
    Assessment,
    Verdict,
    assess,
    builtin_schemes,
    load_scheme,
    outcome,
)
from yawdamp_ros.vehicle import load_vehicle

POWER = ["start_force=1.6e5", "drive_force=2e5", "drive_power=3.5e5"]
OWN = """\
name: own
title: a client's own
sources: [the client]
levels: [gold, silver]
measures:
  - measure: low_speed_swept_path
    require: [{most: [7.0, 8.0]}]
  - measure: rearward_amplification
    require: [{most: 5.7, times: static_rollover_threshold}, {above: 0.5}]
  - measure: static_rollover_threshold
"""


@pytest.mark.parametrize("name", builtin_schemes())
def test_a_builtin_scheme_is_named_as_its_file(name: str) -> None:
    assert load_scheme(name).name == name


@pytest.mark.parametrize("name", builtin_schemes())
def test_an_easier_level_never_asks_for_more(name: str) -> None:
    scheme = load_scheme(name)
    for each in scheme.requirements:
        assert list(each.limits) == sorted(each.limits, reverse=each.kind != "most")


def test_the_limit_of_amplification_is_that_of_the_computed_threshold() -> None:
    findings = {
        each.measure.name: each for each in assess(load_vehicle("a_double"), scheme=load_scheme("pbs"))
    }
    threshold = findings["rear_static_rollover_threshold"].value
    (limit,) = findings["rearward_amplification_steer_axle"].limits
    assert limit == pytest.approx(5.7 * threshold)


def test_a_threshold_that_is_given_takes_the_place_of_the_computed_one() -> None:
    found = assess(load_vehicle("a_double"), scheme=load_scheme("pbs"), srt=0.33)
    findings = {each.measure.name: each for each in found}
    assert findings["static_rollover_threshold"].value == 0.33
    assert findings["static_rollover_threshold"].passed is False
    assert findings["rearward_amplification_steer_axle"].limits == pytest.approx((5.7 * 0.33,))


def test_a_level_decides_and_the_level_that_is_reached_is_told() -> None:
    scheme, vehicle = load_scheme("pbs"), load_vehicle("a_double", POWER)
    easy, hard = (assess(vehicle, scheme=scheme, level=level, srt=0.42) for level in ("4", "2"))
    assert outcome(hard, scheme).verdict is Verdict.FAIL
    assert "high_speed_transient_offtracking" in outcome(hard, scheme).deciding
    assert outcome(easy, scheme).reached == outcome(hard, scheme).reached == "4"


def test_what_a_file_lacks_is_named_and_leaves_the_verdict_open() -> None:
    scheme = load_scheme("pbs")
    findings = assess(load_vehicle("interlink"), scheme=scheme)
    found = outcome(findings, scheme)
    assert found.verdict is Verdict.OPEN
    assert set(found.unknown) >= {
        "startability",
        "gradeability",
        "gradeability_speed",
        "acceleration_capability",
    }
    reasons = {each.measure.name: each.reason for each in findings}
    assert reasons["startability"] == "startability needs start_force, which the vehicle file does not give"


def test_an_own_scheme_is_a_file(tmp_path: Path) -> None:
    path = tmp_path / "own.yaml"
    path.write_text(OWN)
    scheme = load_scheme(path)
    findings = assess(load_vehicle("interlink"), scheme=scheme)
    assert [each.measure.name for each in findings] == list(scheme.measures)
    assert findings[0].reached == 1
    assert outcome(findings, scheme).reached == "silver"
    assert outcome(findings, scheme).deciding == ("low_speed_swept_path",)


@pytest.mark.parametrize(
    "old, new, said",
    [
        ("low_speed_swept_path", "swept", "own.yaml: measures.0: swept: expected one of"),
        ("[7.0, 8.0]", "[7.0, 8.0, 9.0]", "expected one, or one for each of 2 levels"),
        ("most: 5.7", "most: much", "require"),
        ("times: static_rollover_threshold", "times: height", "times: height: expected a measure"),
        (
            "- measure: static_rollover_threshold",
            "- measure: rearward_amplification",
            "expected every measure once",
        ),
        ("title: a client's own", "", "title: missing"),
        ("name: own", "name: [", "not valid YAML"),
    ],
)
def test_a_file_that_is_wrong_is_told_of_in_one_line(tmp_path: Path, old: str, new: str, said: str) -> None:
    path = tmp_path / "own.yaml"
    path.write_text(OWN.replace(old, new))
    with pytest.raises(AnalysisError) as told:
        load_scheme(path)
    assert said in str(told.value)
    assert "\n" not in str(told.value)


def test_there_is_no_other_scheme_and_no_other_level() -> None:
    with pytest.raises(AnalysisError, match="no such scheme; expected a file or one of lateral, pbs, rtac"):
        load_scheme("nowhere")
    with pytest.raises(AnalysisError, match="level: 5: pbs: expected one of 1, 2, 3, 4"):
        load_scheme("pbs").level("5")
    with pytest.raises(AnalysisError, match="the scheme has no levels"):
        load_scheme("rtac").level("1")


def test_a_light_last_trailer_keeps_its_body_in_the_turn() -> None:
    changes = ["units.2.rear_overhang=6", "units.2.yaw_inertia=60000", "units.2.mass=5900"]
    findings = assess(load_vehicle("interlink", changes), scheme=load_scheme("pbs", "tail_swing"))
    assert [finding.passed for finding in findings] == [False]
    assert findings[0].value == pytest.approx(0.745, abs=0.01)


def test_a_vehicle_that_does_not_stop_has_no_width_in_a_stop() -> None:
    vehicle = load_vehicle("a_double", ["units.*.axles.*.brake_share=0"])
    (finding,) = assess(vehicle, scheme=load_scheme("pbs", "directional_stability_under_braking"))
    assert (finding.value, finding.passed) == (None, None)
    assert "does not stop within 30 s" in finding.reason


def test_a_verdict_by_assumptions_says_so() -> None:
    scheme = load_scheme("pbs", "tracking_ability_on_a_straight_path")
    for width, passed, said in (("2.8", False, "FAILS pbs"), ("2.5", True, "meets pbs")):
        vehicle = load_vehicle("a_double", [f"units.*.width={width}"])
        assessed = Assessment(vehicle, "consistent", scheme, "1", assess(vehicle, scheme=scheme, level="1"))
        assert assessed.findings[0].passed is passed
        assert assessed.sentence.startswith(said)
        assert assessed.sentence.endswith("by assumptions for tracking_ability_on_a_straight_path")


def test_a_whole_assessment_can_be_met() -> None:
    vehicle = load_vehicle(Path(__file__).parents[2] / "docs" / "interlink_payload.yaml")
    scheme = load_scheme("pbs")
    found = outcome(assess(vehicle, scheme=scheme, level="2"), scheme)
    assert (found.verdict, found.reached, found.unknown) == (Verdict.PASS, "2", ())


def test_a_class_of_vehicles_has_limits_of_its_own() -> None:
    scheme = load_scheme("pbs", vehicle_class="bus")
    names = ("frontal_swing", "static_rollover_threshold", "tail_swing")
    bus = [scheme.of(name)[0].limits for name in names]
    assert bus == [(1.5,), (0.4,), load_scheme("pbs").of("tail_swing")[0].limits]
    assert scheme.name == "pbs for the class bus"
    with pytest.raises(AnalysisError, match="class: car: pbs: expected one of bus, tanker"):
        load_scheme("pbs", vehicle_class="car")
    with pytest.raises(AnalysisError, match="class: bus: rtac: expected none: the scheme has no classes"):
        load_scheme("rtac", vehicle_class="bus")


def test_nothing_is_met_by_measures_without_limits() -> None:
    scheme = load_scheme("pbs", "rear_static_rollover_threshold")
    found = outcome(assess(load_vehicle("a_double"), scheme=scheme), scheme)
    assert (found.verdict, found.reached) == (Verdict.OPEN, None)


def test_a_part_of_a_scheme_and_another_speed_are_told() -> None:
    scheme = load_scheme("pbs", "high_speed_transient_offtracking")
    vehicle = load_vehicle("a_double")
    said = Assessment(vehicle, "consistent", scheme, None, assess(vehicle, speed=5.0, scheme=scheme)).sentence
    assert said.startswith("meets pbs (1 of 18 measures)")
    assert said.endswith("not at the speed of the standard: high_speed_transient_offtracking")


def test_a_motion_that_diverges_leaves_the_other_measures() -> None:
    vehicle = load_vehicle("a_double", ["units.*.roll_inertia=1"])
    findings = {each.measure.name: each for each in assess(vehicle, scheme=load_scheme("rtac"))}
    assert findings["load_transfer_ratio"].value is None
    assert findings["high_speed_transient_offtracking"].value is not None
