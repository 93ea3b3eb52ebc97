"""The fixed step."""

import subprocess
import sys

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from nonlinear_cases import PLANAR, UNLIMITED
from yawdamp_ros.dynamics import linear_model
from yawdamp_ros.nonlinear import NonlinearDynamics, linearise
from yawdamp_ros.vehicle import builtin_vehicles, load_vehicle

ALL_LINEAR = [
    f"units.{unit}.axles.{axle}.tyre=linear" for unit, count in enumerate((3, 2, 2)) for axle in range(count)
]


def test_the_step_is_of_fourth_order_where_tyres_are_smooth() -> None:
    dynamics = NonlinearDynamics(load_vehicle("interlink", ALL_LINEAR))
    start, inputs = dynamics.initial_state(20.0), dynamics.inputs(0.02)
    exact = solve_ivp(
        lambda _, y: dynamics.derivatives(y, inputs), (0.0, 1.0), start, "DOP853", rtol=1e-12, atol=1e-12
    ).y[:, -1]
    errors = [
        np.abs(dynamics.steps(start, inputs, 1.0 / count, count, count).states[-1] - exact)[:13].max()
        for count in (100, 200, 400)
    ]
    orders = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    assert orders == pytest.approx(4.0, abs=0.4)


def test_the_motion_is_the_same_however_the_steps_are_divided() -> None:
    dynamics = NonlinearDynamics(load_vehicle("a_double"))
    rows = np.array([dynamics.inputs(0.1 * np.sin(k * 0.003), acceleration=-1.0) for k in range(2000)])
    whole = dynamics.steps(dynamics.initial_state(20.0), rows, 0.001, every=2000).states[-1]
    state = dynamics.initial_state(20.0)
    for block in np.split(rows, [1, 17, 500, 1300]):
        state = dynamics.steps(state, block, 0.001).states[-1]
    assert np.array_equal(whole, state)


@pytest.mark.parametrize("name", builtin_vehicles())
def test_every_builtin_vehicle_turns_and_stops(name: str) -> None:
    vehicle = load_vehicle(name)
    dynamics = NonlinearDynamics(vehicle)
    start = dynamics.initial_state(15.0)
    turned = dynamics.steps(start, dynamics.inputs(0.01, speed=15.0), 0.001, 5000, 5000).states
    assert dynamics.outputs(turned, dynamics.inputs()).yaw_rate[0, 0] > 0.01
    stopped = dynamics.steps(turned[-1], dynamics.inputs(0.01, acceleration=-4.0), 0.001, 8000, 8000).states
    assert np.abs(dynamics.outputs(stopped, dynamics.inputs()).velocity).max() < 1e-3


@pytest.mark.parametrize("name", ["interlink", "a_double", "truck_trailer", "single_vehicle"])
def test_small_motion_is_that_of_the_consistent_model(name: str) -> None:
    vehicle = load_vehicle(name)
    dynamics, linear = NonlinearDynamics(vehicle, PLANAR), linear_model(vehicle)
    about = linearise(dynamics, dynamics.initial_state(vehicle.speed), dynamics.inputs(friction=UNLIMITED))
    layout, units = dynamics.layout, len(vehicle.units)
    states = [
        layout.velocity.start + 1,
        *range(layout.yaw_rate.start, layout.yaw_rate.stop),
        *range(layout.articulation.start, layout.articulation.stop),
    ]
    places = [list(about.states).index(state) for state in states]
    for found, expected in (
        (about.state_matrix[np.ix_(places, places)], linear.state_matrix),
        (about.input_matrix[places], linear.input_matrix),
        (about.output_matrix[: 4 * units - 1, places], linear.output_matrix),
        (about.feedthrough[: 4 * units - 1], linear.feedthrough),
    ):
        assert found == pytest.approx(expected, rel=1e-7, abs=1e-7)


@pytest.mark.parametrize("friction, power", [(0.8, 2), (UNLIMITED, 3)])
def test_it_tends_to_the_consistent_model_with_a_power_of_the_amplitude(friction: float, power: int) -> None:
    # Brush tyres depart with the square; without a limit of friction only geometry does, with the cube.
    vehicle = load_vehicle("interlink")
    dynamics, linear = NonlinearDynamics(vehicle, PLANAR), linear_model(vehicle)
    count, dt = 2000, 0.001
    wave = np.sin(1.5 * dt * np.arange(count))
    away = []
    for amplitude in (0.01, 0.005):
        rows = np.tile(dynamics.inputs(speed=vehicle.speed, friction=friction), (count, 1))
        rows[:, 0] = amplitude * wave
        states = dynamics.steps(dynamics.initial_state(vehicle.speed), rows, dt, every=count).states
        found = dynamics.outputs(states, rows[-1:]).yaw_rate[0]
        exact = _held(linear.state_matrix, linear.input_matrix, amplitude * wave, dt)[1:4]
        away.append(np.abs(found - exact).max())
    assert away[0] / away[1] == pytest.approx(2.0**power, rel=0.2)


def _held(matrix: np.ndarray, column: np.ndarray, steering: np.ndarray, dt: float) -> np.ndarray:
    """State of a linear model after steps of held steering, by the Runge-Kutta method's polynomial."""
    size = len(matrix)
    whole = np.zeros((size + 1, size + 1))
    whole[:size, :size], whole[:size, size] = matrix * dt, column * dt
    step = sum(np.linalg.matrix_power(whole, k) / np.prod(range(1, k + 1)) for k in range(5))
    state = np.zeros(size)
    for angle in steering:
        state = (step @ np.append(state, angle))[:size]
    return state


def test_without_numba_it_runs_alike_and_says_so() -> None:
    code = (
        "import sys; sys.modules['numba'] = None\n"
        "from yawdamp_ros.nonlinear import COMPILED, NonlinearDynamics\n"
        "from yawdamp_ros.vehicle import load_vehicle\n"
        "d = NonlinearDynamics(load_vehicle('interlink'))\n"
        "state = d.steps(d.initial_state(20.0), d.inputs(0.02, speed=20.0), 0.01, 20, 20).states[-1]\n"
        "print(COMPILED, *state)\n"
    )
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stderr.splitlines() == [
        "numba is not installed: the nonlinear model runs uncompiled, about a hundred times slower"
    ]
    compiled, *values = found.stdout.split()
    dynamics = NonlinearDynamics(load_vehicle("interlink"))
    start, inputs = dynamics.initial_state(20.0), dynamics.inputs(0.02, speed=20.0)
    expected = dynamics.steps(start, inputs, 0.01, 20, 20).states[-1]
    assert compiled == "False"
    assert np.array(values, float) == pytest.approx(expected, rel=1e-9, abs=1e-9)
