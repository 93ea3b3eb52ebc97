"""Tyre property files are read strictly."""

from pathlib import Path

import pytest

from yawdamp_ros.vehicle import VehicleError, load_vehicle, parse_tir, read_tir, vehicle_text
from yawdamp_ros.vehicle.tir import COEFFICIENTS

TYRE = """$ a comment
[UNITS]
LENGTH = 'meter'
FORCE = 'newton'
[MODEL]
PROPERTY_FILE_FORMAT = 'PAC2002'   $ with a remark
[DIMENSION]
UNLOADED_RADIUS = 0.5
[VERTICAL]
FNOMIN = 35000
[SCALING_COEFFICIENTS]
LMUY = 0.9
[LATERAL_COEFFICIENTS]
PCY1 = 1.1
PDY1 = 0.85
PKY1 = -1.2e+001
PKY2 = 1.7
PTY1 = 2.0
PTY2 = 1.0
"""


def test_coefficients_are_read_and_missing_ones_are_neutral() -> None:
    tyre = parse_tir(TYRE, "truck.tir")
    found = dict(zip(COEFFICIENTS, tyre.coefficients, strict=True))
    assert (found["FNOMIN"], found["PCY1"], found["PKY1"], found["LMUY"]) == (35000.0, 1.1, -12.0, 0.9)
    assert (found["PHY1"], found["LKY"]) == (0.0, 1.0)
    assert tyre.relaxation_length == pytest.approx(1.0)


@pytest.mark.parametrize(
    "old, new, message",
    [
        ("PCY1 = 1.1", "PCY1 = 1.1.1", "line 14: PCY1: '1.1.1': expected a number"),
        ("PCY1 = 1.1", "PCY1 1.1", "line 14: 'PCY1 1.1': expected [SECTION] or KEY = value"),
        ("PCY1 = 1.1", "PCY1 = 1.1\nPCY1 = 1.2", "line 15: PCY1 stands twice in [LATERAL_COEFFICIENTS]"),
        ("PCY1 = 1.1\n", "", "[LATERAL_COEFFICIENTS] PCY1: missing"),
        ("PCY1 = 1.1", "PCY1 = nan", "line 14: PCY1: nan: expected a finite number"),
        ("[VERTICAL]\n", "", "[VERTICAL]: missing"),
        ("'PAC2002'", "'FTIRE'", "[MODEL] PROPERTY_FILE_FORMAT: 'FTIRE': expected one of PAC2002"),
        ("'newton'", "'pound_force'", "[UNITS] FORCE: 'pound_force': expected newton"),
        ("FNOMIN = 35000", "FNOMIN = 0", "FNOMIN: 0.0: expected a number above 0"),
        ("[DIMENSION]", "[UNITS]", "line 7: section [UNITS] stands twice"),
    ],
)
def test_what_is_wrong_is_said_in_one_line(old: str, new: str, message: str) -> None:
    assert old in TYRE
    with pytest.raises(VehicleError) as caught:
        parse_tir(TYRE.replace(old, new, 1), "truck.tir")
    assert str(caught.value).startswith(f"truck.tir: {message}")
    assert "\n" not in str(caught.value)


def test_a_vehicle_file_names_it_from_its_own_place(tmp_path: Path) -> None:
    (tmp_path / "truck.tir").write_text(TYRE, encoding="utf-8")
    text = vehicle_text("interlink").replace("steered: true", "steered: true, tyre: truck.tir")
    (tmp_path / "mine.yaml").write_text(text, encoding="utf-8")
    tyre = load_vehicle(tmp_path / "mine.yaml").units[0].axles[0].tyre
    assert tyre == read_tir(tmp_path / "truck.tir")


def test_a_file_that_is_not_there_is_said_to_be_missing(tmp_path: Path) -> None:
    with pytest.raises(VehicleError, match=r"none\.tir: cannot be read: No such file"):
        read_tir(tmp_path / "none.tir")
