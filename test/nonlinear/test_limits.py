"""What combinations do at their limits."""

import math
from dataclasses import replace

import numpy as np
import pytest

from yawdamp_ros.nonlinear import EventKind, NonlinearDynamics, NonlinearError, Settings, steady_turn
from yawdamp_ros.nonlinear.layout import CROSSFALL
from yawdamp_ros.vehicle import Axle, Unit, Vehicle, load_vehicle, static_loads

INTERLINK = load_vehicle("interlink")
TRUCK_TRAILER = load_vehicle("truck_trailer")
LOADS = static_loads(TRUCK_TRAILER)
MILLIMETRE = 1e-3


def braked(over: tuple[int, int], *, abs_: bool) -> NonlinearDynamics:
    """The truck and trailer with three times its share of the brakes on one axle."""
    units = tuple(
        replace(
            unit,
            abs=abs_,
            axles=tuple(
                replace(axle, brake_share=load * (3.0 if (index, place) == over else 1.0))
                for place, (axle, load) in enumerate(zip(unit.axles, LOADS[index].axles, strict=True))
            ),
        )
        for index, unit in enumerate(TRUCK_TRAILER.units)
    )
    return NonlinearDynamics(replace(TRUCK_TRAILER, units=units))


def braking_in_a_turn(dynamics: NonlinearDynamics) -> tuple[set[tuple[EventKind, str]], int]:
    """Events of full braking at 54 km/h in a turn on friction 0.3, and the step of the first but locks."""
    turn = dynamics.inputs(0.03, speed=15.0, friction=0.3)
    start = dynamics.steps(dynamics.initial_state(15.0), turn, 0.001, 4000, 4000).states[-1]
    braking = dynamics.inputs(0.03, acceleration=-2.0, friction=0.3)
    events = dynamics.steps(start, braking, 0.001, 8000, 8000).events
    return {(event.kind, event.unit) for event in events}, next(
        (event.step for event in events if event.kind is not EventKind.WHEEL_LOCK), -1
    )


DRIVEN, LAST = (0, 1), (1, 0)


def test_a_locked_drive_axle_jackknifes_the_truck() -> None:
    events, step = braking_in_a_turn(braked(DRIVEN, abs_=False))
    assert (EventKind.WHEEL_LOCK, "truck") in events
    assert (EventKind.JACKKNIFE, "truck") in events
    assert 1000 < step < 5000


def test_a_locked_trailer_axle_swings_the_trailer() -> None:
    events, step = braking_in_a_turn(braked(LAST, abs_=False))
    assert events == {(EventKind.WHEEL_LOCK, "trailer"), (EventKind.TRAILER_SWING, "trailer")}
    assert 500 < step < 4000


@pytest.mark.parametrize("over", [DRIVEN, LAST])
def test_abs_keeps_the_combination_straight(over: tuple[int, int]) -> None:
    assert braking_in_a_turn(braked(over, abs_=True)) == (set(), -1)


@pytest.mark.parametrize("name", ["interlink", "a_double", "truck_trailer"])
def test_a_combination_stands_on_a_grade_with_its_brakes_on(name: str) -> None:
    dynamics = NonlinearDynamics(load_vehicle(name))
    held = dynamics.inputs(acceleration=-3.0, grade=0.1)
    states = dynamics.steps(dynamics.initial_state(0.0), held, 0.001, 65000, 5000).states
    places = dynamics.outputs(states, held).position
    assert np.abs(places[1:] - places[0]).max() < MILLIMETRE
    assert -0.1 < places[0, 0, 0] < -0.01, "it settles on its tyres first"


def test_without_brakes_it_rolls_down() -> None:
    dynamics = NonlinearDynamics(INTERLINK)
    states = dynamics.steps(dynamics.initial_state(0.0), dynamics.inputs(grade=0.1), 0.001, 5000, 5000).states
    rolled = dynamics.outputs(states, dynamics.inputs()).position[0, 0, 0]
    free_fall = 0.5 * 9.80665 * 0.1 / math.hypot(1.0, 0.1) * 25.0
    assert -free_fall < rolled < -0.9 * free_fall


