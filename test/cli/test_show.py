"""The command `show`: what scripts and people read of it."""

import json
from pathlib import Path

import pytest

from yawdamp_ros.cli import run
from yawdamp_ros.vehicle import builtin_vehicles


def shown(capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    assert run(["show", *arguments]) == 0
    captured = capsys.readouterr()
    assert captured.err == ""
    return captured.out


def answer(capsys: pytest.CaptureFixture[str], *arguments: str) -> dict[str, object]:
    return json.loads(shown(capsys, *arguments, "--format", "json"))


@pytest.mark.parametrize("name", builtin_vehicles())
def test_a_builtin_is_shown_in_80_columns(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert max(map(len, shown(capsys, name).splitlines())) <= 80


def test_a_long_name_folds(capsys: pytest.CaptureFixture[str]) -> None:
    text = shown(capsys, "a_double", "--set", f"units.1.name={'long_' * 12}name")
    assert max(map(len, text.splitlines())) <= 80


def test_masses_loads_wheelbases_and_hitches_are_those_of_the_vehicle(
    capsys: pytest.CaptureFixture[str],
) -> None:
    report = answer(capsys, "interlink")
    assert report["mass"] == 56000.0
    truck, trailer_1, trailer_2 = report["units"]
    assert [axle["static_load"] for axle in truck["axles"]] == [65687.76, 76959.44, 76959.44]
    assert truck["wheelbase"] == pytest.approx(0.040 + 0.5 * (3.719 + 5.119))
    assert trailer_1["wheelbase"] == pytest.approx(1.275 + 0.5 * (5.225 + 6.625))
    assert (truck["hitch_load"], trailer_2["front_hitch"]) == (None, 4.645)
    # By Table 5: what trailer 2 weighs and its axles do not carry.
    assert trailer_2["hitch_load"] == pytest.approx(29894.0 * 9.80665 - 2 * 83331.04)


def test_every_number_of_the_nonlinear_model_is_either_given_or_assumed(
    capsys: pytest.CaptureFixture[str],
) -> None:
    for name in builtin_vehicles():
        report = answer(capsys, name)
        supposed = {each["key"] for each in report["assumed"]}
        assert not supposed & set(report["given"])
        assert "friction" in supposed | set(report["given"])
        for index, unit in enumerate(report["units"]):
            known = supposed | set(report["given"])
            assert f"units.{index}.cg_height" in known
            assert {f"units.{index}.axles.{place}.driven" for place in range(len(unit["axles"]))} <= known


def test_what_is_assumed_is_marked_and_comes_with_its_source(capsys: pytest.CaptureFixture[str]) -> None:
    text = shown(capsys, "truck_trailer", "--set", "units.0.cg_height=1.3")
    (truck,) = (line for line in text.splitlines() if line.startswith("│ truck ") and "46.1" in line)
    (trailer,) = (line for line in text.splitlines() if line.startswith("│ trailer ") and "452.0" in line)
    assert "1.30 " in truck
    assert "2.00*" in trailer
    assert "Given, of what the nonlinear model alone needs:\n  cg_height (1)\n" in text
    assert "  cg_height (1): 2 m (Factbook: tractor 1.1, laden 2.0, dolly 0.9)\n" in text
    assert "  Factbook: Fancher, Ervin, Winkler" in text


def test_an_axle_load_of_kilograms_and_km_h_for_m_s_are_implausible(
    capsys: pytest.CaptureFixture[str],
) -> None:
    changes = ["--set", "units.1.mass=164.84", "--set", "speed=60"]
    problems = [
        (each["key"], each["problem"]) for each in answer(capsys, "truck_trailer", *changes)["implausible"]
    ]
    assert ("units.1.axles.0", "static axle load 0.11 t: expected 1 to 20 t") in problems
    assert any(key == "speed" and "is it in km/h?" in problem for key, problem in problems)
    assert "Implausible, axle loads by statics:\n  nothing\n" in shown(capsys, "truck_trailer")


def test_the_picture_is_written(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "vehicle.png"
    shown(capsys, "single_vehicle", "--plot", str(path))
    assert path.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    "arguments, message",
    [
        (["interlnk"], "interlnk: no such vehicle"),
        (["truck_trailer", "--set", "units.1.mass=16.484"], "units.1.mass: 16.484 kg on axles of"),
        (["--plot", "vehicle.pdf"], "vehicle.pdf: expected a name ending in .png or .svg"),
        (["interlink", "--set", "units.1.mass=heavy"], "units.1.mass: 'heavy': expected a mass in kg"),
    ],
)
def test_wrong_use_is_said_in_one_line(
    arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["show", *arguments]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert message in captured.err
    assert captured.err.count("\n") == 1
