"""Demands on the combination and on single units and axles."""

from dataclasses import replace

import numpy as np
import pytest

from yawdamp_ros.nonlinear import NonlinearDynamics, Settings
from yawdamp_ros.vehicle import load_vehicle

INTERLINK = load_vehicle("interlink")
MASS = sum(unit.mass for unit in INTERLINK.units)
FREE = Settings(drag=False, rolling_resistance=False)
DYNAMICS = NonlinearDynamics(INTERLINK, FREE)
LAYOUT = DYNAMICS.input_layout


def after(inputs: np.ndarray, seconds: float = 1.0, speed: float = 20.0, settings: Settings = FREE) -> object:
    dynamics = NonlinearDynamics(INTERLINK, settings)
    count = round(seconds * 1000)
    states = dynamics.steps(dynamics.initial_state(speed), inputs, 0.001, count, count).states
    return dynamics.outputs(states, inputs)


@pytest.mark.parametrize("demand", [1.0, -3.0])
def test_an_acceleration_is_that_of_the_whole_combination(demand: float) -> None:
    found = after(DYNAMICS.inputs(acceleration=demand))
    assert found.velocity[0, :, 0] == pytest.approx([20.0 + demand] * 3, abs=2e-3)
    assert found.acceleration[0, :, 0] == pytest.approx([demand] * 3, rel=1e-3)


def test_driving_is_by_the_driven_axles_and_braking_by_all() -> None:
    driven = after(DYNAMICS.inputs(acceleration=1.0)).longitudinal_force[0].reshape(-1, 2).sum(axis=1)
    assert np.flatnonzero(np.abs(driven) > 1.0).tolist() == [1, 2]
    braked = after(DYNAMICS.inputs(acceleration=-1.0)).longitudinal_force[0]
    assert (braked < -1.0).all()


def test_a_speed_is_held_and_reached_within_the_limits() -> None:
    held = after(DYNAMICS.inputs(speed=20.0), 10.0, settings=Settings())
    assert held.velocity[0, 0, 0] == pytest.approx(20.0, abs=0.05)
    slower = after(DYNAMICS.inputs(speed=10.0), settings=replace(FREE, lowest_demand=-1.0))
    assert slower.velocity[0, 0, 0] == pytest.approx(19.0, abs=0.01)


def test_a_unit_is_braked_alone() -> None:
    inputs = DYNAMICS.inputs()
    inputs[LAYOUT.brake] = 0.0, 0.0, 50e3
    found = after(inputs)
    assert found.velocity[0, 0, 0] == pytest.approx(20.0 - 50e3 / MASS, abs=2e-3)
    forces = found.longitudinal_force[0].reshape(-1, 2).sum(axis=1)
    assert forces == pytest.approx([0.0] * 5 + [-25e3] * 2, abs=1.0)
    assert found.hitch_force[0, :, 0] == pytest.approx(
        [50e3 - 50e3 / MASS * (MASS - 9200.0), 50e3 - 50e3 / MASS * 29894.0], rel=1e-3
    )


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_braking_one_side_turns_the_unit_to_it(side: float) -> None:
    inputs = DYNAMICS.inputs()
    inputs[LAYOUT.yaw_moment] = side * 30e3, 0.0, 0.0
    found = after(inputs)
    assert side * found.yaw_rate[0, 0] > 1e-3
    forces = found.longitudinal_force[0].reshape(-1, 2)[:3]
    braked, free = forces[:, 0 if side > 0.0 else 1], forces[:, 1 if side > 0.0 else 0]
    assert (braked < -1.0).all()
    assert free == pytest.approx([0.0] * 3, abs=1.0)


def test_less_friction_on_one_side_turns_it_to_the_other() -> None:
    found = after(DYNAMICS.inputs(acceleration=-5.0, friction=(0.8, 0.2)), 0.5)
    assert found.yaw_rate[0, 0] > 1e-3


def test_a_steered_trailer_axle_swings_its_trailer_out() -> None:
    inputs = DYNAMICS.inputs()
    inputs[LAYOUT.axle_steering][5:] = 0.02
    found = after(inputs)
    assert found.articulation[0, 1] > 5e-3, "its rear moves to the left, its nose to the right"


def test_hitch_friction_opposes_articulation() -> None:
    free = after(DYNAMICS.inputs(0.03), 2.0)
    stiff = NonlinearDynamics(
        load_vehicle("interlink", ["units.0.hitch_friction=2e4", "units.0.hitch_damping=2e5"]), FREE
    )
    states = stiff.steps(stiff.initial_state(20.0), stiff.inputs(0.03), 0.001, 300, 300).states
    loose = DYNAMICS.steps(DYNAMICS.initial_state(20.0), DYNAMICS.inputs(0.03), 0.001, 300, 300).states
    assert 0.0 < states[-1, 3] < loose[-1, 3]
    assert free.articulation[0, 0] > 0.0
