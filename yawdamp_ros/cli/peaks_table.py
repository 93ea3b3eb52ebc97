"""The peaks that end a run, as a table and as a record."""

from collections.abc import Iterable
from typing import Any

from yawdamp_ros.analysis.peaks import Peaks
from yawdamp_ros.cli.table import print_table
from yawdamp_ros.dynamics import LinearModel
from yawdamp_ros.simulation import Stop
from yawdamp_ros.stepping import Event, TimeGrid


def print_peaks(model: LinearModel, peaks: Peaks, note: str) -> None:
    """Print the largest magnitudes of each unit, and a note where the linear range was left."""
    units = zip(
        model.vehicle.unit_names,
        peaks.yaw,
        peaks.yaw_rate,
        peaks.lateral_acceleration,
        strict=True,
    )
    print_table(
        f"Peaks of {model.vehicle.name} at {model.speed:.4g} m/s ({model.model} model)",
        ("unit", "yaw [rad]", "yaw rate [rad/s]", "lateral acceleration [m/s²]"),
        [
            (name, f"{yaw:.4f}", f"{yaw_rate:.4f}", f"{acceleration:.3f}")
            for name, yaw, yaw_rate, acceleration in units
        ],
    )
    if note:
        print(f"note: {note}")


def print_events(events: Iterable[Event], grid: TimeGrid, prefix: str = "") -> None:
    """Print the events of the vehicle, one on each line."""
    for event in events:
        name = event.name.replace("_", " ")
        print(f"{prefix}{name} of {event.where} at {grid.seconds(event.step):.3f} s")


def peaks_record(model: LinearModel, peaks: Peaks, beyond: Stop | None, grid: TimeGrid) -> dict[str, Any]:
    """Largest magnitudes of each unit in SI units, and where the run first left the linear range."""
    left = None
    if beyond is not None:
        left = {"time": grid.seconds(beyond.step), "quantity": beyond.key, "where": beyond.where}
    return {
        "vehicle": model.vehicle.name,
        "model": model.model,
        "speed": model.speed,
        "peaks": {
            name: {
                "yaw": float(peaks.yaw[index]),
                "yaw_rate": float(peaks.yaw_rate[index]),
                "lateral_acceleration": float(peaks.lateral_acceleration[index]),
            }
            for index, name in enumerate(model.vehicle.unit_names)
        },
        "beyond_linear_range": left,
    }
