"""The short table that ends a run."""

from collections.abc import Sequence

from yawdamp_ros.analysis.peaks import Peaks
from yawdamp_ros.cli.table import print_table
from yawdamp_ros.dynamics import LinearModel
from yawdamp_ros.stepping import Event


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


def event_text(event: Event, step_size: float) -> str:
    """An event in words, with its simulated time."""
    return f"{event.name.replace('_', ' ')} of {event.where} at {event.step * step_size:.3f} s"


def print_events(events: Sequence[Event], step_size: float) -> None:
    """Print what happened, a line each."""
    for event in events:
        print(event_text(event, step_size))
