"""At walking speed tyres roll where they point."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import root

from nonlinear_cases import PLANAR, UNLIMITED, motion, numbers
from yawdamp_ros.nonlinear import NonlinearDynamics
from yawdamp_ros.vehicle import STANDARD_GRAVITY, Axle, Unit, Vehicle

COMMONROAD = numbers("commonroad.json")
STIFF = 1e9
STEERING = 0.3


def axle(position: float, stiffness: float = STIFF, *, steered: bool = False) -> Axle:
    return Axle(position, stiffness, steered=steered, tyre="linear")


def train(*units: Unit) -> NonlinearDynamics:
    return NonlinearDynamics(Vehicle("train", 1.0, units), PLANAR)


@pytest.mark.parametrize("speed, duration", [(1.0, 40.0), (-1.0, 7.0)])
def test_every_axle_follows_its_tractrix_forwards_and_backwards(speed: float, duration: float) -> None:
    dynamics = train(
        Unit("truck", 8000.0, 3e4, (axle(2.0, steered=True), axle(-2.5)), None, -2.5),
        Unit("first", 15000.0, 2e5, (axle(-3.0),), 5.0, -4.0),
        Unit("second", 15000.0, 2e5, (axle(-3.0),), 4.0),
    )

    def steering(t: float) -> float:
        return STEERING * (1.0 - math.cos(math.pi * min(t, 2.0) / 2.0)) / 2.0

    times = np.linspace(0.0, duration, 121)
    states = motion(
        dynamics,
        dynamics.initial_state(speed),
        times,
        lambda t: dynamics.inputs(steering(t), speed=speed, friction=UNLIMITED),
        (2.0,),
        1e-9,
        "LSODA",
    )
    found = dynamics.outputs(states, dynamics.inputs())
    forward = found.velocity[:, 0, 0]

    def rolling(t: float, y: np.ndarray) -> list[float]:
        """Of the truck's rear axle, its yaw and two articulations; 8 m and 7 m from hitch to axle."""
        v, (first, second) = np.interp(t, times, forward), y[3:]
        turn = v * math.tan(steering(t)) / 4.5
        turn_1, along = v * math.sin(first) / 8.0, v * math.cos(first)
        turn_2 = (along * math.sin(second) - turn_1 * math.cos(second)) / 7.0
        return [v * math.cos(y[2]), v * math.sin(y[2]), turn, turn - turn_1, turn_1 - turn_2]

    start = [-2.5, 0.0, 0.0, 0.0, 0.0]
    tight = {"rtol": 1e-10, "atol": 1e-12, "max_step": 0.05}
    exact = solve_ivp(rolling, (0.0, duration), start, "DOP853", times, **tight).y.T
    turned_by = np.column_stack([np.zeros(len(times)), exact[:, 3], exact[:, 3:].sum(axis=1)])
    heading = np.exp(1j * (exact[:, 2:3] - turned_by))
    rear = exact[:, 0] + 1j * exact[:, 1]
    axles = [rear, rear - 8.0 * heading[:, 1]]
    axles.append(axles[1] - 1.0 * heading[:, 1] - 7.0 * heading[:, 2])
    turned = np.exp(1j * found.yaw)
    for unit, (place, path) in enumerate(zip((-2.5, -3.0, -3.0), axles, strict=True)):
        ours = found.position[:, unit] @ [1.0, 1j] + place * turned[:, unit]
        assert np.abs(ours - path).max() < 1e-3, unit
    assert abs(exact[-1, 3]) > 0.5


KINEMATIC = [case for case in COMMONROAD["cases"] if case["model"] == "kst"]


@pytest.mark.parametrize("case", KINEMATIC)
def test_tractor_and_trailer_turn_as_commonroads_kinematic_single_track(case: dict[str, list[float]]) -> None:
    given = COMMONROAD["parameters"]["kst"]
    front, rear = given["a"], given["b"]
    dynamics = train(
        Unit("tractor", 8000.0, 3e4, (axle(front, steered=True), axle(-rear)), None, -rear),
        Unit("trailer", 15000.0, 2e5, (axle(-3.0),), given["trailer"]["l_wb"] - 3.0),
    )
    layout = dynamics.layout
    _, _, steering, speed, _, hitch = case["state"]
    _, _, _, _, yaw_rate, hitch_rate = case["derivative"]
    state = dynamics.initial_state(1.0)  # kinematics do not know speed: theirs per metre travelled
    state[layout.articulation] = -hitch
    inputs = dynamics.inputs(steering, friction=UNLIMITED)
    moving = [layout.velocity.start + 1, layout.yaw_rate.start, layout.yaw_rate.start + 1]

    def unbalance(rates: np.ndarray) -> np.ndarray:
        state[moving] = rates
        return dynamics.derivatives(state, inputs)[moving] / 1e4

    solved = root(unbalance, np.zeros(3), tol=1e-13)
    assert np.abs(solved.fun).max() < 1e-9
    tractor, trailer = state[layout.yaw_rate]
    assert tractor == pytest.approx(yaw_rate / speed, abs=2e-5)
    assert trailer - tractor == pytest.approx(hitch_rate / speed, abs=2e-5)


DYNAMIC = [case for case in COMMONROAD["cases"] if case["model"] == "st"]


@pytest.mark.parametrize("case", DYNAMIC)
def test_a_car_at_speed_accelerates_as_commonroads_single_track(case: dict[str, list[float]]) -> None:
    """Theirs is linear in steering, yaw rate and slip angle, so that a thousandth of these is compared."""
    given, part = COMMONROAD["parameters"]["st"], 1e-3
    front, rear, mass = given["a"], given["b"], given["m"]
    stiffness = -given["tire"]["p_ky1"]
    loads = [STANDARD_GRAVITY * mass * lever / (front + rear) for lever in (rear, front)]
    axles = tuple(
        Axle(place, stiffness * load, steered=place > 0.0, static_load=load, tyre="linear")
        for place, load in zip((front, -rear), loads, strict=True)
    )
    dynamics = train(Unit("car", mass, given["I_z"], axles))
    layout = dynamics.layout
    _, _, steering, speed, _, yaw_rate, slip_angle = case["state"]
    acceleration, _, yaw_acceleration, slip_rate = case["derivative"][3:]
    state = dynamics.initial_state(speed * math.cos(part * slip_angle))
    state[layout.velocity.start + 1] = speed * math.sin(part * slip_angle)
    state[layout.yaw_rate] = part * yaw_rate
    state[layout.pitching_moment] = -mass * acceleration * given["h_s"]
    rates = dynamics.derivatives(state, dynamics.inputs(part * steering, friction=UNLIMITED))
    gravity = 9.81 / STANDARD_GRAVITY
    found = rates[layout.velocity.start + 1] / speed / part
    assert rates[layout.yaw_rate.start] / part * gravity == pytest.approx(
        yaw_acceleration, rel=1e-3, abs=2e-3
    )
    assert (found + yaw_rate) * gravity - yaw_rate == pytest.approx(slip_rate, rel=1e-3, abs=2e-3)
