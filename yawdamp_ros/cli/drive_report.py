"""Reports of `compare` and `identify`."""

import math
from collections.abc import Sequence
from types import MappingProxyType

from yawdamp_ros.drives import ChannelComparison, Drive, Excitation
from yawdamp_ros.drives.identification import SENSOR_OFFSET
from yawdamp_ros.vehicle import Vehicle

COMPARISON_COLUMNS = ("channel", "bias", "gain", "lag, s", "RMS err", "R2", "R2 max")
SHORT = MappingProxyType({"yaw_rate": "r", "lateral_acceleration": "a_y", "yaw": "yaw"})
"""Words for quantities in a table of 80 columns."""


def told(drive: Drive) -> list[str]:
    """Print the place of each channel."""
    return drive.described()


def label(output: str) -> str:
    """Short name of an output, or of the offset of its sensor."""
    name = output.removeprefix(SENSOR_OFFSET)
    owner, _, quantity = name.rpartition("/")
    words = f"{owner} {SHORT.get(quantity, quantity)}".strip()
    return words if name == output else f"{words} offset"


def comparison_rows(found: Sequence[ChannelComparison]) -> list[tuple[str, ...]]:
    """Rows of `COMPARISON_COLUMNS`."""
    return [
        (
            f"{label(each.output)}, {each.unit.replace('^2', '²')}",
            f"{each.bias:.2g}",
            _number(each.gain, "3f"),
            _number(each.lag, "3f"),
            f"{each.rms_error:.3g}",
            _number(each.r_squared, "3f"),
            _number(each.attainable, "3f"),
        )
        for each in found
    ]


def comparison_record(found: ChannelComparison) -> dict[str, object]:
    """Return a comparison as JSON records."""
    names = ("bias", "gain", "lag", "rms_error", "rms_measured", "rms_simulated", "r_squared", "noise")
    record: dict[str, object] = {"output": found.output, "unit": found.unit}
    record |= {name: _plain(getattr(found, name)) for name in (*names, "attainable")}
    record["samples"] = len(found.times)
    record["coherence"] = {
        "frequency": found.frequencies.tolist(),
        "value": [_plain(value) for value in found.coherence.tolist()],
    }
    return record


def r_squared_range(found: Sequence[ChannelComparison]) -> str:
    """Describe the least and the largest R2 of channels."""
    known = [each.r_squared for each in found if math.isfinite(each.r_squared)]
    if not known:
        return "none"
    least, most = f"{min(known):.2f}", f"{max(known):.2f}"
    return least if least == most else f"{least} to {most}"


def vehicle_line(vehicle: Vehicle, model: str) -> str:
    """Describe a vehicle and its model."""
    mass = sum(unit.mass for unit in vehicle.units) / 1000.0
    return f"{vehicle.name}, {model} model, {len(vehicle.units)} units, {mass:.1f} t"


def excitation_lines(excited: Excitation) -> list[str]:
    """Describe the excitation of a drive."""
    speeds = (
        f"{excited.lowest_speed:.2f} m/s"
        if excited.lowest_speed == excited.highest_speed
        else f"{excited.lowest_speed:.2f} to {excited.highest_speed:.2f} m/s"
    )
    return [
        f"Excitation: {excited.duration:.1f} s at {speeds},",
        (
            f"  steering {excited.steering_rms:.3g} rad rms about its mean, 95 % of its power below "
            f"{excited.steering_bandwidth:.2g} Hz."
        ),
        "r: yaw rate, a_y: lateral acceleration. R2 max is what the noise of the sensor leaves to explain.",
    ]


def _number(value: float, digits: str) -> str:
    return "none" if math.isnan(value) else f"{value:.{digits}}"


def _plain(value: object) -> object:
    return None if isinstance(value, float) and not math.isfinite(value) else value
