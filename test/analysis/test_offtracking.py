"""Offtracking, by closed forms where there are any."""

import math
from dataclasses import replace

import numpy as np
import pytest

from yawdamp_ros import linear_model, load_vehicle
from yawdamp_ros.analysis import (
    SAE_J2179_SPEED,
    AnalysisError,
    axle_path,
    high_speed_transient_offtracking,
    run_lane_change,
    steady_offtracking,
)
from yawdamp_ros.stepping import Response
from yawdamp_ros.vehicle import Axle


def test_crawling_two_axle_vehicle_cuts_the_corner_by_its_wheelbase() -> None:
    car = linear_model(load_vehicle("single_vehicle"), 0.01)
    radius, front, rear = 50.0, 0.9271, 1.5621
    # The rear axle rolls about the centre of the turn: R^2 = R_rear^2 + b^2, R_front^2 = R_rear^2 + L^2.
    at_rear = math.sqrt(radius**2 - rear**2)
    expected = at_rear - math.hypot(at_rear, front + rear)
    assert steady_offtracking(car, radius) == pytest.approx(expected, abs=1e-5)


def test_crawling_trailer_cuts_in_by_its_drawbar() -> None:
    vehicle = load_vehicle("truck_trailer")
    radius, hitch_behind_axle = 1000.0, 2.723 - 2.539
    at_truck = math.sqrt(radius**2 - 2.723**2)
    at_hitch = math.hypot(at_truck, hitch_behind_axle)
    at_trailer = math.sqrt(at_hitch**2 - (7.483 + 3.76) ** 2)
    expected = at_trailer - math.hypot(at_truck, 2.062 + 2.723)
    assert steady_offtracking(linear_model(vehicle, 0.01), radius) == pytest.approx(expected, abs=1e-5)


def test_speed_swings_the_last_axle_out() -> None:
    vehicle = load_vehicle("a_double")
    crawling, slow, fast = (steady_offtracking(linear_model(vehicle, speed)) for speed in (1.0, 15.0, 25.0))
    assert crawling < slow < fast
    assert crawling < 0.0 < fast


def test_vehicle_too_heavy_for_its_tyres_has_no_steady_curve() -> None:
    car = load_vehicle("single_vehicle")
    vehicle = replace(car, units=(replace(car.units[0], mass=1e7),))
    with pytest.raises(AnalysisError, match="no steer angle holds a steady turn of 400 m"):
        steady_offtracking(linear_model(vehicle))


def test_path_of_an_axle_lies_ahead_of_the_centre_of_gravity_by_the_heading() -> None:
    run = Response(
        unit_names=("car",),
        time=np.zeros(2),
        steering_angle=np.zeros(2),
        yaw=np.array([[0.0], [math.pi / 2]]),
        yaw_rate=np.zeros((2, 1)),
        lateral_acceleration=np.zeros((2, 1)),
        articulation=np.zeros((2, 0)),
        x=np.array([[10.0], [20.0]]),
        y=np.array([[1.0], [2.0]]),
    )
    path = axle_path(run, 0, 3.0)
    np.testing.assert_allclose(path.x, [13.0, 20.0])
    np.testing.assert_allclose(path.y, [1.0, 5.0])


def test_lane_change_offtracking_is_the_largest_distance_across_the_road() -> None:
    model = linear_model(load_vehicle("a_double"), SAE_J2179_SPEED)
    response = run_lane_change(model)
    steer, last = axle_path(response, 0, 1.3647), axle_path(response, 3, -4.3499)
    # By hand at many places along the road, to the nearest sample of either path.
    beside = [
        abs(last.y[np.argmin(abs(last.x - x))] - steer.y[np.argmin(abs(steer.x - x))])
        for x in np.arange(0.0, 250.0, 0.5)
    ]
    found = high_speed_transient_offtracking(model.vehicle, response)
    assert found == pytest.approx(max(beside), abs=0.01)


def test_last_axle_is_the_rearmost_of_the_last_unit_in_any_order() -> None:
    model = linear_model(load_vehicle("interlink"), SAE_J2179_SPEED)
    *ahead, last = model.vehicle.units
    turned = replace(model.vehicle, units=(*ahead, replace(last, axles=last.axles[::-1])))
    response = run_lane_change(model)
    assert high_speed_transient_offtracking(turned, response) == high_speed_transient_offtracking(
        model.vehicle, response
    )


def test_axle_that_is_moved_back_tracks_further_out() -> None:
    model = linear_model(load_vehicle("a_double"), SAE_J2179_SPEED)
    response = run_lane_change(model)
    *ahead, last = model.vehicle.units
    longer = replace(model.vehicle, units=(*ahead, replace(last, axles=(*last.axles, Axle(-8.0, 1.0)))))
    assert high_speed_transient_offtracking(longer, response) > high_speed_transient_offtracking(
        model.vehicle, response
    )
