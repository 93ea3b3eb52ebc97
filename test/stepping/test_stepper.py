import math
from collections.abc import Callable
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import expm

from strategies import vehicles
from yawdamp_ros import linear_model, load_vehicle
from yawdamp_ros.dynamics import DynamicsError
from yawdamp_ros.stepping import Sample, Stepper
from yawdamp_ros.vehicle import Axle, Unit, Vehicle


def run(
    stepper: Stepper, steps: int, angle: Callable[[int], float], steps_per_sample: int | None = None
) -> Sample:
    """Run by a steer angle that depends on the step."""
    ahead = range(stepper.step + 1, stepper.step + 1 + steps)
    return stepper.run([angle(step) for step in ahead], steps_per_sample)


CAR = Vehicle(
    "car",
    75 / 3.6,
    (Unit("car", 1400.0, 2420.0, (Axle(1.14, 25000.0, steered=True), Axle(-1.33, 21000.0))),),
)


@pytest.mark.parametrize("step_size", [0.001, 0.01, 0.25])
def test_held_steering_gives_the_closed_form_at_any_step_size(step_size: float) -> None:
    stepper = Stepper(linear_model(CAR), step_size)
    stepper.steer(0.1)
    for step in range(1, round(5.0 / step_size) + 1):
        stepper.advance()
        time = step * step_size
        fast, slow = math.exp(-1.974517 * time), math.exp(-0.983853 * time)
        velocity = -13.09637 * fast + 24.46837 * slow - 11.37201
        yaw_rate = -0.249566 * fast - 0.696155 * slow + 0.945720
        # Printed to five and six decimals, the coefficients of a sum are off by half a digit each: the
        # velocity's three do not even add up to 0 at the start, but to -1e-5.
        assert stepper.state[0] == pytest.approx(velocity, abs=1.1e-5)
        assert stepper.state[1] == pytest.approx(yaw_rate, abs=1e-6)


def test_held_steering_gives_the_bicycles_exact_solution() -> None:
    model = linear_model(CAR)
    (a11, a12), (a21, a22) = model.state_matrix
    b1, b2 = model.input_matrix
    trace, determinant = a11 + a22, a11 * a22 - a12 * a21
    root = math.sqrt(trace**2 / 4 - determinant)
    slow, fast = trace / 2 + root, trace / 2 - root
    steady_yaw_rate = 0.1 * (a21 * b1 - a11 * b2) / determinant
    # r(0) = 0 and r'(0) = b2 delta fix the two exponentials.
    slow_part = (0.1 * b2 + fast * steady_yaw_rate) / (slow - fast)
    fast_part = -steady_yaw_rate - slow_part
    stepper = Stepper(model, 0.001)
    stepper.steer(0.1)
    for step in range(1, 5001):
        stepper.advance()
        time = 0.001 * step
        yaw_rate = steady_yaw_rate + slow_part * math.exp(slow * time) + fast_part * math.exp(fast * time)
        yaw = (
            steady_yaw_rate * time
            + slow_part / slow * math.expm1(slow * time)
            + fast_part / fast * math.expm1(fast * time)
        )
        assert stepper.state[1] == pytest.approx(yaw_rate, abs=1e-11)
        if step % 1000 == 0:
            assert stepper.sample().yaw[0] == pytest.approx(yaw, abs=1e-10)


@given(vehicles(), st.integers(2, 20))
def test_many_short_steps_are_one_long_step(vehicle: Vehicle, parts: int) -> None:
    model = linear_model(vehicle)
    long, short = Stepper(model, 0.05), Stepper(model, 0.05 / parts)
    for stepper in (long, short):
        stepper.steer(0.05)
    long.advance()
    for _ in range(parts):
        short.advance()
    np.testing.assert_allclose(short.state, long.state, rtol=1e-8, atol=1e-10)


@given(vehicles(), st.floats(-0.3, 0.3))
def test_steering_to_the_other_side_mirrors_everything(vehicle: Vehicle, angle: float) -> None:
    left, right = (Stepper(linear_model(vehicle), 0.01) for _ in range(2))
    one, other = run(left, 30, lambda _: angle), run(right, 30, lambda _: -angle)
    for field in ("y", "yaw", "yaw_rate", "lateral_acceleration", "lateral_velocity", "articulation"):
        np.testing.assert_array_equal(getattr(one, field), -getattr(other, field))
    np.testing.assert_array_equal(one.x, other.x)


