"""The walk from a recorded drive to a model shows what its commands print, and finds the truth."""

import re
from collections.abc import Callable

import pytest

from shown import DOCS, differences_of, printed, shown
from yawdamp_ros import load_drive
from yawdamp_ros.drives import identify
from yawdamp_ros.vehicle import VehicleSource, vehicle_text

SHOWN = shown("recorded_drive.md")


@pytest.fixture(scope="module")
def differences() -> Callable[[str, str], list[str]]:
    return differences_of()


@pytest.mark.parametrize("command, output", SHOWN, ids=range(len(SHOWN)))
def test_output_is_what_the_command_prints(
    command: str, output: str, differences: Callable[[str, str], list[str]]
) -> None:
    assert output
    assert differences(output, printed(command)) == []


def test_what_the_drive_was_made_of_lies_within_the_intervals() -> None:
    drive = load_drive(DOCS / "recorded_drive.csv").steered_by(18.0)
    found = identify(drive, VehicleSource(vehicle_text("truck_trailer"), ()))
    for name, truth in {"stiffness": 0.85, "inertia": 1.0, "steering_offset": 0.003879}.items():
        assert found[name].low <= truth <= found[name].high, name
    assert found["offset of truck/yaw_rate"].low <= 0.00698 <= found["offset of truck/yaw_rate"].high


def test_everything_linked_is_there() -> None:
    for target in re.findall(r"\]\(([^)#]+)", (DOCS / "recorded_drive.md").read_text(encoding="utf-8")):
        assert (DOCS / target).is_file(), target
