"""Vehicle files as assessors write them are those of canonical keys."""

import math
import re

import numpy as np
import pytest

from yawdamp_ros.analysis.swept_path import low_speed_swept_path
from yawdamp_ros.vehicle import (
    STANDARD_GRAVITY,
    VehicleError,
    load_stack,
    load_vehicle,
    parse_vehicle,
    static_loads,
    vehicle_text,
)
from yawdamp_ros.vehicle.load import VehicleSource, value_at

PLAIN = """\
name: truck
speed: 20.0
units:
  - name: truck
    mass: 20000.0
    yaw_inertia: 100000.0
    rear_hitch: -4.0
    load:
      - {mass: 1000.0, position: -1.0}
    axles:
      - {position: 2.0, cornering_stiffness: 400000.0, steered: true, track_width: 2.0}
      - {position: -3.0, cornering_stiffness: 800000.0}
  - name: trailer
    mass: 10000.0
    yaw_inertia: 50000.0
    front_hitch: 4.0
    max_articulation: 1.0
    axles:
      - {position: -1.0, cornering_stiffness: 500000.0}
"""
WRITTEN = """\
name: truck
speed_km_per_h: 72
units:
  - name: truck
    mass_t: 20
    yaw_inertia_t_m2: 100
    positions_from: front_axle
    cg_position: -2.0
    rear_hitch_mm: -6000
    load:
      - {mass_t: 1, position: -3.0}
    axles:
      - {position: 0, cornering_stiffness_kN_per_rad: 400, steered: true, track_width_mm: 2000}
      - {position: -5.0, cornering_stiffness_N_per_deg: 13962.634015954637}
      - {position: -6.3, cornering_stiffness: 1.0, lifted: true}
  - name: trailer
    mass_kg: 10000
    yaw_inertia: 50000
    positions_from: front_hitch
    cg_position: -4.0
    front_hitch: 0
    max_articulation_deg: 57.29577951308232
    axles:
      - {position_cm: -500, cornering_stiffness_kN_per_deg: 8.726646259971648}
"""


def test_units_in_keys_positions_from_the_front_and_lifted_axles_make_the_same_vehicle() -> None:
    plain, written = parse_vehicle(PLAIN, "plain"), parse_vehicle(WRITTEN, "written")
    assert repr(written).count("Axle(") == repr(plain).count("Axle(") == 3
    numbers = [re.findall(r"-?\d+\.?\d*(?:e-?\d+)?", repr(each)) for each in (plain, written)]
    assert [float(value) for value in numbers[1]] == pytest.approx(
        [float(value) for value in numbers[0]], rel=1e-12
    )


def test_a_cornering_coefficient_is_that_of_the_static_load() -> None:
    changes = ["units.*.axles.*.cornering_coefficient=5.5"]
    vehicle, published = load_vehicle("a_double", changes), load_vehicle("a_double")
    for unit, given, loads in zip(vehicle.units, published.units, static_loads(published), strict=True):
        for axle, known, load in zip(unit.axles, given.axles, loads.axles, strict=True):
            assert axle.cornering_stiffness == pytest.approx(5.5 * load)
            assert axle.cornering_stiffness == pytest.approx(known.cornering_stiffness, rel=3e-3)


def test_a_coefficient_follows_the_load_of_a_stack() -> None:
    masses = np.array([20000.0, 30000.0])
    key = "units.semitrailer_2.mass"
    changes = ["units.*.axles.*.cornering_coefficient=6"]
    stack = load_stack(vehicle_text("a_double"), "a_double", changes, {key: masses})
    for place, mass in enumerate(masses):
        alone = load_vehicle("a_double", [*changes, f"{key}={mass}"])
        assert stack.units[3].axles[0].cornering_stiffness[place] == pytest.approx(
            alone.units[3].axles[0].cornering_stiffness
        )


def test_keys_by_name_and_for_all() -> None:
    changed = load_vehicle("interlink", ["units.trailer_2.mass_t=25", "units.*.axles.*.track_width=1.9"])
    assert changed.units[2].mass == 25000.0
    assert {axle.track_width for unit in changed.units for axle in unit.axles} == {1.9}
    assert (
        value_at(VehicleSource(vehicle_text("interlink"), ()), "units.truck.mass")
        == load_vehicle("interlink").units[0].mass
    )


