"""Turns at walking speed: tractrices, and what swings out of the path or cuts in."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from yawdamp_ros.analysis import AnalysisError, low_speed_turn
from yawdamp_ros.analysis.swept_path import (
    along_guide,
    envelope,
    frontal_swing,
    frontal_swing_difference_of_maxima,
    frontal_swing_maximum_of_differences,
    low_speed_swept_path,
    tail_swing,
)
from yawdamp_ros.analysis.tractrix import RADIUS, Turn
from yawdamp_ros.vehicle import Axle, Unit, Vehicle, VehicleError, builtin_vehicles, load_vehicle

MILLIMETRE = 1e-3
TRUCK = Vehicle(
    "truck",
    20.0,
    (
        Unit(
            "truck",
            2e4,
            1e5,
            (Axle(3.0, 1e5, steered=True, track_width=2.0, tyre_width=0.3), Axle(-3.0, 1e5)),
            front_overhang=1.5,
            rear_overhang=3.0,
            width=2.5,
        ),
    ),
)


def steady_radii(turn: Turn) -> list[float]:
    """Radii of the middles of the axles in a steady turn, from the front: right triangles all."""
    lead = turn.geometry[0]
    radii = [math.sqrt(turn.radius**2 - lead.leader**2) - lead.guide]
    for ahead, unit in zip(turn.geometry, turn.geometry[1:], strict=False):
        radii.append(math.sqrt(radii[-1] ** 2 + ahead.hitch**2 - unit.leader**2))
    return radii


@pytest.mark.parametrize("name", ["interlink", "a_double", "nordic_combination", "truck_trailer"])
def test_a_long_turn_comes_to_the_steady_tractrices(name: str) -> None:
    turn = low_speed_turn(load_vehicle(name), radius=20.0, angle=8.0 * math.pi)
    end = int(np.searchsorted(turn.way, 20.0 * turn.angle)) - 1
    found = np.abs(turn.position[end] - 20.0j)
    assert np.abs(found - steady_radii(turn)).max() < 1e-6


def test_swings_of_a_long_turn_come_to_their_closed_forms() -> None:
    turn = low_speed_turn(TRUCK, angle=4.0 * math.pi)
    (rear,) = steady_radii(turn)
    unit = turn.geometry[0]
    end = int(np.searchsorted(turn.way, RADIUS * turn.angle)) - 1
    for forward, left, radius in (
        (unit.front, -unit.half_width, math.hypot(rear + unit.half_width, unit.front)),
        (0.0, unit.half_width, rear - unit.half_width),
        (unit.rear, -unit.half_width, math.hypot(rear + unit.half_width, unit.rear)),
    ):
        x, y = turn.path(0, forward, left)
        assert math.hypot(x[end], y[end] - RADIUS) == pytest.approx(radius, abs=1e-6)


def test_swept_path_and_frontal_swing_lie_below_those_of_a_circle() -> None:
    (rear,) = steady_radii(low_speed_turn(TRUCK, angle=4.0 * math.pi))
    unit = low_speed_turn(TRUCK).geometry[0]
    circle = math.hypot(rear + unit.half_width, unit.front)
    assert 0.9 * (circle - RADIUS) < frontal_swing(TRUCK) < circle - RADIUS
    assert low_speed_swept_path(TRUCK) < circle - (rear - unit.half_width)


@pytest.mark.parametrize(
    "name, changes",
    [*((name, []) for name in builtin_vehicles()), ("a_double", ["units.1.axles.*.low_speed_steering=0.3"])],
)
def test_it_is_an_independent_integration_to_a_millimetre(name: str, changes: list[str]) -> None:
    """Points in the plane, each led by a rod: no angle is a state there."""
    turn = low_speed_turn(load_vehicle(name, changes))
    geometry, arc = turn.geometry, turn.radius * turn.angle

    def guide(way: float) -> tuple[complex, complex]:
        turned = min(way / turn.radius, turn.angle)
        at = turn.radius * (math.sin(turned) + 1j * (1.0 - math.cos(turned)))
        tangent = complex(math.cos(turned), math.sin(turned))
        return at + max(way - arc, 0.0) * tangent, tangent

    def rates(way: float, places: np.ndarray) -> np.ndarray:
        """Velocity of the middle axles, places as complex numbers."""
        out = []
        at, velocity = guide(way)
        ahead = 1.0 + 0.0j
        for index, unit in enumerate(geometry):
            # The rod of the lead unit reaches from a point abreast of the axle to the guided tyre.
            offset = -1j * unit.guide if index == 0 else 0.0
            rod = at - places[index]
            rigid = complex(unit.leader, 0.0) + offset
            heading = rod / rigid
            heading /= abs(heading)
            led = velocity * heading.conjugate()
            # Axles that steer, all alike here, roll where they point.
            steered = unit.gains[0] * np.angle(ahead / heading) if unit.gains else 0.0
            moved = led.real * complex(1.0, -math.tan(steered))
            turning = (led.imag - moved.imag) / unit.leader
            if index == 0:
                moved -= unit.guide * turning
            out.append(moved * heading)
            at, ahead = places[index] + unit.hitch * heading, heading
            velocity = (moved + 1j * unit.hitch * turning) * heading
        return np.array(out)

    start, found = turn.position[0].astype(complex), turn.position.copy()
    for begin, end in ((0.0, arc), (arc, float(turn.way[-1]))):
        chosen = (turn.way >= begin - 1e-9) & (turn.way <= end + 1e-9)
        at = np.clip(turn.way[chosen], begin, end)
        solved = solve_ivp(rates, (begin, end), start, t_eval=at, rtol=1e-11, atol=1e-11)
        found[chosen] = solved.y.T
        start = solved.y[:, -1]
    assert np.abs(found - turn.position).max() < MILLIMETRE
    # Headings by the rods, and what follows from both: swept path, frontal swing, tail swing.
    places = np.array([guide(way)[0] for way in turn.way])
    headings = []
    for index, unit in enumerate(geometry):
        rigid = complex(unit.leader, -unit.guide if index == 0 else 0.0)
        heading = (places - found[:, index]) / rigid
        headings.append(np.unwrap(np.angle(heading)))
        places = found[:, index] + unit.hitch * heading / np.abs(heading)
    other = turn._replace(position=found, yaw=np.column_stack(headings))
    for one, both in zip(envelope(turn), envelope(other), strict=True):
        assert np.abs(one - both).max() < MILLIMETRE
    for index, unit in enumerate(geometry):
        for end in (unit.front, unit.rear):
            paths = [np.array(each.path(index, end, -unit.half_width)) for each in (turn, other)]
            assert np.abs(paths[0] - paths[1]).max() < MILLIMETRE


@pytest.mark.parametrize("name", ["a_double", "interlink", "tractor_semitrailer"])
def test_the_envelope_is_that_of_all_points_of_the_bodies(name: str) -> None:
    """Every body drawn as its whole outline, cut by lines across the path."""
    vehicle = load_vehicle(name)
    turn = low_speed_turn(vehicle)
    widths = []
    for angle in np.radians([15.0, 30.0, 45.0, 60.0, 75.0]):
        across = complex(-math.sin(angle), math.cos(angle))
        origin = turn.radius * complex(math.sin(angle), 1.0 - math.cos(angle))
        inner, outer = -np.inf, 0.0
        for index, unit in enumerate(turn.geometry):
            sides = np.array([1j * unit.half_width, -1j * unit.half_width])
            ends = np.linspace(unit.rear, unit.front, 400)
            outline = np.concatenate([ends + side for side in sides])
            points = turn.position[:, index, None] + outline * np.exp(1j * turn.yaw[:, index, None])
            there = (points - origin) * np.conj(across)
            near = np.abs(there.imag) < 0.02
            if near.any():
                inner = max(inner, float(there.real[near].max()))
                outer = min(outer, float(there.real[near].min())) if unit.body else outer
        widths.append(inner - outer)
    inside, outside = envelope(turn)
    assert max(widths) <= (inside - outside).max() + 5 * MILLIMETRE
    assert max(widths) == pytest.approx((inside - outside).max(), abs=0.1)


def test_tail_swing_grows_with_the_rear_overhang() -> None:
    def overhanging(metres: float) -> Vehicle:
        return replace(TRUCK, units=(replace(TRUCK.units[0], rear_overhang=metres),))

    swings = [tail_swing(overhanging(metres)) for metres in (0.0, 1.0, 2.0, 4.0)]
    assert swings == sorted(swings)
    assert swings[0] < 0.02
    assert swings[-1] > 0.3


def test_swing_of_trailers_is_of_combinations_only() -> None:
    assert frontal_swing_difference_of_maxima(TRUCK) is None
    semi = load_vehicle("tractor_semitrailer", ["units.1.front_overhang=3.5"])
    most, difference = frontal_swing_maximum_of_differences(semi), frontal_swing_difference_of_maxima(semi)
    assert most is not None
    assert difference is not None
    assert most > max(difference, 0.4)


def test_the_speed_and_the_loads_make_no_difference() -> None:
    empty = load_vehicle("docs/interlink_payload.yaml")
    moved = load_vehicle("docs/interlink_payload.yaml", ["units.2.load.0.position=-1.5"])
    assert low_speed_swept_path(moved) == low_speed_swept_path(empty)


def test_what_cannot_turn_says_so() -> None:
    with pytest.raises(AnalysisError, match="cannot turn on 5 m"):
        low_speed_turn(TRUCK, radius=5.0)
    with pytest.raises(AnalysisError, match="no two supports to turn about"):
        low_speed_turn(replace(TRUCK, units=(replace(TRUCK.units[0], axles=TRUCK.units[0].axles[:1]),)))


def test_axles_that_steer_against_the_articulation_come_to_their_closed_form() -> None:
    """The axle moves at its steer angle to the unit: hitch, axle and centre form a triangle."""
    gain = 0.5
    vehicle = load_vehicle("tractor_semitrailer", [f"units.1.axles.*.low_speed_steering={gain}"])
    turn = low_speed_turn(vehicle, radius=20.0, angle=8.0 * math.pi)
    end = int(np.searchsorted(turn.way, 20.0 * turn.angle)) - 1
    lead, unit = turn.geometry
    hitch = math.hypot(math.sqrt(20.0**2 - lead.leader**2) - lead.guide, lead.hitch)
    angle = gain * (turn.yaw[end, 0] - turn.yaw[end, 1])
    assert angle > 0.1
    expected = unit.leader * math.sin(angle) + math.sqrt(hitch**2 - (unit.leader * math.cos(angle)) ** 2)
    assert abs(turn.position[end, 1] - 20.0j) == pytest.approx(expected, abs=1e-6)


def test_steering_axles_narrow_the_swept_path_whose_inside_is_that_of_their_side() -> None:
    locked, steering = (
        load_vehicle("tractor_semitrailer", changes)
        for changes in ([], ["units.1.axles.*.low_speed_steering=0.4"])
    )
    assert low_speed_swept_path(steering) < low_speed_swept_path(locked) - 0.5
    inner, _ = envelope(low_speed_turn(steering))
    turn = low_speed_turn(steering)
    unit = turn.geometry[1]
    for forward in np.linspace(unit.rear, unit.front, 7):
        _, inwards = along_guide(turn, *turn.path(1, float(forward), unit.half_width))
        assert inwards.max() <= inner.max() + 5 * MILLIMETRE


@pytest.mark.parametrize(
    "key", ["units.0.axles.1.low_speed_steering=0.4", "units.1.axles.0.low_speed_steering=3"]
)
def test_low_speed_steering_is_of_trailers_and_within_reason(key: str) -> None:
    with pytest.raises(VehicleError, match=r"low_speed_steering: .*expected"):
        load_vehicle("tractor_semitrailer", [key])
