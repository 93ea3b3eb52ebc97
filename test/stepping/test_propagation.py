import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import expm

from strategies import vehicles
from threads import answers_by_threads
from yawdamp_ros import linear_model, load_vehicle
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.stepping.propagation import LARGEST_PRODUCT
from yawdamp_ros.stepping.propagators import Propagators, exponential, propagator
from yawdamp_ros.vehicle import Vehicle


def extended_exponential(matrix: FloatArray) -> FloatArray:
    """Exponential by Taylor's series with a mantissa of 64 bits: scaled to a 32nd, 20 terms, squared."""
    squarings = max(int(np.ceil(np.log2(np.abs(matrix).sum(axis=0).max() * 32.0))), 0)
    scaled = matrix.astype(np.longdouble) / 2**squarings
    total = term = np.eye(len(matrix), dtype=np.longdouble)
    for power in range(1, 20):
        term = term @ scaled / power
        total = total + term
    for _ in range(squarings):
        total = total @ total
    return total.astype(np.float64)


@given(vehicles(), st.sampled_from([1e-6, 0.001, 0.01, 0.1, 1.0]))
def test_the_exponential_is_that_of_extended_precision(vehicle: Vehicle, step_size: float) -> None:
    matrix = linear_model(vehicle).state_matrix * step_size
    expected = extended_exponential(matrix)
    # The condition of an exponential is the norm of its argument, the rounding of a product its size.
    bound = 1e-12 + len(matrix) * np.finfo(np.float64).eps * np.abs(matrix).sum(axis=0).max()
    np.testing.assert_allclose(exponential(matrix), expected, rtol=0.0, atol=bound * np.abs(expected).max())


def test_the_exponential_of_a_rotation_is_one() -> None:
    turn = exponential(np.array([[0.0, -100.0], [100.0, 0.0]]))
    cosine, sine = np.cos(100.0), np.sin(100.0)
    np.testing.assert_allclose(turn, [[cosine, -sine], [sine, cosine]], atol=1e-13)


@pytest.mark.parametrize("name", ["single_vehicle", "truck_trailer", "interlink", "a_double"])
def test_products_are_too_small_to_be_split_over_threads(name: str) -> None:
    steps = propagator(linear_model(load_vehicle(name)), 0.001).steps
    assert steps.size < LARGEST_PRODUCT


def test_bits_of_up_to_50_units_do_not_depend_on_how_many_threads_there_are() -> None:
    program = """
import hashlib
import numpy as np
from random_vehicles import made_up
from yawdamp_ros import linear_model
from yawdamp_ros.stepping.response import linear_response
for units in (8, 31, 32, 33, 40, 44, 46, 47, 48, 49, 50):
    model = linear_model(made_up(np.random.default_rng(units), (units, units)), 3.0)
    states, outputs = linear_response(model, np.full(40, 0.01), 0.001)
    print(units, hashlib.sha256(states.tobytes() + outputs.tobytes()).hexdigest())
"""
    assert len(answers_by_threads(program)) == 1


@given(vehicles(1, 4), st.sampled_from([1e-4, 0.001, 0.01, 0.1]))
def test_block_is_the_powers_of_scipys_exponential(vehicle: Vehicle, step_size: float) -> None:
    model = linear_model(vehicle)
    size = len(model.state_matrix)
    rates = np.zeros((size + 2, size + 2))
    rates[:size, :size], rates[:size, -1], rates[size, 1] = model.state_matrix, model.input_matrix, 1.0
    step = expm(rates * step_size)
    found = propagator(model, step_size).steps
    block = found.shape[1] - size - 1
    steps = found.reshape(block, size + 1, -1)
    state = np.zeros(size + 2)
    state[:size] = np.linspace(-1.0, 1.0, size)
    angles = np.linspace(0.1, -0.3, block + 1)
    expected = []
    for angle in angles[:-1]:
        state[-1] = angle
        state = step @ state
        expected.append(state[:-1])
    start = np.concatenate([np.linspace(-1.0, 1.0, size), angles])
    np.testing.assert_allclose(steps @ start, expected, atol=1e-11 * np.abs(expected).max())


def test_runs_of_a_model_share_its_propagators_and_others_do_not() -> None:
    model = linear_model(load_vehicle("interlink"))
    shared = Propagators.of(model, 0.001)
    assert Propagators.of(model, 0.001) is shared
    assert Propagators.of(model, 0.01) is not shared
    assert Propagators.of(linear_model(load_vehicle("truck_trailer")), 0.001) is not shared
