"""Typical mistakes, each with the line that its user sees."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from ruamel.yaml import YAML

from yawdamp_ros.cli import run
from yawdamp_ros.vehicle import VehicleError, builtin_vehicles, load_vehicle, suspicions, vehicle_text

Data = dict[str, Any]


def axles(data: Data) -> list[Data]:
    return [axle for unit in data["units"] for axle in unit["axles"]]


def scaled(places: Callable[[Data], list[Data]], key: str, factor: float) -> Callable[[Data], None]:
    """An edit that multiplies a number wherever it stands."""

    def edit(data: Data) -> None:
        for place in places(data):
            place[key] *= factor

    return edit


def units(data: Data) -> list[Data]:
    return list(data["units"])


def one(unit: int, key: str, value: float) -> Callable[[Data], None]:
    """An edit of one number of a unit."""

    def edit(data: Data) -> None:
        data["units"][unit][key] = value

    return edit


def shifted(unit: int, by: float) -> Callable[[Data], None]:
    """An edit that measures the positions of a unit from elsewhere."""

    def edit(data: Data) -> None:
        for axle in data["units"][unit]["axles"]:
            axle["position"] += by
        for hitch in {"front_hitch", "rear_hitch"} & data["units"][unit].keys():
            data["units"][unit][hitch] += by

    return edit


def turned(unit: int) -> Callable[[Data], None]:
    """An edit that counts the axles' positions of a unit backwards."""

    def edit(data: Data) -> None:
        for axle in data["units"][unit]["axles"]:
            axle["position"] *= -1.0

    return edit


REFUSED: dict[str, tuple[str, Callable[[Data], None], str]] = {
    "masses in tonnes": (
        "interlink",
        scaled(units, "mass", 1e-3),
        "units.0.mass: 9.2 kg on axles of 2.07694e+06 N/rad: is it in tonnes?",
    ),
    "one mass in tonnes": (
        "interlink",
        scaled(lambda data: data["units"][2:], "mass", 1e-3),
        "units.2.mass: 29.894 kg on axles of 1.26581e+06 N/rad: is it in tonnes?",
    ),
    "masses in grams": (
        "interlink",
        scaled(units, "mass", 1e3),
        "units.1.mass: 16906000.0: expected a mass in kg",
    ),
    "stiffness in kN/rad": (
        "interlink",
        scaled(axles, "cornering_stiffness", 1e-3),
        (
            "units.0.axles.0: cornering stiffness 891.384 N/rad, 0.00704 times the axle's load per rad: "
            "expected 2 to 12; is it in kN/rad, or the tyre load in kN?"
        ),
    ),
    "one axle in kN/rad": (
        "a_double",
        scaled(lambda data: axles(data)[3:4], "cornering_stiffness", 1e-3),
        (
            "units.1.axles.0: cornering stiffness 347.257 N/rad, 0.0055 times the axle's load per rad: "
            "expected 2 to 12; is it in kN/rad"
        ),
    ),
    "stiffness in N/deg": (
        "interlink",
        scaled(axles, "cornering_stiffness", 1 / 57.29578),
        (
            "units.0.axles.0: cornering stiffness 15557.6 N/rad, 0.123 times the axle's load per rad: "
            "expected 2 to 12; is it in N/deg?"
        ),
    ),
    "stiffness in kN/deg": (
        "a_double",
        scaled(axles, "cornering_stiffness", 1 / 57295.78),
        "times the axle's load per rad: expected 2 to 12; is it in kN/deg?",
    ),
    "tyre loads in kN": (
        "interlink_rated_tyres",
        scaled(axles, "tyre_load", 1e-3),
        "times the axle's load per rad: expected 2 to 12; is it in kN/rad, or the tyre load in kN?",
    ),
    "inertia in t m^2": (
        "a_double",
        scaled(units, "yaw_inertia", 1e-3),
        (
            "units.0.yaw_inertia: 29.91 kg m^2, a radius of gyration of 0.0551 m on a unit of 4.37 m: "
            "expected 0.1 to 1 times its length; is it in t m^2?"
        ),
    ),
    "speed in km/h": (
        "interlink",
        lambda data: data.update(speed=80),
        "speed: 80: expected a speed in m/s, from 0.01 to 70 (80 km/h is 22.2222)",
    ),
    "positions in mm": (
        "interlink",
        scaled(axles, "position", 1e3),
        "expected a distance from the unit's centre of gravity in metres",
    ),
    "truck measured from its front axle": (
        "a_double",
        shifted(0, -1.3647),
        (
            "units.0.axles: the centre of gravity is at an axle, tractor cannot stand on the others: are "
            "positions measured from the front axle?"
        ),
    ),
    "truck measured from its front axle, backwards": (
        "a_double",
        lambda data: (shifted(0, -1.3647)(data), turned(0)(data), one(0, "rear_hitch", 3.4)(data)),
        "units.0.axles: the centre of gravity is at an axle",
    ),
    "rear hitch counted backwards": (
        "a_double",
        one(0, "rear_hitch", 2.0353),
        "units.0.rear_hitch: 2.0353 m, ahead of the centre of gravity: is the sign right?",
    ),
    "front hitch counted backwards": (
        "truck_trailer",
        one(1, "front_hitch", -7.483),
        "units.1.front_hitch: -7.483 m, behind the centre of gravity: expected it ahead",
    ),
    "trailer measured from its hitch": (
        "interlink",
        shifted(2, -4.645),
        "units.2.front_hitch: 0 m, at the centre of gravity: expected it ahead",
    ),
    "trailer's axles counted backwards": (
        "interlink",
        turned(1),
        "units.1.axles.0.position: 5.225 m, ahead of the front hitch at 1.275 m: is the sign right?",
    ),
}
"""Files that no vehicle can be like, and what is said of each."""

