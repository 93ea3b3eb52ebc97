"""The walk from a recorded drive to a model finds the truth."""

from pathlib import Path

from yawdamp_ros import load_drive
from yawdamp_ros.drives import identify
from yawdamp_ros.vehicle import VehicleSource, vehicle_text

DOCS = Path(__file__).parents[2] / "docs"


def test_what_the_drive_was_made_of_lies_within_the_intervals() -> None:
    drive = load_drive(DOCS / "recorded_drive.csv").steered_by(18.0)
    found = identify(drive, VehicleSource(vehicle_text("truck_trailer"), ()))
    for name, truth in {"stiffness": 0.85, "inertia": 1.0, "steering_offset": 0.003879}.items():
        assert found[name].low <= truth <= found[name].high, name
    assert found["offset of truck/yaw_rate"].low <= 0.00698 <= found["offset of truck/yaw_rate"].high
