"""What is off is judged by the size of the motion over the run, and the first of it is told."""

import math

import pytest

from yawdamp_ros.runs.deviations import Deviations, quantity


def test_values_of_all_units_and_joints_are_one_quantity() -> None:
    assert quantity("/truck/odom", "pose.pose.position.y") == quantity(
        "/trailer/odom", "pose.pose.position.y"
    )
    assert quantity("/joint_states", "position[1]") == quantity("/joint_states", "position[2]")
    assert quantity("/truck/imu", "angular_velocity.z") != quantity("/truck/odom", "twist.twist.angular.z")


def test_the_first_value_beyond_the_bound_is_told() -> None:
    deviations = Deviations()
    assert not deviations.found
    for time, off in ((0.1, 1e-12), (0.2, 3e-9), (0.3, 1e-9), (0.4, 1e-6)):
        deviations.note("/truck/yaw", time, "data", 1.0, 1.0 + off)
    key = quantity("/truck/yaw", "data")
    assert deviations.first_beyond(1e-9, {key: 2.0}).time == 0.2
    assert deviations.first_beyond(1e-9, {key: 100.0}).time == 0.4
    assert deviations.first_beyond(1e-9, {key: 1e4}) is None


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_what_is_no_number_is_off(value: float) -> None:
    deviations = Deviations()
    deviations.note("/truck/yaw", 0.1, "data", 1.0, value)
    assert deviations.first_beyond(1e-9, {quantity("/truck/yaw", "data"): 1.0}).time == 0.1
