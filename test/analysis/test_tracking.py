"""Tracking ability on a rough road, by its spectrum, against the nonlinear model in time."""

import math

import numpy as np
import pytest

from yawdamp_ros.analysis import AnalysisError
from yawdamp_ros.analysis.bodies import corners, lateral_positions
from yawdamp_ros.analysis.lane_change import steer_axle_position
from yawdamp_ros.analysis.roughness import track_spectra, unevenness_of
from yawdamp_ros.analysis.tracking import CROSSFALL, INDEX, PREVIEW, corner_response, road_rates, tracking
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.nonlinear import NonlinearDynamics, Settings, linearise, steady_turn
from yawdamp_ros.nonlinear.layout import CROSSFALL as CROSSFALL_INPUT
from yawdamp_ros.nonlinear.layout import STEERING
from yawdamp_ros.nonlinear.steady import SteadyTurn
from yawdamp_ros.vehicle import load_vehicle

SPEED = 25.0


@pytest.fixture(scope="module")
def dynamics() -> NonlinearDynamics:
    return NonlinearDynamics(load_vehicle("tractor_semitrailer"))


@pytest.fixture(scope="module")
def steady(dynamics: NonlinearDynamics) -> SteadyTurn:
    return steady_turn(dynamics, SPEED, dynamics.inputs(crossfall=CROSSFALL), lateral_acceleration=0.0)


def test_a_crossfall_under_all_axles_is_that_of_the_road() -> None:
    """A vehicle that leans as its road does is pulled down as by the model's own crossfall.

    Rolling resistance and drag are off: they shift loads between wheels, and are in the state matrix alone.
    """
    settings = Settings(rolling_resistance=False, drag=False)
    dynamics = NonlinearDynamics(load_vehicle("tractor_semitrailer"), settings)
    layout = dynamics.layout
    straight = steady_turn(dynamics, SPEED, dynamics.inputs(), lateral_acceleration=0.0)
    linear = linearise(dynamics, straight.state, straight.inputs)
    found = road_rates(dynamics, straight, np.array([0j]), np.zeros(layout.units))[0, :, 0].real
    leaning = np.isin(linear.states, np.arange(layout.roll.start, layout.roll.stop)).astype(float)
    ends = []
    for rise in (1e-5, -1e-5):
        row = straight.inputs.copy()
        row[CROSSFALL_INPUT] = rise
        ends.append(dynamics.derivatives(straight.state, row))
    expected = (ends[0] - ends[1])[linear.states] / 2e-5
    np.testing.assert_allclose(
        found[linear.states] + linear.state_matrix @ leaning, expected, rtol=1e-3, atol=1e-2
    )


