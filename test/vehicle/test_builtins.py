"""The vehicles that come with the package hold what their descriptions say."""

import dataclasses
import json
from pathlib import Path

import numpy as np
import pytest

from yawdamp_ros.dynamics import linear_model
from yawdamp_ros.nonlinear import NonlinearDynamics, steady_turn
from yawdamp_ros.plain_yaml import parse_yaml
from yawdamp_ros.vehicle import (
    STANDARD_GRAVITY,
    Unit,
    builtin_vehicles,
    load_vehicle,
    static_loads,
    vehicle_text,
)
from yawdamp_ros.vehicle.load import MOST_VALUES
from yawdamp_ros.vehicle.schema import check_schema

INTERLINK = load_vehicle("interlink")
GHANDRIZ = json.loads((Path(__file__).parents[1] / "data" / "ghandriz_2020.json").read_text(encoding="utf-8"))


def test_builtins_are_those_of_the_contract() -> None:
    assert set(builtin_vehicles()) == {
        "a_double",
        "a_double_ghandriz",
        "interlink",
        "interlink_equal_trailers",
        "interlink_quarter_stiffness",
        "interlink_rated_tyres",
        "interlink_swapped",
        "nordic_combination",
        "single_vehicle",
        "tractor_semitrailer",
        "truck_trailer",
    }


@pytest.mark.parametrize("name", builtin_vehicles())
def test_builtins_keep_to_the_schema(name: str) -> None:
    check_schema(parse_yaml(vehicle_text(name), MOST_VALUES), name)


def test_quarter_stiffness_differs_from_the_interlink_in_that_alone() -> None:
    units = [
        dataclasses.replace(
            unit,
            axles=tuple(
                dataclasses.replace(axle, cornering_stiffness=pytest.approx(axle.cornering_stiffness / 4))
                for axle in unit.axles
            ),
        )
        for unit in INTERLINK.units
    ]
    assert list(load_vehicle("interlink_quarter_stiffness").units) == units


def lighter(unit: Unit, ratio: float) -> Unit:
    axles = tuple(
        dataclasses.replace(axle, static_load=pytest.approx(ratio * axle.static_load)) for axle in unit.axles
    )
    return dataclasses.replace(unit, axles=axles)


def test_equal_trailers_are_trailer_1_twice() -> None:
    truck, trailer_1, _ = (lighter(unit, 0.77283250) for unit in INTERLINK.units)
    last = dataclasses.replace(trailer_1, name="trailer_2", rear_hitch=None)
    assert load_vehicle("interlink_equal_trailers").units == (truck, trailer_1, last)


def test_swapped_trailers_move_whole_with_the_middle_ones_hitch_at_its_first_axle() -> None:
    truck, short, long = INTERLINK.units
    middle = dataclasses.replace(long, name="trailer_1", rear_hitch=long.axles[0].position)
    last = dataclasses.replace(short, name="trailer_2", rear_hitch=None)
    assert load_vehicle("interlink_swapped").units == (truck, middle, last)


def test_a_double_has_the_least_damping_of_an_independent_model() -> None:
    # OpenPBS (performance-based-standards/OpenPBS at 86c5fe9), Adouble6x4, at 80 km/h.
    eigenvalues = np.linalg.eigvals(linear_model(load_vehicle("a_double")).state_matrix)
    assert min(-eigenvalues.real / abs(eigenvalues)) == pytest.approx(0.3721, abs=5e-5)


def test_the_nordic_combination_has_the_loads_and_the_stiffness_of_openpbs() -> None:
    # NordicCombination of the same: masses, positions from the front axle, and 5.5 times the load.
    truck, dolly, semitrailer = load_vehicle("nordic_combination").units
    front = truck.axles[0].position
    assert [round(axle.position - front, 6) for axle in truck.axles] == [0.0, -4.8, -6.2]
    assert truck.rear_hitch is not None
    assert round(truck.rear_hitch - front, 6) == -8.0
    assert [unit.mass for unit in (truck, dolly, semitrailer)] == [26000.0, 3200.0, 33800.0]
    for unit, loads in zip((truck, dolly, semitrailer), loads_of("nordic_combination"), strict=True):
        stiffness = [axle.cornering_stiffness for axle in unit.axles]
        np.testing.assert_allclose(stiffness, [5.5 * load for load in loads], rtol=1e-6)


def test_the_a_double_of_ghandriz_holds_his_numbers_and_the_slope_of_his_tyre() -> None:
    vehicle = load_vehicle("a_double_ghandriz")
    for unit, given in zip(vehicle.units, GHANDRIZ["units"], strict=True):
        assert {name: getattr(unit, name) for name in given} == given
    axles = [axle for unit in vehicle.units for axle in unit.axles]
    for axle, given in zip(axles, GHANDRIZ["axles"], strict=True):
        load = given["static_load"] / given["wheels"]
        law = GHANDRIZ["nonlinear_tyre"]["steered" if given["steered_tyre"] else "others"]
        slope = given["static_load"] * law["c0"] * (1.0 - 0.1 * (load - 25000.0) / 25000.0)
        assert (axle.position, axle.static_load) == (given["position"], given["static_load"])
        assert axle.cornering_stiffness == pytest.approx(slope, abs=0.1)


def loads_of(name: str) -> list[tuple[float, ...]]:
    return [each.axles for each in static_loads(load_vehicle(name))]


@pytest.mark.parametrize("name", builtin_vehicles())
def test_the_axles_of_a_builtin_carry_its_weight_and_no_hitch_pulls(name: str) -> None:
    weight = STANDARD_GRAVITY * sum(unit.mass for unit in load_vehicle(name).units)
    assert sum(map(sum, loads_of(name))) == pytest.approx(weight, rel=5e-4)
    assert min(each.front_hitch for each in static_loads(load_vehicle(name))) >= 0.0
    assert min(map(min, loads_of(name))) > 3000.0


@pytest.mark.parametrize("name", builtin_vehicles())
def test_a_builtin_turns_steadily_by_the_nonlinear_model(name: str) -> None:
    dynamics = NonlinearDynamics(load_vehicle(name))
    turn = steady_turn(dynamics, 15.0, dynamics.inputs(), lateral_acceleration=1.0)
    np.testing.assert_allclose(turn.outputs.yaw_rate[0], 1.0 / 15.0, rtol=1e-6)
    assert (turn.outputs.roll[0] > 0.0).all()


def test_the_tractor_semitrailer_turns_as_chrono_s_does() -> None:
    # Chrono's Kraz at 60 km/h on friction 0.8, as robertscholz22/autonomousim recorded it
    # (fixtures/chrono/truck_handling.json).
    dynamics = NonlinearDynamics(load_vehicle("tractor_semitrailer"))
    turn = steady_turn(dynamics, 16.4623, dynamics.inputs(), steering=0.0373291).outputs
    assert turn.yaw_rate[0] == pytest.approx(0.11455, rel=0.05)
    assert turn.articulation[0, 0] == pytest.approx(0.051715, rel=0.05)
    assert turn.roll[0, 0] == pytest.approx(0.0461, rel=0.05)
    assert turn.roll[0, 1] == pytest.approx(0.0456, rel=0.05)
