"""Starting, climbing and gaining speed."""

import math

import pytest

from yawdamp_ros.analysis import AnalysisError
from yawdamp_ros.analysis.traction import (
    acceleration_capability,
    gradeability,
    gradeability_speed,
    startability,
)
from yawdamp_ros.vehicle import STANDARD_GRAVITY, complete, load_vehicle

PLAIN = ["drag_area=0", "friction=2"]
ROLLING = 0.006


def weight(name: str) -> float:
    return STANDARD_GRAVITY * sum(unit.mass for unit in load_vehicle(name).units)


def test_the_grade_of_a_force_balances_weight_and_rolling() -> None:
    force = 8e4
    grade = startability(load_vehicle("truck_trailer", [f"start_force={force}", *PLAIN])) / 100.0
    angle = math.atan(grade)
    assert weight("truck_trailer") * (math.sin(angle) + ROLLING * math.cos(angle)) == pytest.approx(force)


def test_friction_under_the_driven_axles_limits_the_grade() -> None:
    vehicle = load_vehicle("truck_trailer", ["drive_force=1e7", "friction=0.4"])
    driven = sum(axle.static_load for unit in complete(vehicle).units for axle in unit.axles if axle.driven)
    assert gradeability(vehicle) == pytest.approx(100.0 * (0.4 * driven / weight("truck_trailer") - ROLLING))


def test_power_balances_at_the_speed_on_a_slight_grade() -> None:
    vehicle = load_vehicle("a_double", ["drive_force=2e5", "drive_power=3.5e5"])
    speed = gradeability_speed(vehicle) / 3.6
    rolling = sum(axle.static_load * ROLLING for unit in complete(vehicle).units for axle in unit.axles)
    force = (rolling + 0.01 * weight("a_double")) / math.hypot(1.0, 0.01) + 0.5 * 1.2 * 6.0 * speed**2
    assert force * speed == pytest.approx(3.5e5, rel=1e-6)


def test_a_constant_force_takes_the_time_of_constant_acceleration() -> None:
    vehicle = load_vehicle("truck_trailer", ["drive_force=5e4", "drive_power=1e8", *PLAIN])
    force = 5e4 - ROLLING * weight("truck_trailer")
    assert acceleration_capability(vehicle) == pytest.approx(
        math.sqrt(200.0 * weight("truck_trailer") / STANDARD_GRAVITY / force), rel=1e-6
    )


def test_what_lacks_is_named() -> None:
    for measure, key in (
        (startability, "start_force"),
        (gradeability, "drive_force"),
        (gradeability_speed, "drive_force"),
        (acceleration_capability, "drive_force"),
    ):
        with pytest.raises(AnalysisError, match=f"{measure.__name__} needs {key}, which"):
            measure(load_vehicle("interlink"))
    with pytest.raises(AnalysisError, match="less than the rolling resistance"):
        acceleration_capability(load_vehicle("interlink", ["drive_force=10", "drive_power=1e5"]))