def test_steering_at_rest_moves_nothing() -> None:
    dynamics = NonlinearDynamics(INTERLINK)
    rows = np.array([dynamics.inputs(angle) for angle in 0.5 * np.sin(np.arange(10000) * 1e-3)])
    states = dynamics.steps(dynamics.initial_state(0.0), rows, 0.001, every=10000).states
    assert np.abs(dynamics.outputs(states, rows[-1:]).position - dynamics.outputs(
        dynamics.initial_state(0.0)[np.newaxis], rows[0]).position).max() < MILLIMETRE  # fmt: skip


TRACK, HEIGHT, AXIS = 2.0, 2.0, 0.5


def truck(stiffness: float, tyre: str = "linear") -> NonlinearDynamics:
    def axle(x: float, *, steered: bool = False) -> Axle:
        return Axle(
            x,
            6e5,
            steered=steered,
            track_width=TRACK,
            roll_stiffness=0.5 * stiffness,
            roll_damping=0.1 * stiffness if stiffness < 1e7 else 1e6,
            tyre=tyre,
        )

    unit = Unit(
        "truck",
        20000.0,
        1e5,
        (axle(2.5, steered=True), axle(-2.5)),
        cg_height=HEIGHT,
        roll_axis_height=AXIS,
        roll_inertia=1e4,
    )
    settings = Settings(drag=False, rolling_resistance=False, load_shift=False)
    return NonlinearDynamics(Vehicle("truck", 20.0, (unit,)), settings)


def transfer(dynamics: NonlinearDynamics, acceleration: float) -> tuple[float, float]:
    found = steady_turn(
        dynamics, 20.0, dynamics.inputs(friction=1e9), lateral_acceleration=acceleration
    ).outputs
    return float(found.load_transfer_ratio[0, 0]), float(found.acceleration[0, 0, 1]) / 9.80665


def test_a_rigid_truck_lifts_its_wheels_at_half_the_track_over_the_height() -> None:
    ratio, severity = transfer(truck(1e9), 0.9 * 9.80665 * TRACK / (2.0 * HEIGHT))
    assert ratio == pytest.approx(severity / (TRACK / (2.0 * HEIGHT)), rel=2e-3)


def test_a_compliant_truck_lifts_them_earlier_as_gillespies_formula_says() -> None:
    stiffness, arm = 1.5e6, HEIGHT - AXIS
    weight = 20000.0 * 9.80665
    roll_rate = weight * arm / (stiffness - weight * arm)  # rad per g
    threshold = TRACK / (2.0 * HEIGHT) / (1.0 + roll_rate * (1.0 - AXIS / HEIGHT))
    ratio, severity = transfer(truck(stiffness), 0.5 * 9.80665 * threshold)
    assert ratio == pytest.approx(severity / threshold, rel=5e-3)


@pytest.mark.parametrize("share, falls", [(0.97, False), (1.03, True)])
def test_a_slow_tilt_overturns_it_at_the_same_g(share: float, falls: bool) -> None:  # noqa: FBT001
    stiffness, arm, count = 3e7, HEIGHT - AXIS, 20000
    dynamics = truck(stiffness)
    weight = 20000.0 * 9.80665
    roll_rate = weight * arm / (stiffness - weight * arm)
    threshold = TRACK / (2.0 * HEIGHT) / (1.0 + roll_rate * (1.0 - AXIS / HEIGHT))
    rows = np.tile(dynamics.inputs(acceleration=-3.0, friction=2.0), (count, 1))
    rows[:, CROSSFALL] = share * threshold * np.minimum(np.arange(count) / 15000.0, 1.0)
    run = dynamics.steps(dynamics.initial_state(0.0), rows, 0.001, every=count)
    assert (run.rolled_over == "truck") is falls
    if falls:
        kinds = [event.kind for event in run.events]
        assert kinds.index(EventKind.WHEEL_LIFT) < kinds.index(EventKind.ROLLOVER)
        assert run.taken < count


def test_what_diverges_names_the_step_and_the_unit() -> None:
    stiff = NonlinearDynamics(load_vehicle("interlink", ["units.1.hitch_roll_damping=1e8"]))
    with pytest.raises(NonlinearError, match=r"interlink: the motion of trailer_[12] diverges at step \d"):
        stiff.steps(stiff.initial_state(20.0), stiff.inputs(0.1), 0.01, 1000)
