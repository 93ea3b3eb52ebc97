"""Sources of vehicles: enough to read a vehicle again where its files are not."""

from pathlib import Path

import pytest

from vehicle.test_tir import TYRE
from yawdamp_ros.vehicle import (
    MagicFormula,
    Vehicle,
    VehicleError,
    load_vehicle,
    parse_vehicle,
    vehicle_source,
    vehicle_text,
)


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "mine.yaml"
    path.write_text(vehicle_text("a_double").replace("steered: true", "steered: true, tyre: truck.tir"))
    (tmp_path / "truck.tir").write_text(TYRE)
    return path


def coefficients(vehicle: Vehicle) -> list[list[tuple[float, ...]]]:
    return [
        [axle.tyre.coefficients for axle in unit.axles if isinstance(axle.tyre, MagicFormula)]
        for unit in vehicle.units
    ]


def test_a_source_without_tyre_files_is_the_file_itself() -> None:
    assert vehicle_source("interlink", ["speed=20"]) == (vehicle_text("interlink"), ("speed=20",))


def test_tyre_files_are_in_the_source_wherever_they_are_named(file: Path) -> None:
    overrides = ["units.1.axles.0.tyre=truck.tir", "speed=20"]
    before = load_vehicle(file, overrides)
    source = vehicle_source(file, overrides)
    (file.parent / "truck.tir").unlink()
    after = parse_vehicle(source.text, "elsewhere", source.overrides)
    assert after.speed == 20.0
    assert coefficients(after) == coefficients(before)
    assert [len(found) for found in coefficients(after)] == [1, 1, 0, 0]


def test_a_missing_tyre_file_is_said_to_be_missing(file: Path) -> None:
    (file.parent / "truck.tir").unlink()
    with pytest.raises(VehicleError, match=r"truck\.tir: cannot be read: No such file"):
        vehicle_source(file)


def test_more_than_a_recording_holds_is_refused(file: Path) -> None:
    (file.parent / "truck.tir").write_text(TYRE + "$\n" * 100_000)
    with pytest.raises(VehicleError, match=r"characters with its \.tir files: expected up to 262144"):
        vehicle_source(file, [f"units.{unit}.axles.0.tyre=truck.tir" for unit in range(4)])
