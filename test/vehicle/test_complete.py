"""What the file does not give is assumed, and said to be."""

import pytest

from yawdamp_ros.vehicle import (
    STANDARD_GRAVITY,
    VehicleError,
    assumed,
    builtin_vehicles,
    complete,
    load_vehicle,
    static_loads,
)
from yawdamp_ros.vehicle.complete import is_dolly


@pytest.mark.parametrize("name", builtin_vehicles())
def test_every_builtin_is_completed_and_completing_twice_changes_nothing(name: str) -> None:
    full = complete(load_vehicle(name))
    assert complete(full) == full
    assert [each.key for each in assumed(full)] == []


@pytest.mark.parametrize("name", builtin_vehicles())
def test_static_loads_carry_the_weight(name: str) -> None:
    vehicle = load_vehicle(name)
    weight = STANDARD_GRAVITY * sum(unit.mass for unit in vehicle.units)
    assert sum(sum(unit.axles) for unit in static_loads(vehicle)) == pytest.approx(weight, rel=2e-3)


def test_what_is_given_is_not_assumed() -> None:
    keys = {
        each.key for each in assumed(load_vehicle("interlink", ["units.1.cg_height=1.9", "friction=0.5"]))
    }
    assert "units.1.cg_height" not in keys
    assert "friction" not in keys
    assert {"units.0.cg_height", "units.1.axles.0.track_width", "units.1.hitch_height"} <= keys
    assert "units.2.hitch_height" not in keys, "it has no rear hitch"


def test_fifth_wheels_couple_roll_and_drawbar_eyes_do_not() -> None:
    tractor, semitrailer, dolly, _ = complete(load_vehicle("a_double")).units
    assert (tractor.hitch_roll_stiffness, semitrailer.hitch_roll_stiffness) == (3.0e6, 0.0)
    assert dolly.hitch_roll_stiffness == 3.0e6


def test_an_empty_trailer_between_two_others_is_no_dolly() -> None:
    empty = load_vehicle("interlink", ["units.1.mass=4156"]).units[1]
    short = load_vehicle("a_double", ["units.dolly.front_overhang=0.6"]).units[2]
    assert not is_dolly(empty), "its axles are too far behind"
    assert not is_dolly(short), "its body reaches beyond its eye"
    assert is_dolly(load_vehicle("a_double").units[2])
    assert complete(load_vehicle("interlink", ["units.1.mass=4156"])).units[1].front_overhang == 1.2


def test_static_loads_are_given_for_all_axles_of_a_unit_or_none() -> None:
    with pytest.raises(VehicleError, match=r"units\.0\.axles\.1\.static_load: missing: expected on all"):
        load_vehicle("truck_trailer", ["units.0.axles.0.static_load=5e4"])
