"""The published model against every digit that Frerichs (2012) prints."""

import json
from collections.abc import Iterable, Sequence
from decimal import Decimal
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest

from yawdamp_ros.dynamics import DynamicsError, linear_model
from yawdamp_ros.dynamics.published import published_matrices
from yawdamp_ros.vehicle import load_vehicle

ROOT = Path(__file__).parents[2]
PRINTED = json.loads(
    (ROOT / "docs/report_reproduction/frerichs_2012.json").read_text(encoding="utf-8"),
    parse_float=Decimal,
    parse_int=Decimal,
)
SPEED = 80 / 3.6
TRAILER_1_FORWARD = (
    "units.1.front_hitch=0.275",
    "units.1.rear_hitch=-6.225",
    "units.1.axles.0.position=-6.225",
    "units.1.axles.1.position=-7.625",
)
TRAILER_2_REARWARD = (
    "units.2.front_hitch=5.645",
    "units.2.axles.0.position=-2.205",
    "units.2.axles.1.position=-3.605",
)


def prints_as(value: float, printed: Decimal) -> bool:
    """Whether a value, rounded to the decimals of a printed number, is that number."""
    half_a_digit = Decimal(5).scaleb(printed.as_tuple().exponent - 1)
    return abs(Decimal(float(value)) - printed) <= half_a_digit


def misprints(values: Iterable[float], printed: Iterable[Decimal]) -> dict[str, str]:
    """Printed numbers that a value does not round to, each with what it rounds to instead."""
    return {
        str(p): f"{v:.{-p.as_tuple().exponent}f}"
        for v, p in zip(values, printed, strict=True)
        if not prints_as(v, p)
    }


def eigenvalues(
    overrides: Sequence[str] = (), speed: float = SPEED, model: str = "published"
) -> npt.NDArray[np.complex128]:
    return np.linalg.eigvals(linear_model(load_vehicle("interlink", overrides), speed, model).state_matrix)


def assert_eigenvalues_print_as(
    values: npt.NDArray[np.complex128], printed: Sequence[Sequence[Decimal]]
) -> None:
    for real, imaginary in printed:
        assert any(prints_as(v.real, real) and prints_as(v.imag, imaginary) for v in values), real


def test_mass_matrix_is_appendix_b_to_every_printed_digit() -> None:
    mass = published_matrices(load_vehicle("interlink"), SPEED).mass
    assert misprints(mass.flat, np.array(PRINTED["mass_matrix"]).flat) == {}


def test_state_matrix_is_appendix_b_but_for_the_seventh_digit_of_three_entries() -> None:
    state_matrix = linear_model(load_vehicle("interlink"), SPEED, "published").state_matrix
    assert misprints(state_matrix.flat, np.array(PRINTED["state_matrix"]).flat) == {
        "48.27494": "48.27493",
        "9.842783": "9.842781",
        "4.654749": "4.654748",
    }


def test_state_matrix_is_appendix_b_to_every_printed_digit_at_a_speed_3e_6_lower() -> None:
    # So the report rounded 80/3.6, or what it computed from it, in the seventh digit.
    state_matrix = linear_model(load_vehicle("interlink"), 22.222219, "published").state_matrix
    assert misprints(state_matrix.flat, np.array(PRINTED["state_matrix"]).flat) == {}


@pytest.mark.parametrize("case", ["table_6", "at_34"])
def test_eigenvalues_are_the_printed_ones(case: str) -> None:
    printed = PRINTED[case]
    values = eigenvalues(speed=float(printed.get("speed", SPEED)))
    assert_eigenvalues_print_as(values, printed["eigenvalues"])


def test_frequencies_and_damping_of_table_6_are_those_of_its_rounded_eigenvalues() -> None:
    # From the eigenvalues as computed, the first frequency would be printed 23.93450 instead of 23.93453.
    printed = PRINTED["table_6"]
    values = [complex(float(real), float(imaginary)) for real, imaginary in printed["eigenvalues"]]
    assert misprints(map(abs, values), printed["undamped_frequency"]) == {}
    assert misprints([-v.real / abs(v) for v in values], printed["damping_ratio"]) == {}


def test_frequencies_and_damping_at_34_are_the_printed_ones() -> None:
    printed = PRINTED["at_34"]
    values = sorted(eigenvalues(speed=34.0), key=abs, reverse=True)
    frequencies = sorted(printed["undamped_frequency"], reverse=True)
    dampings = sorted(printed["damping_ratio"])
    assert misprints(map(abs, values), frequencies) == {}
    assert misprints(sorted(-v.real / abs(v) for v in values), dampings) == {}


def test_trailer_2_with_its_cg_1_m_rearward_is_unstable_as_printed() -> None:
    values = eigenvalues(TRAILER_2_REARWARD, speed=22.2)
    assert_eigenvalues_print_as(values, PRINTED["trailer_2_rearward"]["eigenvalues"])


@pytest.mark.parametrize(
    "overrides, published, consistent",
    [(TRAILER_1_FORWARD, 18.13, -1.79), (TRAILER_2_REARWARD, 1.44, -1.55)],
    ids=["trailer 1 forward", "trailer 2 rearward"],
)
def test_a_shifted_cg_destabilises_the_published_model_alone(
    overrides: Sequence[str], published: float, consistent: float
) -> None:
    assert eigenvalues(overrides).real.max() == pytest.approx(published, abs=0.005)
    assert eigenvalues(overrides, model="consistent").real.max() == pytest.approx(consistent, abs=0.005)


def test_state_matrix_depends_on_speed_as_a_constant_a_linear_and_a_reciprocal_term() -> None:
    vehicle = load_vehicle("interlink")
    at = {speed: linear_model(vehicle, speed, "published").state_matrix for speed in (5.0, 10.0, 20.0, 40.0)}
    terms = np.linalg.solve(
        [[1.0, u, 1.0 / u] for u in (5.0, 10.0, 20.0)],
        np.array([at[u].ravel() for u in (5.0, 10.0, 20.0)]),
    )
    np.testing.assert_allclose([1.0, 40.0, 0.025] @ terms, at[40.0].ravel(), rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize(
    "vehicle, overrides, said",
    [
        ("single_vehicle", (), "single_vehicle has 1 unit with 2 axles; expected 3 units with 3, 2, 2 axles"),
        ("truck_trailer", (), "truck_trailer has 2 units with 2, 1 axles"),
        ("interlink", ("units.1.axles.1.steered=true",), "steers another axle than the foremost"),
        ("interlink", ("units.1.rear_hitch=-5.0",), "trailer_1 has its rear hitch at -5 m; expected it at"),
    ],
)
def test_another_shape_is_refused_in_one_line(vehicle: str, overrides: Sequence[str], said: str) -> None:
    with pytest.raises(DynamicsError) as caught:
        linear_model(load_vehicle(vehicle, overrides), model="published")
    message = str(caught.value)
    assert said in message
    assert message.startswith("model: published: ")
    assert "\n" not in message
