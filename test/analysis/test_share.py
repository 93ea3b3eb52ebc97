"""Many vehicles against a level: each as it would be judged alone."""

import json

import pytest

from yawdamp_ros.analysis import AnalysisError, assess, load_scheme, outcome
from yawdamp_ros.analysis.points import Draws
from yawdamp_ros.analysis.share import SchemeStudy, share_of
from yawdamp_ros.analysis.study import Study
from yawdamp_ros.cli import run
from yawdamp_ros.vehicle import load_vehicle, vehicle_text

MEASURES = (
    "low_speed_swept_path,static_rollover_threshold,rearward_amplification_steer_axle,"
    "high_speed_transient_offtracking"
)
KEYS = (("units.3.cg_height",), ("units.3.mass",))
SPANS = [(1.6, 3.0), (20000.0, 36000.0)]


def test_the_share_is_that_of_vehicles_judged_one_by_one() -> None:
    scheme = load_scheme("pbs", MEASURES)
    text = vehicle_text("a_double")
    study = SchemeStudy(
        tuple(Study(text, "a_double", (), "consistent", KEYS, name) for name in scheme.measures)
    )
    points = Draws(SPANS, 12, 3)[:]
    share = share_of(scheme, study.columns, study.evaluate(points), "4")
    passed, reached, falling = 0, [], 0
    for height, mass in points.tolist():
        vehicle = load_vehicle("a_double", [f"{KEYS[0][0]}={height!r}", f"{KEYS[1][0]}={mass!r}"])
        found = assess(vehicle, scheme=scheme, level="4")
        values = {each.measure.name: each for each in found}
        passed += not any(each.passed is False for each in found)
        falling += values["static_rollover_threshold"].passed is False
        reached.append(outcome(found, scheme).reached)
    assert 0 < passed < len(points)
    assert share.meeting == pytest.approx(passed / len(points))
    assert share.failing["static_rollover_threshold"] == pytest.approx(falling / len(points))
    assert share.reaching["4"] == pytest.approx(sum(level is not None for level in reached) / len(points))
    assert share.unknown == ()


def test_the_command_says_which_share_meets_the_level_and_what_decides(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assumed = "tracking_ability_on_a_straight_path"
    measures = ["--measures", f"static_rollover_threshold,yaw_damping_coefficient,{assumed}"]
    drawn = ["--random", "8", "--range", "units.3.cg_height=1.6:3.0", "--jobs", "1"]
    command = ["assess", "--vehicle", "a_double", "--scheme", "pbs", *measures, *drawn]
    assert run(command) == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].startswith("a_double: ")
    assert lines[0].endswith(" % of 8 vehicles meet pbs (3 of 18 measures)")
    assert any(line.startswith("│ static_rollover_threshold │") for line in lines)
    assert lines[-1] == f"by assumptions for {assumed}"
    assert run([*command, "--format", "json"]) == 1
    found = json.loads(capsys.readouterr().out)
    assert 0.0 < found["meeting"] < 1.0
    assert found["assuming"] == [assumed]
    assert found["failing_alone"]["static_rollover_threshold"] == pytest.approx(1.0 - found["meeting"])


def test_a_measure_that_the_scheme_has_not_is_told_of() -> None:
    with pytest.raises(AnalysisError, match="measures: speed: pbs: expected one of startability"):
        load_scheme("pbs", "speed")


@pytest.mark.parametrize(
    "arguments, said",
    [
        (["--random", "5"], "--random: expected at least one --range KEY=A:B"),
        (["--range", "speed=10:20"], "--range: it goes with --random"),
        (["--random", "5", "--range", "speed=10:20", "--seed", "-1"], "--seed: -1: expected a whole number"),
        (["--random", "5", "--range", "speed=10:20", "--jobs", "0"], "--jobs: 0: expected a whole number"),
        (["--random", "5", "--range", "speed=20:30", "--html", "a.html"], "--html: not with --random"),
        (
            ["--random", "5", "--range", "speed=20:30", "--format", "csv"],
            "expected one --vehicle, and text or json",
        ),
    ],
)
def test_wrong_use_is_one_line(arguments: list[str], said: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["assess", "--scheme", "pbs", *arguments]) == 2
    assert said in capsys.readouterr().err
