"""The nonlinear model in the commands: what it answers, and that its runs repeat."""

import json
from pathlib import Path

import pytest

from vehicle.test_tir import TYRE
from yawdamp_ros.cli import run
from yawdamp_ros.vehicle import vehicle_text

PNG = b"\x89PNG\r\n"


def severity(capsys: pytest.CaptureFixture[str], *arguments: str, status: int) -> dict[str, object]:
    asked = ["stability", "--vehicle", "interlink", "--model", "nonlinear", "--format", "json"]
    assert run([*asked, *arguments]) == status
    found: dict[str, object] = json.loads(capsys.readouterr().out)
    return found


def test_a_turn_that_tyres_can_hold_is_stable(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    picture = tmp_path / "severity.png"
    found = severity(capsys, "--turn", "0.2g", "--plot", str(picture), status=0)
    turns = found["turns"]
    assert isinstance(turns, list)
    assert (found["stable"], found["limit"]) == (True, None)
    assert turns[-1]["lateral_acceleration"] == pytest.approx(0.2 * 9.80665)
    dampings = [turn["least_damping_ratio"] for turn in turns]
    assert dampings == sorted(dampings, reverse=True), "tyres soften as the turn tightens"
    assert set(turns[0]["handling"]) == {"truck", "trailer_1", "trailer_2"}
    assert picture.read_bytes().startswith(PNG)


def test_no_turn_is_harder_than_the_road_lets_it_be(capsys: pytest.CaptureFixture[str]) -> None:
    found = severity(capsys, "--turn", "0.4g", "--friction", "0.2", status=1)
    turns = found["turns"]
    assert isinstance(turns, list)
    assert not found["stable"]
    assert str(found["limit"]).startswith("no steady motion at ")
    assert turns[-1]["lateral_acceleration"] < 0.2 * 9.80665


def test_braking_that_the_road_does_not_hold_has_no_steady_motion(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert severity(capsys, "--braking", "1.0", status=0)["stable"] is True
    assert severity(capsys, "--braking", "3.0", "--friction", "0.2", status=1)["stable"] is False


@pytest.mark.parametrize(
    "option, value, said",
    [
        ("--turn", "fast", "'fast': expected m/s^2 from 0 to 19.6, or g as in 0.2g"),
        ("--friction", "3", "--friction: 3: expected a number above 0 and below 2"),
        ("--braking", "-1", "--braking: -1: expected a number above 0 and below 9.80665"),
    ],
)
def test_a_severity_that_no_road_has_is_refused(
    capsys: pytest.CaptureFixture[str], option: str, value: str, said: str
) -> None:
    arguments = ["stability", "--vehicle", "interlink", "--model", "nonlinear", f"{option}={value}"]
    try:
        status = run(arguments)
    except SystemExit as end:
        status = int(end.code or 0)
    assert status == 2
    assert said in capsys.readouterr().err


def test_measures_differ_as_tyres_and_roll_make_them(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["assess", "--vehicle", "interlink", "--differences", "--format", "json"]) == 0
    found = {row["measure"]: row for row in json.loads(capsys.readouterr().out)}
    for row in found.values():
        assert row["difference"] == pytest.approx(row["nonlinear"] / row["consistent"] - 1.0, rel=1e-6)
    assert found["yaw_damping_coefficient"]["difference"] < -0.1
    assert found["rearward_amplification"]["difference"] > 0.1


def test_both_models_are_drawn_over_each_other(tmp_path: Path) -> None:
    picture = tmp_path / "both.png"
    manoeuvre = ["--manoeuvre", "step", "--amplitude", "0.02", "--duration", "3"]
    assert run(["plot", "--models", "consistent,nonlinear", *manoeuvre, "--output", str(picture)]) == 0
    assert picture.read_bytes().startswith(PNG)


def test_a_model_that_is_not_there_is_named(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["plot", "--models", "consistent,curved", "--manoeuvre", "step"]) == 2
    assert "curved" in capsys.readouterr().err.splitlines()[-1]


def test_a_run_with_a_tyre_file_repeats_where_the_file_is_not(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    (tmp_path / "truck.tir").write_text(TYRE)
    vehicle = tmp_path / "mine.yaml"
    vehicle.write_text(vehicle_text("a_double").replace("steered: true", "steered: true, tyre: truck.tir"))
    manoeuvre = ["--manoeuvre", "step", "--amplitude", "0.02", "--duration", "2"]
    recorded = tmp_path / "run"
    options = ["--vehicle", str(vehicle), "--model", "nonlinear", *manoeuvre, "--output", str(recorded)]
    assert run(["simulate", *options]) == 0
    (tmp_path / "truck.tir").unlink()
    vehicle.unlink()
    capsys.readouterr()
    assert run(["resimulate", str(recorded)]) == 0
    assert "bit" in capsys.readouterr().out


def test_static_loads_that_do_not_carry_the_weight_are_refused(capsys: pytest.CaptureFixture[str]) -> None:
    options = ["--vehicle", "interlink", "--set", "units.2.axles.*.static_load=50000", "--manoeuvre", "step"]
    assert run(["simulate", *options, "--duration", "1", "--model", "nonlinear"]) != 0
    said = capsys.readouterr().err.splitlines()
    assert len(said) == 1
    assert "the axles carry 49.22 t at rest, the units' masses sum to 56 t" in said[0]