@given(vehicles(min_units=2))
def test_units_stay_coupled_at_their_hitches(vehicle: Vehicle) -> None:
    sample = run(Stepper(linear_model(vehicle), 0.01), 100, lambda step: 0.05 * math.sin(0.02 * step))
    ends = []
    for unit, x, y, yaw in zip(vehicle.units, sample.x, sample.y, sample.yaw, strict=True):
        ends.append(
            [
                (x + hitch * math.cos(yaw), y + hitch * math.sin(yaw)) if hitch is not None else None
                for hitch in (unit.front_hitch, unit.rear_hitch)
            ]
        )
    for towing, towed in pairwise(ends):
        np.testing.assert_allclose(towing[1], towed[0], atol=1e-9)


def test_steering_left_yaws_left_and_curves_left() -> None:
    sample = run(Stepper(linear_model(load_vehicle("interlink")), 0.001), 2000, lambda _: 0.02)
    assert (sample.yaw > 0.0).all()
    assert (sample.yaw_rate > 0.0).all()
    assert (sample.lateral_acceleration > 0.0).all()
    assert sample.y[0] > 1.0
    assert sample.articulation[0] > 0.0


def test_a_steady_turn_is_a_circle_of_speed_over_yaw_rate() -> None:
    stepper = Stepper(linear_model(load_vehicle("interlink")), 0.001)
    sample = run(stepper, 60_000, lambda _: 0.02, 1000)
    points = np.column_stack([sample.x[20:, 0], sample.y[20:, 0]])
    # Centre by least squares of |p|^2 = 2 c.p + k.
    design = np.column_stack([2.0 * points, np.ones(len(points))])
    *centre, _ = np.linalg.lstsq(design, (points**2).sum(axis=1), rcond=None)[0]
    radii = np.hypot(*(points - centre).T)
    speed_over_ground = math.hypot(sample.velocity[-1, 0].real, sample.lateral_velocity[-1, 0])
    np.testing.assert_allclose(radii, speed_over_ground / sample.yaw_rate[-1, 0], rtol=1e-5)


def test_the_same_steering_gives_the_same_bits() -> None:
    model = linear_model(load_vehicle("interlink"))
    runs = [run(Stepper(model, 0.001), 500, lambda step: 0.1 * math.sin(0.0015 * step)) for _ in range(2)]
    for first, second in zip(*runs, strict=True):
        np.testing.assert_array_equal(first, second)


@given(vehicles(), st.lists(st.integers(1, 70), min_size=1, max_size=8))
def test_how_a_run_is_cut_does_not_change_a_bit(vehicle: Vehicle, cuts: list[int]) -> None:
    model = linear_model(vehicle)
    whole, cut = Stepper(model, 0.001), Stepper(model, 0.001)

    def angle(step: int) -> float:
        return 0.1 * math.sin(0.0015 * step)

    every = run(whole, sum(cuts), angle, 1)
    for steps in cuts:
        part = run(cut, steps, angle)
        for field in Sample._fields:
            if field not in {"inputs", "extra", "events", "commands"}:
                np.testing.assert_array_equal(getattr(part, field), getattr(every, field)[cut.step - 1])
    np.testing.assert_array_equal(whole.state, cut.state)


def test_a_sample_holds_the_steering_in_force_from_its_instant_on() -> None:
    model = linear_model(load_vehicle("single_vehicle"))
    stepper = Stepper(model, 0.01)
    stepper.steer(0.1)
    first = stepper.sample()
    assert first.steering_angle == 0.1
    assert first.yaw_rate[0] == 0.0
    assert first.lateral_acceleration[0] == pytest.approx(0.1 * model.input_matrix[0])


def test_inputs_are_told_with_the_step_at_which_they_took_effect() -> None:
    stepper = Stepper(linear_model(load_vehicle("single_vehicle")), 0.01)
    assert stepper.sample().inputs == ((0, "speed", 20.0), (0, "steering", 0.0))
    assert stepper.run([0.0, 0.1, 0.1, 0.2]).inputs == ((2, "steering", 0.1), (4, "steering", 0.2))
    assert stepper.run([0.0, 0.0]).inputs == ((5, "steering", 0.0),)


