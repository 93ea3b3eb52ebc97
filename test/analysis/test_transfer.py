"""Transfer functions against the state space they come from."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from yawdamp_ros.analysis import AnalysisError, static_gains, transfer_function
from yawdamp_ros.dynamics import MODELS, linear_model
from yawdamp_ros.vehicle import load_vehicle

INTERLINK = load_vehicle("interlink")
OUTPUTS = linear_model(INTERLINK).output_names


@pytest.mark.parametrize("model", MODELS)
@given(output=st.sampled_from(OUTPUTS), real=st.floats(-3.0, 3.0), imaginary=st.floats(30.0, 60.0))
def test_poles_zeros_and_one_value_are_the_whole_function(
    model: str, output: str, real: float, imaginary: float
) -> None:
    function = transfer_function(linear_model(INTERLINK, model=model), output)

    def factors(s: complex) -> complex:
        return complex(np.prod(s - function.zeros) / np.prod(s - function.poles))

    s = complex(real, imaginary)
    gain = function(100j) / factors(100j)
    assert function(s) == pytest.approx(gain * factors(s), rel=1e-6)


@pytest.mark.parametrize("output", OUTPUTS)
def test_static_gain_is_that_of_the_steady_turn(output: str) -> None:
    model = linear_model(INTERLINK)
    assert transfer_function(model, output).static_gain == pytest.approx(static_gains(model)[output])


@pytest.mark.parametrize("output", OUTPUTS)
def test_accelerations_follow_the_steering_at_once_and_have_as_many_zeros_as_poles(output: str) -> None:
    function = transfer_function(linear_model(INTERLINK), output)
    assert (len(function.zeros) == len(function.poles)) == output.endswith("lateral_acceleration")


def test_zeros_of_the_bicycle_models_yaw_rate() -> None:
    # r / delta of the two-axle vehicle has one zero, -Cr L / (m a u).
    function = transfer_function(linear_model(load_vehicle("single_vehicle")), "car/yaw_rate")
    np.testing.assert_allclose(function.zeros, [-116250 * 2.4892 / (1031.9 * 0.9271 * 20.0)])


def test_an_unknown_output_is_refused_with_the_known_ones() -> None:
    with pytest.raises(AnalysisError, match="output: 'truck/yaw': expected one of truck/lateral_velocity"):
        transfer_function(linear_model(INTERLINK), "truck/yaw")