DOUBTED: dict[str, tuple[str, Callable[[Data], None], str]] = {
    "stiffness of one tyre": (
        "interlink",
        scaled(axles, "cornering_stiffness", 0.25),
        (
            "units.0.axles.0: cornering stiffness 222846 N/rad, 1.76 times the axle's load per rad: expected "
            "2 to 12; is it of one tyre? It is of the whole axle"
        ),
    ),
    "tyre loads in kg": (
        "interlink_rated_tyres",
        scaled(axles, "tyre_load", 1 / 9.80665),
        "expected 2 to 12; is it in kgf/rad, or the tyre load in kg?",
    ),
    "60 km/h": ("interlink", lambda data: data.update(speed=60), "speed: 60 m/s is 216 km/h: is it in km/h?"),
    "ten times the mass": (
        "a_double",
        scaled(units, "mass", 10.0),
        "units.0.axles.0: static axle load 73 t: expected 1 to 20 t (10 more like it)",
    ),
    "a tenth of the inertia's root": (
        "a_double",
        scaled(units, "yaw_inertia", 0.05),
        "expected 0.1 to 1 times its length; is it in t m^2?",
    ),
    "trailer measured from its front axle": (
        "interlink",
        shifted(2, 3.205),
        (
            "units.2.axles.0.position: 0 m, exactly at the centre of gravity: are positions measured from an "
            "axle?"
        ),
    ),
    "trailer measured from its rear end": (
        "interlink",
        shifted(2, 6.0),
        "units.2.axles: all ahead of the centre of gravity, trailer_2 would lift its hitch",
    ),
    "truck measured from its rear end": (
        "truck_trailer",
        shifted(0, 6.0),
        "units.0.axles: the centre of gravity is not between the axles",
    ),
}
"""Files that may be meant, and what they are warned of."""

USE: dict[str, tuple[list[str], str]] = {
    "threshold in per cent": (
        ["assess", "--srt", "35"],
        "srt: 35.0: expected a static rollover threshold in g, 0.05 to 1.5",
    ),
    "page as PDF": (["assess", "--html", "x.pdf"], "--html: x.pdf: expected a name ending in .html or .htm"),
    "option twice": (["assess", "--speed", "20", "--speed", "25"], "--speed: given twice; expected it once"),
    "key twice": (
        ["stability", "--set", "units.1.mass=9000", "--set", "units.1.mass=8000"],
        "--set: units.1.mass: given twice; expected it once",
    ),
    "speed in both ways": (
        ["stability", "--speed", "20", "--set", "speed=25"],
        "--set: speed: given twice; expected it once",
    ),
    "speed in km/h": (["stability", "--speed", "80"], "speed: 80.0: expected a speed in m/s"),
    "amplitude in degrees": (
        ["simulate", "--manoeuvre", "step", "--amplitude", "5"],
        "amplitude: 5.0: expected an angle in rad",
    ),
    "picture as PDF": (
        ["plot", "run.csv", "--output", "x.pdf"],
        "--output: x.pdf: expected a name ending in",
    ),
    "counted from behind": (
        ["stability", "--set", "units.-1.mass=9000"],
        "units.-1.mass: -1: expected an index, 0 or more",
    ),
}
"""Command lines, and what is said of each."""


def edited(name: str, edit: Callable[[Data], None], tmp_path: Path) -> Path:
    data = YAML(typ="safe", pure=True).load(vehicle_text(name))
    edit(data)
    path = tmp_path / "mine.yaml"
    with path.open("w", encoding="utf-8") as file:
        YAML(typ="safe", pure=True).dump(data, file)
    return path


def test_there_are_26_mistakes_and_more() -> None:
    assert len(REFUSED) + len(DOUBTED) + len(USE) >= 26


@pytest.mark.parametrize("name, edit, line", REFUSED.values(), ids=REFUSED)
def test_a_vehicle_that_cannot_be_is_refused(
    name: str, edit: Callable[[Data], None], line: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = edited(name, edit, tmp_path)
    assert run(["stability", "--vehicle", str(path)]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.count("\n") == 1
    assert captured.err.startswith("yawdamp stability: ")
    assert line in captured.err
    with pytest.raises(VehicleError):
        load_vehicle(path)


@pytest.mark.parametrize("name, edit, line", DOUBTED.values(), ids=DOUBTED)
def test_a_vehicle_that_may_be_meant_is_warned_of(
    name: str, edit: Callable[[Data], None], line: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = edited(name, edit, tmp_path)
    assert run(["stability", "--vehicle", str(path)]) in {0, 1}
    captured = capsys.readouterr()
    assert captured.out
    lines = [found for found in captured.err.splitlines() if line in found]
    assert lines, captured.err
    assert lines[0].startswith(f"warning: {path}: ")
    with pytest.warns(UserWarning, match="mine.yaml"):
        load_vehicle(path)


@pytest.mark.parametrize("arguments, line", USE.values(), ids=USE)
def test_wrong_use_is_refused(arguments: list[str], line: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(arguments) == 2
    assert line in capsys.readouterr().err


def test_a_builtin_is_not_doubted_for_what_its_source_says(capsys: pytest.CaptureFixture[str]) -> None:
    for name in builtin_vehicles():
        assert run(["stability", "--vehicle", name]) in {0, 1}
    assert capsys.readouterr().err == ""
    assert suspicions(load_vehicle("single_vehicle"))  # a car, which is not


def test_a_builtin_that_is_changed_is_doubted_for_the_change(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["stability", "--set", "units.2.mass=1000"]) == 0
    expected = "warning: interlink: units.2.axles.0: static axle load 0.272 t: expected 1 to 20 t"
    assert expected in capsys.readouterr().err