def test_of_two_inputs_at_one_step_only_the_last_is_told() -> None:
    stepper = Stepper(linear_model(load_vehicle("single_vehicle")), 0.01)
    stepper.steer(0.1)
    stepper.steer(0.2)
    assert stepper.sample().inputs == ((0, "speed", 20.0), (0, "steering", 0.2))


def test_another_speed_is_another_model_with_the_same_state() -> None:
    vehicle = load_vehicle("interlink")
    stepper = Stepper(linear_model(vehicle), 0.001)
    run(stepper, 500, lambda _: 0.05)
    state = stepper.state
    stepper.change_speed(15.0)
    np.testing.assert_array_equal(stepper.state, state)
    sample = run(stepper, 20_000, lambda _: 0.05)
    settled = run(Stepper(linear_model(vehicle, 15.0), 0.001), 20_000, lambda _: 0.05)
    np.testing.assert_allclose(sample.yaw_rate, settled.yaw_rate, rtol=1e-9)
    assert sample.velocity[0].real == 15.0
    assert (500, "speed", 15.0) in sample.inputs


def test_a_reset_returns_to_rest_at_the_origin_and_time_goes_on() -> None:
    model = linear_model(load_vehicle("interlink"))
    stepper = Stepper(model, 0.001)
    run(stepper, 700, lambda _: 0.05)
    stepper.reset()
    again = run(stepper, 300, lambda _: 0.05)
    fresh = Stepper(model, 0.001)
    fresh.steer(0.05)
    anew = run(fresh, 300, lambda _: 0.05)
    assert again.step == 1000
    for field in ("x", "y", "yaw", "yaw_rate", "lateral_acceleration", "articulation"):
        np.testing.assert_array_equal(getattr(again, field), getattr(anew, field))


def test_a_run_is_repeated_bit_for_bit_from_its_inputs_alone() -> None:
    model = linear_model(load_vehicle("interlink"))
    stepper = Stepper(model, 0.001)
    first = []
    for index in range(100):
        stepper.advance()
        if index % 33 == 0:
            stepper.change_speed(20.0 + index / 100)
        if index == 44:
            stepper.reset()
        first.append(run(stepper, 9, lambda step: 0.05 * math.sin(0.003 * step)))
    other = Stepper(model, 0.001)
    pending = [applied for sample in first for applied in sample.inputs]
    for sample in first:
        while pending and pending[0].step <= sample.step:
            other.advance(pending[0].step - other.step)
            other.apply(pending.pop(0))
        other.advance(int(sample.step) - other.step)
        for one, two in zip(sample, other.sample(), strict=True):
            np.testing.assert_array_equal(one, two)


@given(vehicles(), st.integers(1, 100), st.floats(0.01, 0.1))
def test_from_a_snapshot_a_run_goes_on_bit_for_bit(vehicle: Vehicle, steps: int, amplitude: float) -> None:
    # Steps so long, and so near to the origin, that a last bit of the velocity is one of the position.
    model = linear_model(vehicle)
    first, other = Stepper(model, 0.05), Stepper(model, 0.05)

    def angle(step: int) -> float:
        return amplitude * math.sin(step)

    run(first, steps, angle)
    first.sample()
    other.restore(first.snapshot())
    for one, two in zip(run(first, 40, angle, 1), run(other, 40, angle, 1), strict=True):
        np.testing.assert_array_equal(one, two)


def test_yaw_is_exact_after_a_million_turns() -> None:
    model = linear_model(load_vehicle("interlink"))
    steps, turns = 4000, 1_000_000
    fresh, turned = Stepper(model, 0.01), Stepper(model, 0.01)
    # A million turns and what their number as a double leaves over: 2 pi is no double.
    start = dict(fresh.snapshot())
    whole = Fraction("6.283185307179586476925286766559005768394") * turns
    yaw = float(whole)
    turned.restore(start | {"yaw": yaw, "yaw_remainder": float(whole - Fraction(yaw)), "sampled": False})
    one, other = (run(stepper, steps, lambda _: 0.03) for stepper in (fresh, turned))
    assert one.yaw[0] > 3.0
    np.testing.assert_allclose(other.heading, one.heading, rtol=0.0, atol=1e-13)
    np.testing.assert_allclose(other.x, one.x, rtol=0.0, atol=1e-10)
    assert other.yaw[0] == float(whole + Fraction(float(one.yaw[0])))


