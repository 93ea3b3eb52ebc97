"""Cornering stiffness from load, by Frerichs (2012), Table 5, and by Fancher."""

import math
from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from yawdamp_ros.dynamics import linear_model
from yawdamp_ros.vehicle import VehicleError, fancher_stiffness, load_vehicle, printed_stiffness

LOADS = (32843.88, 19239.86, 19239.86, 20386.41, 20386.41, 20832.76, 20832.76)
TABLE_5 = (891384.14, 592777.40, 592777.40, 621796.91, 621796.91, 632902.54, 632902.54)
RATED = (283736, 377374, 377374, 395848, 395848, 402918, 402918)
TYRES = (2, 4, 4, 4, 4, 4, 4)


def stiffnesses(vehicle: str, overrides: Sequence[str] = ()) -> list[float]:
    units = load_vehicle(vehicle, overrides).units
    return [axle.cornering_stiffness for unit in units for axle in unit.axles]


@pytest.mark.parametrize("load, printed", zip(LOADS, TABLE_5, strict=True))
def test_printed_formula_gives_table_5_within_the_rounding_of_its_loads(load: float, printed: float) -> None:
    lowest, highest = printed_stiffness(load - 0.005), printed_stiffness(load + 0.005)
    assert lowest - 0.005 <= printed <= highest + 0.005


def test_rated_interlink_has_fanchers_stiffness_times_its_tyres() -> None:
    assert [round(value) for value in stiffnesses("interlink_rated_tyres")] == list(RATED)


def test_table_5_is_pi_times_fancher_on_two_tyres_and_half_of_pi_on_four() -> None:
    ratios = np.divide(stiffnesses("interlink"), stiffnesses("interlink_rated_tyres"))
    np.testing.assert_allclose(ratios, [math.tau / tyres for tyres in TYRES], rtol=1e-6)


@given(st.floats(1.0, 15000.0))
def test_fancher_in_pounds_force_and_degrees(pounds: float) -> None:
    load = pounds / 0.2248
    pounds_per_degree = pounds * (0.1 - pounds / 300000.0)
    assert fancher_stiffness(load) == pytest.approx(pounds_per_degree / 0.2248 * math.degrees(1.0), rel=1e-9)


def test_rated_interlink_is_damped_as_b_doubles_are() -> None:
    eigenvalues = np.linalg.eigvals(linear_model(load_vehicle("interlink_rated_tyres"), 22.2).state_matrix)
    dampings = sorted({round(-value.real / abs(value), 3) for value in eigenvalues})
    assert dampings == [0.498, 0.551, 0.568]


@pytest.mark.parametrize(
    "axle, said",
    [
        ("{position: 0.04, steered: true}", "expected a mapping with position and either"),
        ("{position: 0.04, tyre_load: 1e4, steered: true}", "expected a mapping with position and either"),
        ("{position: 0.04, tyres: 2, steered: true}", "expected a mapping with position and either"),
        (
            "{position: 0.04, tyre_load: 1e4, tyres: 2, cornering_stiffness: 1e5}",
            "either cornering_stiffness",
        ),
        ("{position: 0.04, tyres: 2, cornering_stiffness: 1e5}", "either cornering_stiffness"),
        ("{position: 0.04, tyre_load: 1e4, tyres: 2.5}", "tyres: 2.5: expected a whole number of tyres"),
        ("{position: 0.04, tyre_load: 7e4, tyres: 2}", "tyre_load: 70000.0: expected a vertical load"),
    ],
)
def test_an_axle_gives_its_stiffness_in_one_of_the_two_ways(axle: str, said: str) -> None:
    with pytest.raises(VehicleError) as caught:
        load_vehicle("interlink", [f"units.0.axles.0={axle}"])
    message = str(caught.value)
    assert message.startswith("interlink: units.0.axles.0")
    assert said in message
    assert "\n" not in message
