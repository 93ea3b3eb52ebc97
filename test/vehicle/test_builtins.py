"""The vehicles that come with the package hold what their descriptions say."""

import dataclasses

import numpy as np
import pytest

from yawdamp_ros.dynamics import linear_model
from yawdamp_ros.plain_yaml import parse_yaml
from yawdamp_ros.vehicle import builtin_vehicles, load_vehicle, vehicle_text
from yawdamp_ros.vehicle.load import MOST_VALUES
from yawdamp_ros.vehicle.schema import check_schema

INTERLINK = load_vehicle("interlink")


def test_builtins_are_those_of_the_contract() -> None:
    assert set(builtin_vehicles()) == {
        "a_double",
        "interlink",
        "interlink_equal_trailers",
        "interlink_quarter_stiffness",
        "interlink_rated_tyres",
        "interlink_swapped",
        "single_vehicle",
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


def test_equal_trailers_are_trailer_1_twice() -> None:
    truck, trailer_1, _ = INTERLINK.units
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