def test_a_changing_speed_is_followed_as_by_matrices_of_every_step() -> None:
    vehicle = load_vehicle("interlink")
    stepper = Stepper(linear_model(vehicle, 20.0), 0.01)
    state = np.zeros(6)
    stepper.steer(0.03)
    for step in range(400):
        speed = 20.0 + 5.0 * math.sin(0.05 * (step % 100))
        stepper.change_speed(speed)
        stepper.advance()
        model = linear_model(vehicle, speed)
        steady = np.linalg.solve(model.state_matrix, -model.input_matrix * 0.03)
        state = steady + expm(0.01 * model.state_matrix) @ (state - steady)
        np.testing.assert_allclose(stepper.state, state, rtol=0.0, atol=1e-9)


def test_an_unstable_motion_ends_in_no_numbers_without_a_word() -> None:
    skidding = [f"units.0.axles.{axle}.cornering_stiffness=50000" for axle in (1, 2)]
    stepper = Stepper(linear_model(load_vehicle("interlink", skidding)), 1.0)
    assert np.isnan(run(stepper, 1000, lambda _: 0.1).heading).all()


@pytest.mark.parametrize("articulation", [0.0, 0.4, 0.9, -1.3])
def test_velocity_of_every_unit_is_the_rate_of_its_pose_at_any_articulation(articulation: float) -> None:
    model, step = linear_model(load_vehicle("interlink"), 3.0), 1e-6
    stepper = Stepper(model, step)
    state = (0.3, 0.4, 0.1, -0.5, articulation, 0.5 * articulation)
    start = {"state": state, "yaw": 0.7, "x": 3.0, "y": -2.0}
    stepper.restore(dict(stepper.snapshot()) | start)
    before = stepper.sample()
    stepper.advance()
    now = stepper.sample()
    stepper.advance()
    after = stepper.sample()
    rate = (after.x - before.x + 1j * (after.y - before.y)) / (2.0 * step)
    np.testing.assert_allclose(now.velocity * now.heading, rate, atol=1e-6)
    assert now.velocity[0] == pytest.approx(3.0 + 0.3j, abs=1e-3)
    if abs(articulation) == 0.9:
        assert abs(now.velocity[-1] - (3.0 + 1j * now.lateral_velocity[-1])) > 1.0


@pytest.mark.parametrize("vehicle, model", [("interlink", "published"), ("a_double", "consistent")])
def test_run_at_a_changed_speed_has_the_bits_of_one_that_began_at_it(vehicle: str, model: str) -> None:
    known, generator = load_vehicle(vehicle), np.random.default_rng(3)
    changed = Stepper(linear_model(known, 20.0, model), 0.001)
    for speed in generator.uniform(1.0, 60.0, 20).tolist():
        changed.change_speed(speed)
        changed.reset()
        begun = Stepper(linear_model(known, speed, model), 0.001)
        for stepper in (changed, begun):
            stepper.steer(0.03)
        one, other = changed.run([0.01] * 70, 7), begun.run([0.01] * 70, 7)
        for field in ("yaw_rate", "lateral_acceleration", "lateral_velocity", "articulation"):
            np.testing.assert_array_equal(getattr(one, field), getattr(other, field))
        assert changed.linearise().speed == changed.speed == speed


def test_change_of_speed_assembles_no_equations(monkeypatch: pytest.MonkeyPatch) -> None:
    stepper = Stepper(linear_model(load_vehicle("interlink")), 0.001)
    monkeypatch.setattr("yawdamp_ros.stepping.propagators.linear_model", None)
    monkeypatch.setattr("yawdamp_ros.stepping.stepper.linear_model", None)
    for speed in range(5, 60):
        stepper.change_speed(float(speed))
        stepper.advance(10)
        assert stepper.speed == speed


@pytest.mark.parametrize("speed", [0.0, 0.001, -3.0, math.nan, math.inf])
def test_speed_that_no_model_has_is_refused_and_changes_nothing(speed: float) -> None:
    stepper = Stepper(linear_model(load_vehicle("interlink"), 20.0), 0.001)
    with pytest.raises(DynamicsError, match=r"speed: .*: expected a speed of at least 0.01 m/s"):
        stepper.change_speed(speed)
    assert stepper.speed == 20.0
