"""Measures by runs of the nonlinear model, against balances by hand."""

import math
from dataclasses import replace

import numpy as np
import pytest

from yawdamp_ros.analysis import AnalysisError, driven, low_speed_turn
from yawdamp_ros.analysis.driven import (
    directional_stability_under_braking,
    load_transfer_ratio,
    steer_tyre_friction_demand,
)
from yawdamp_ros.analysis.nonlinear_runs import drive_lane_change
from yawdamp_ros.analysis.tracking import CROSSFALL, tracking
from yawdamp_ros.nonlinear import NonlinearDynamics, Outputs
from yawdamp_ros.vehicle import Axle, Unit, Vehicle, load_vehicle, static_loads

SPREAD, STIFFNESS = 0.7, 3e5
TRUCK = Vehicle(
    "truck",
    20.0,
    (
        Unit(
            "truck",
            20000.0,
            1e5,
            (
                Axle(3.0, STIFFNESS, steered=True, tyre="linear", rolling_resistance=0.0),
                Axle(-2.0 + SPREAD, STIFFNESS, tyre="linear", rolling_resistance=0.0),
                Axle(-2.0 - SPREAD, STIFFNESS, tyre="linear", rolling_resistance=0.0, driven=False),
            ),
        ),
    ),
    friction=0.8,
    drag_area=0.0,
)


def test_friction_demand_is_that_of_the_moment_of_a_tandem() -> None:
    """About the middle of the tandem: slip of its axles and centripetal force against the steered axle."""
    turn = low_speed_turn(TRUCK)
    length = 5.0
    turning = np.gradient(turn.yaw[:, 0], turn.way)
    forward = np.gradient(turn.position[:, 0], turn.way)
    curvature = float((turning / np.abs(forward)).max())
    speed, mass, behind = 5.0 / 3.6, 20000.0, 2.0
    moment = 2.0 * STIFFNESS * SPREAD**2 * curvature + behind * mass * speed**2 * curvature
    force = moment / (length * math.cos(math.atan(length * curvature)))
    load = static_loads(TRUCK)[0].axles[0]
    assert steer_tyre_friction_demand(TRUCK) == pytest.approx(100.0 * force / load / 0.8, rel=0.05)


def test_a_wider_tandem_asks_for_more_friction() -> None:
    def spread(metres: float) -> Vehicle:
        unit = TRUCK.units[0]
        first, middle, last = unit.axles
        axles = (first, replace(middle, position=-2.0 + metres), replace(last, position=-2.0 - metres))
        return replace(TRUCK, units=(replace(unit, axles=axles),))

    narrow, wide = (steer_tyre_friction_demand(spread(metres)) for metres in (0.4, 1.0))
    assert wide > 3.0 * narrow


def test_trailer_axles_that_steer_ask_less_of_the_steered_tyres() -> None:
    locked, steering = (
        steer_tyre_friction_demand(load_vehicle("tractor_semitrailer", changes))
        for changes in ([], ["units.1.axles.*.low_speed_steering=0.4"])
    )
    assert 0.5 * locked < steering < locked


def test_the_driver_keeps_the_tyre_on_its_path(monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[Outputs] = []
    outputs = NonlinearDynamics.outputs
    monkeypatch.setattr(NonlinearDynamics, "outputs", lambda *given: seen.append(outputs(*given)) or seen[-1])
    vehicle = load_vehicle("tractor_semitrailer")
    steer_tyre_friction_demand(vehicle)
    (found,) = seen
    turn = low_speed_turn(vehicle)
    place = max(axle.position for axle in vehicle.units[0].axles if axle.steered)
    arm = complex(place, -turn.geometry[0].guide)
    points = found.position[:, 0, 0] + 1j * found.position[:, 0, 1] + arm * np.exp(1j * found.yaw[:, 0])
    _, inwards = driven.along_guide(turn, points.real, points.imag)
    assert np.abs(inwards).max() < 0.1
    assert found.yaw[-1, 0] == pytest.approx(math.pi / 2.0, abs=0.05)


def test_a_truck_crabs_on_a_crossfall_by_the_slip_of_its_axles() -> None:
    unit = TRUCK.units[0]
    width, ends = 2.55, (3.0 + 1.4) + (2.0 + SPREAD + 1.0)
    loads = static_loads(TRUCK)[0].axles
    crab = CROSSFALL * (loads[1] + loads[2]) / (2.0 * STIFFNESS)
    assert unit.width is None
    expected = width * math.cos(crab) + ends * math.sin(crab)
    assert tracking(TRUCK, 25.0).steady == pytest.approx(expected, abs=0.01)


def test_load_transfer_is_the_moment_of_the_height_over_what_the_rear_axles_carry() -> None:
    """Stiff springs at the rear axles alone, roll axis on the road: they bear all of m a h."""
    speed, height, track, stiff = 88.0 / 3.6, 1.2, 1.9, 5e7
    unit = TRUCK.units[0]
    first, *rear = (replace(axle, track_width=track, roll_damping=0.1 * stiff) for axle in unit.axles)
    axles = (
        replace(first, roll_stiffness=1.0, roll_damping=0.0),
        *(replace(axle, roll_stiffness=stiff) for axle in rear),
    )
    truck = replace(TRUCK, units=(replace(unit, axles=axles, cg_height=height, roll_axis_height=1e-3),))
    acceleration = float(np.abs(drive_lane_change(truck, speed).outputs.acceleration[:, 0, 1]).max())
    carried = sum(static_loads(truck)[0].axles[1:])
    expected = 2.0 * unit.mass * acceleration * height / (track * carried)
    assert 0.1 < expected < 0.9
    assert load_transfer_ratio(truck, speed) == pytest.approx(expected, rel=0.02)


def test_a_stop_on_a_split_road_takes_more_than_the_body_and_less_than_two_lanes() -> None:
    vehicle = load_vehicle("interlink")
    assert 2.55 < directional_stability_under_braking(vehicle, 60.0 / 3.6) < 3.3


def test_what_has_no_lane_change_has_no_load_transfer() -> None:
    car = load_vehicle("single_vehicle", ["units.0.axles.1.cornering_stiffness=3e4"])
    with pytest.raises(AnalysisError, match="unstable"):
        load_transfer_ratio(car, 40.0)