def test_a_self_steering_axle_shortens_the_wheelbase_of_the_turn() -> None:
    plain, last = load_vehicle("a_double"), 2
    steering = load_vehicle("a_double", [f"units.1.axles.{last}.self_steering=true"])
    assert low_speed_swept_path(steering) < low_speed_swept_path(plain) - 0.1
    assert steering.units[1].axles[last].cornering_stiffness == plain.units[1].axles[last].cornering_stiffness


def test_a_load_in_tonnes_is_a_force() -> None:
    text = PLAIN.replace("position: -1.0, cornering", "static_load_t: 6, position: -1.0, cornering")
    (axle,) = parse_vehicle(text, "file").units[1].axles
    assert axle.static_load == pytest.approx(6000.0 * STANDARD_GRAVITY)


@pytest.mark.parametrize(
    "old, new, said",
    [
        ("    mass: 10000.0\n", "    mass: 10000.0\n    mass_t: 10\n", "units.1.mass_t: mass is given twice"),
        ("    mass: 10000.0\n", "    mass_lb: 22000\n", "units.1.mass_lb: unknown key"),
        (
            "    front_hitch: 4.0\n",
            "    front_hitch: 4.0\n    positions_from: nose\n",
            "'nose': expected one of",
        ),
        (
            "    front_hitch: 4.0\n",
            "    front_hitch: 4.0\n    positions_from: front_axle\n",
            "cg_position: missing",
        ),
        ("    front_hitch: 4.0\n", "    front_hitch: 4.0\n    cg_position: 1\n", "expected positions_from"),
        (
            "position: -1.0, cornering_stiffness: 500000.0",
            "position: -1.0, cornering_coefficient: x",
            "expected",
        ),
        ("position: -1.0, cornering_stiffness: 500000.0", "position: -1.0, lifted: true", "units.1.axles"),
    ],
)
def test_what_is_wrong_is_named(old: str, new: str, said: str) -> None:
    assert old in PLAIN
    with pytest.raises(VehicleError) as told:
        parse_vehicle(PLAIN.replace(old, new), "file")
    assert said in str(told.value)


@pytest.mark.parametrize(
    "change, said",
    [
        ("units.caravan.mass=1", "units.caravan.mass: 'caravan': expected a number, *, or one of truck"),
        ("units.0.axles.front.position=1", "'front': expected a number or *"),
        ("name.first=x", "no such key to set"),
    ],
)
def test_a_key_that_leads_nowhere_says_what_there_is(change: str, said: str) -> None:
    with pytest.raises(VehicleError) as told:
        load_vehicle("interlink", [change])
    assert said in str(told.value)


def test_degrees_and_radians_agree() -> None:
    vehicle = parse_vehicle(WRITTEN, "file")
    assert vehicle.units[1].max_articulation == pytest.approx(1.0)
    assert vehicle.units[1].axles[0].cornering_stiffness == pytest.approx(
        8726.646259971648 * math.degrees(1.0)
    )


def test_a_lifted_axle_leaves_no_weight_in_the_air() -> None:
    said = "units.1.axles.0: lifted: expected no static_load on this unit"
    with pytest.raises(VehicleError, match=re.escape(said)):
        load_vehicle("interlink", ["units.1.axles.0.lifted=true"])


def test_positions_that_are_no_numbers_are_named() -> None:
    said = "units.0.positions_from: expected numbers for cg_position, hitches and positions"
    with pytest.raises(VehicleError, match=re.escape(said)):
        load_vehicle("truck_trailer", ["units.0.positions_from=front_axle", "units.0.cg_position=abc"])


def test_a_coefficient_needs_two_supports() -> None:
    one = "units.0.axles=[{position: 1, cornering_coefficient: 5, steered: true}]"
    with pytest.raises(VehicleError, match="cornering_coefficient needs the axles' loads"):
        load_vehicle("truck_trailer", [one])
    alike = ["units.0.axles.*.cornering_coefficient=5", "units.0.axles.*.steered=true"]
    stiffness = [axle.cornering_stiffness for axle in load_vehicle("truck_trailer", alike).units[0].axles]
    plain = load_vehicle("truck_trailer", alike[:1]).units[0].axles
    assert stiffness == pytest.approx([axle.cornering_stiffness for axle in plain])