def test_the_spectrum_is_what_the_nonlinear_model_does_in_time(
    dynamics: NonlinearDynamics, steady: SteadyTurn
) -> None:
    """Some waves of crossfall and height, driven over by integrating the equations of motion."""
    rng = np.random.default_rng(3)
    waves = math.tau * np.array([0.004, 0.01, 0.02, 0.03, 0.05, 0.08])
    amplitudes = 2e-4 * rng.uniform(0.5, 1.0, (6, 2)) * np.exp(2j * math.pi * rng.random((6, 2)))
    amplitudes[:, 1] *= 2.0  # metres of height
    vehicle, layout = dynamics.vehicle, dynamics.layout
    speed = float(steady.state[layout.velocity.start])
    places = np.array([0.0, vehicle.hitches[0][0] - vehicle.hitches[0][1]])
    pushes = road_rates(dynamics, steady, 1j * speed * waves, places / speed)
    forward, sideways = steady.state[layout.velocity]
    direction, place = math.atan2(sideways, forward), steer_axle_position(vehicle)
    across = np.exp(-1j * direction)

    def rates(time: float, state: FloatArray) -> FloatArray:
        row, yaw = steady.inputs.copy(), state[2]
        axle = (complex(state[0], state[1]) + place * (np.exp(1j * yaw) - 1.0)) * across
        row[STEERING] -= yaw + axle.imag / (speed * PREVIEW)
        road = np.exp(1j * speed * waves * time)[:, np.newaxis] * amplitudes
        return dynamics.derivatives(state, row) + np.einsum("mi,mki->k", road, pushes).real

    step, state, states = 0.005, steady.state.copy(), []
    for number in range(4000):
        time = step * number
        k1 = rates(time, state)
        k2 = rates(time + 0.5 * step, state + 0.5 * step * k1)
        k3 = rates(time + 0.5 * step, state + 0.5 * step * k2)
        state = state + step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + rates(time + step, state + step * k3))
        states.append(state)
    run = dynamics.outputs(np.array(states), steady.inputs)
    driven = lateral_positions(vehicle, run, direction)
    still = lateral_positions(vehicle, steady.outputs, direction)[0]
    way = speed * step * np.arange(1, 4001)
    moved = corner_response(dynamics, steady, waves)
    late = way > 300.0  # the transient has gone
    for number, (unit, corner) in enumerate(corners(vehicle)):
        passed = way + places[unit] + corner.real
        expected = np.einsum(
            "wm,mi,mi->w", np.exp(1j * np.outer(passed, waves)), amplitudes, moved[number]
        ).real
        found = driven[:, number] - still[number]
        scale = np.abs(expected[late]).max()
        assert scale > 2e-4
        assert np.abs(found - expected)[late].max() < 0.005 * scale


def test_the_percentile_is_that_of_a_long_road() -> None:
    """Widths between the outermost corners at every place of 200 km of road of that spectrum."""
    vehicle = load_vehicle("a_double")
    dynamics = NonlinearDynamics(vehicle)
    steady = steady_turn(dynamics, SPEED, dynamics.inputs(crossfall=CROSSFALL), lateral_acceleration=0.0)
    found = tracking(vehicle, SPEED)
    count, spacing = 200_000, 1.0
    cycles = np.fft.rfftfreq(count, spacing)
    shown = (cycles >= 0.001) & (cycles < 0.2)
    coarse = np.geomspace(0.001, 0.2, 400)
    moved = corner_response(dynamics, steady, math.tau * coarse)
    track = 2.0 * float(dynamics.parameters.axles[:, 1].mean())
    height, crossfall = track_spectra(unevenness_of(INDEX), math.tau * cycles[shown], track)
    draws = np.random.default_rng(5).standard_normal((2, 2, int(shown.sum())))
    random = (draws[0] + 1j * draws[1]) / math.sqrt(2.0)
    inputs = random * np.sqrt(math.tau * cycles[1] * np.array([crossfall, height]))
    paths = []
    for corner, mean in zip(moved, found.mean, strict=True):
        lines = np.zeros(len(cycles), dtype=complex)
        for place in range(2):
            lines[shown] += np.interp(cycles[shown], coarse, corner[:, place]) * inputs[place]
        paths.append(mean + np.fft.irfft(lines * count / math.sqrt(2.0), count))
    width = np.max(paths, axis=0) - np.min(paths, axis=0)
    assert found.width == pytest.approx(float(np.percentile(width, 99.0)), abs=0.003)
    assert found.steady < found.width - 0.02


def test_a_road_without_roughness_adds_nothing_and_a_rougher_one_more() -> None:
    vehicle = load_vehicle("interlink")
    smooth, rough, rougher = (tracking(vehicle, SPEED, index) for index in (1e-9, 0.0038, 0.0076))
    assert smooth.width == pytest.approx(smooth.steady, abs=1e-6)
    assert rougher.width - smooth.width == pytest.approx(2.0 * (rough.width - smooth.width), rel=0.1)


def test_a_driver_who_looks_too_near_holds_no_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("yawdamp_ros.analysis.tracking.PREVIEW", 0.01)
    with pytest.raises(AnalysisError, match=r"no driver who looks 0.01 s ahead holds it on a line at 25 m/s"):
        tracking(load_vehicle("a_double"), SPEED)
