"""The static rollover threshold, against closed forms and the model in motion."""

import math
from dataclasses import replace

import pytest

from yawdamp_ros.nonlinear import NonlinearDynamics, Settings, steady_turn
from yawdamp_ros.nonlinear.static_roll import static_rollover
from yawdamp_ros.vehicle import STANDARD_GRAVITY, Axle, Unit, Vehicle, load_vehicle

TRACK, HEIGHT, AXIS, MASS = 2.0, 2.0, 0.5, 20000.0
WEIGHT = MASS * STANDARD_GRAVITY


def truck(stiffness: float, rear_share: float = 0.5) -> Vehicle:
    def axle(x: float, share: float, *, steered: bool = False) -> Axle:
        return Axle(
            x,
            6e5,
            steered=steered,
            track_width=TRACK,
            roll_stiffness=share * stiffness,
            roll_damping=1e5,
            tyre="linear",
        )

    axles = (axle(2.5, 1.0 - rear_share, steered=True), axle(-2.5, rear_share))
    return Vehicle(
        "truck",
        20.0,
        (Unit("truck", MASS, 1e5, axles, cg_height=HEIGHT, roll_axis_height=AXIS, roll_inertia=1e4),),
    )


def test_a_rigid_truck_stands_half_its_track_over_the_height() -> None:
    (group,) = static_rollover(truck(1e10))
    assert group.threshold == pytest.approx(TRACK / (2.0 * HEIGHT), rel=1e-3)
    assert group.units == ("truck",)


@pytest.mark.parametrize("stiffness", [3e7, 1e7, 5e6])
def test_a_compliant_truck_stands_what_gillespies_formula_says(stiffness: float) -> None:
    arm = HEIGHT - AXIS
    roll_rate = WEIGHT * arm / (stiffness - WEIGHT * arm)  # rad per g
    expected = TRACK / (2.0 * HEIGHT) / (1.0 + roll_rate * (1.0 - AXIS / HEIGHT))
    assert static_rollover(truck(stiffness))[0].threshold == pytest.approx(expected, rel=1e-3)


def test_a_soft_truck_stands_what_its_moments_balance_at() -> None:
    """Both axles lift at once: springs hold ``k phi``, and all of the weight stands on the outer wheels."""
    stiffness, arm = 1.5e6, HEIGHT - AXIS
    group = static_rollover(truck(stiffness))[0]
    roll, severity = group.roll[0], group.threshold
    assert WEIGHT * arm * (severity * math.cos(roll) + math.sin(roll)) == pytest.approx(
        stiffness * roll, rel=1e-6
    )
    assert stiffness * roll + AXIS * severity * WEIGHT == pytest.approx(0.5 * TRACK * WEIGHT, rel=1e-6)


def test_uneven_springs_lift_the_stiff_axle_first_and_stand_less() -> None:
    assert static_rollover(truck(3e6, 0.9))[0].threshold < 0.99 * static_rollover(truck(3e6))[0].threshold


@pytest.mark.parametrize("name", ["interlink", "a_double", "tractor_semitrailer"])
def test_rolls_below_the_threshold_are_those_of_the_model_in_a_steady_turn(name: str) -> None:
    vehicle = load_vehicle(name)
    dynamics = NonlinearDynamics(vehicle, Settings(drag=False, rolling_resistance=False, load_shift=False))
    turn = steady_turn(
        dynamics, 25.0, dynamics.inputs(friction=1e9), lateral_acceleration=0.15 * STANDARD_GRAVITY
    ).outputs
    place = 0
    for group in static_rollover(vehicle):
        units = range(place, place + len(group.units))
        place = units.stop
        mean = sum(float(turn.roll[0, unit]) for unit in units) / len(units)
        below = group.curve[group.curve[:, 0] < group.roll[0]]
        severity = (
            float(sum(abs(turn.acceleration[0, unit, 1]) for unit in units)) / len(units) / STANDARD_GRAVITY
        )
        rolls = {round(float(a), 6): float(r) for r, a in below}
        assert min(rolls) < severity < max(rolls)
        near = sorted(rolls, key=lambda a: abs(a - severity))[:2]
        slope = (rolls[near[1]] - rolls[near[0]]) / (near[1] - near[0])
        assert mean == pytest.approx(rolls[near[0]] + slope * (severity - near[0]), rel=0.02)


def test_a_drawbar_eye_parts_the_groups_and_a_higher_load_falls_earlier() -> None:
    vehicle = load_vehicle("a_double")
    groups = static_rollover(vehicle)
    assert [group.units for group in groups] == [("tractor", "semitrailer_1"), ("dolly", "semitrailer_2")]
    higher = load_vehicle("a_double", ["units.3.cg_height=2.4"])
    fallen = static_rollover(higher)
    assert fallen[1].threshold < groups[1].threshold - 0.03
    assert fallen[0].threshold == pytest.approx(groups[0].threshold, rel=1e-9)


def test_a_wider_track_stands_more() -> None:
    unit = truck(5e6).units[0]
    wide = replace(unit, axles=tuple(replace(axle, track_width=2.4) for axle in unit.axles))
    assert static_rollover(Vehicle("wide", 20.0, (wide,)))[0].threshold == pytest.approx(
        1.2 * static_rollover(truck(5e6))[0].threshold, rel=1e-3
    )
