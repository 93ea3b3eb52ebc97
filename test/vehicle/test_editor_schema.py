"""The schema for editors knows every spelling that the loader takes."""

import json
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator
from ruamel.yaml import YAML

from yawdamp_ros.vehicle import load_vehicle
from yawdamp_ros.vehicle.editor_schema import WRITTEN, editor_schema

ROOT = Path(__file__).parents[2]
ASSESSOR = """
name: assessor
speed_km_per_h: 80
units:
  - name: truck
    positions_from: front_axle
    cg_position_mm: -1500
    mass_t: 9.0
    yaw_inertia_t_m2: 30
    rear_hitch: -3.6
    axles:
      - {position: 0, cornering_coefficient: 5.5, steered: true}
      - {position_mm: -3400, cornering_coefficient: 5.5}
  - name: trailer
    positions_from: front_hitch
    cg_position: -5.0
    mass_t: 24
    yaw_inertia: 3.0e5
    front_hitch: 0
    axles:
      - {position: -7.0, cornering_coefficient: 5.5, lifted: true}
      - {position: -8.3, cornering_stiffness_kN_per_deg: 8, self_steering: true}
"""


def problems(text: str) -> list[str]:
    data = YAML(typ="safe", pure=True).load(text)
    return [error.message for error in Draft202012Validator(editor_schema()).iter_errors(data)]


def test_the_file_is_the_one_that_the_code_makes() -> None:
    written = json.loads((ROOT / "config" / WRITTEN).read_text(encoding="utf-8"))
    assert written == editor_schema(), "renew it with make parameters"
    Draft202012Validator.check_schema(written)


@pytest.mark.parametrize(
    "path",
    [*sorted((ROOT / "config" / "vehicles").glob("*.yaml")), ROOT / "docs" / "interlink_payload.yaml"],
    ids=lambda path: path.stem,
)
def test_a_file_that_loads_is_valid(path: Path) -> None:
    assert problems(path.read_text(encoding="utf-8")) == []


def test_what_assessors_write_loads_and_is_valid(tmp_path: Path) -> None:
    path = tmp_path / "assessor.yaml"
    path.write_text(ASSESSOR)
    assert load_vehicle(path).units[1].mass == 24000.0
    assert problems(ASSESSOR) == []


@pytest.mark.parametrize(
    "old, new, said",
    [
        ("mass_t: 9.0", "mass_tonnes: 9.0", "mass_tonnes"),
        ("    mass_t: 24\n", "", "is not valid under any of the given schemas"),
        ("cornering_coefficient: 5.5, steered", "steered", "is not valid under any of the given schemas"),
        ("speed_km_per_h: 80", "speed_km_per_h: 800", "800 is greater than the maximum"),
        ("positions_from: front_hitch", "positions_from: the_hitch", "is not one of"),
    ],
)
def test_a_slip_is_seen(old: str, new: str, said: str) -> None:
    assert old in ASSESSOR
    assert any(said in each for each in problems(ASSESSOR.replace(old, new)))


def test_a_bound_is_the_same_in_every_unit() -> None:
    def bounds(part: dict[str, Any], *keys: str) -> list[float]:
        return [part["properties"][key]["maximum"] for key in keys]

    made = editor_schema()["$defs"]["unit"]
    assert bounds(made, "cg_height_mm", "cg_height_cm", "cg_height") == [5000.0, 500.0, 5.0]
