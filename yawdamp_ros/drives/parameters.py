"""Parameters that a drive can determine, and their effect on a vehicle and its steering."""

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from yawdamp_ros.drives.errors import DriveError
from yawdamp_ros.drives.prediction import Inputs
from yawdamp_ros.vehicle import Unit, Vehicle, VehicleError, VehicleSource, complete, parse_vehicle
from yawdamp_ros.vehicle.load import value_at

FACTORS = ("stiffness", "inertia")
"""Factors of every cornering stiffness, or every yaw inertia, of the vehicle; after a dot, of one unit."""
STEERING = ("steering_ratio", "steering_offset", "steering_time_constant", "steering_delay")
FRICTION = "friction"
"""Key of the road's friction, which only the nonlinear model has."""
DEFAULT = ("stiffness", "inertia", "steering_offset")
_POSITIVE = re.compile(r".*\.(mass|yaw_inertia|cornering_stiffness|tyre_load)|friction|.*friction")


@dataclass(frozen=True)
class Parameter:
    """Number to be identified.

    Attributes
    ----------
    name : str
        A factor of `FACTORS`, one of `STEERING`, or a key of the vehicle file such as `FRICTION` or
        ``units.1.load.0.position``.
    unit : str
        Unit of the value; empty for factors and ratios.
    start : float
        Value before the fit.
    scale : float
        Size of a change that matters; a wider interval says that the drive does not show the parameter.
    positive : bool
        Whether its logarithm is fitted.

    Examples
    --------
    >>> from yawdamp_ros.drives import Parameter
    >>> Parameter("stiffness", "", start=1.0, scale=0.5, positive=True).value(0.0)
    1.0
    """

    name: str
    unit: str
    start: float
    scale: float
    positive: bool

    def value(self, coordinate: float) -> float:
        """Value at the fit's coordinate, which is 0 at the start."""
        if self.positive:
            return self.start * math.exp(min(max(coordinate, -5.0), 5.0))
        return self.start + self.scale * coordinate


class Subject:
    """A vehicle and its steering as a function of parameters.

    Parameters
    ----------
    source : VehicleSource
        Source of the vehicle.
    names : sequence of str
        Names of the parameters to be identified.

    Raises
    ------
    DriveError
        If there is no such parameter.
    """

    def __init__(self, source: VehicleSource, names: Sequence[str]) -> None:
        self._source = source
        self.vehicle = parse_vehicle(source.text, "vehicle", source.overrides)
        self.parameters = tuple(self._parameter(name) for name in dict.fromkeys(names))

    def vehicle_with(self, values: Mapping[str, float]) -> Vehicle:
        """Vehicle of some values of the parameters."""
        keys = [f"{name}={values[name]!r}" for name in values if _is_key(name)]
        vehicle = self.vehicle
        if keys:
            vehicle = parse_vehicle(self._source.text, "vehicle", [*self._source.overrides, *keys])
        units = tuple(_scaled(unit, values) for unit in vehicle.units)
        return replace(vehicle, units=units)

    def overrides(self, values: Mapping[str, float]) -> list[str]:
        """Changes to the vehicle file that make it the vehicle of some values, each ``KEY=VALUE``."""
        found = self.vehicle_with(values)
        changes = [f"{name}={values[name]:.6g}" for name in values if _is_key(name)]
        for index, (unit, before) in enumerate(zip(found.units, self.vehicle.units, strict=True)):
            if unit.yaw_inertia != before.yaw_inertia and not any(map(_is_key, values)):
                changes.append(f"units.{index}.yaw_inertia={unit.yaw_inertia:.6g}")
            for place, (axle, axle_before) in enumerate(zip(unit.axles, before.axles, strict=True)):
                if axle.cornering_stiffness != axle_before.cornering_stiffness:
                    key = f"units.{index}.axles.{place}.cornering_stiffness"
                    changes.append(f"{key}={axle.cornering_stiffness:.6g}")
        return changes

    def _parameter(self, name: str) -> Parameter:
        if name == "steering_ratio":
            return Parameter(name, "", 1.0, 0.5, positive=True)
        if name == "steering_offset":
            return Parameter(name, "rad", 0.0, 0.01, positive=False)
        if name == "steering_delay":
            return Parameter(name, "s", 0.0, 0.02, positive=False)
        if name == "steering_time_constant":
            return Parameter(name, "s", 0.1, 0.1, positive=True)
        factor, _, unit = name.partition(".")
        if factor in FACTORS and unit in {"", *self.vehicle.unit_names}:
            return Parameter(name, "", 1.0, 0.5, positive=True)
        if not _is_key(name):
            expected = ", ".join([*FACTORS, *(f"{each}.UNIT" for each in FACTORS), *STEERING])
            message = (
                f"{name}: expected one of {expected}, {FRICTION}, or a key of the vehicle as in units.1.mass"
            )
            raise DriveError(message)
        start = self._value_at(name)
        positive = bool(_POSITIVE.fullmatch(name)) and start > 0.0
        return Parameter(name, "", start, 0.5 * abs(start) if positive else 1.0, positive=positive)

    def _value_at(self, key: str) -> float:
        """Number in the vehicle file, or the one that is assumed for it."""
        try:
            return value_at(self._source, key)
        except VehicleError:
            node: Any = complete(self.vehicle)
            try:
                for part in key.split("."):
                    node = node[int(part)] if part.isdecimal() else getattr(node, part)
                return float(node)
            except (AttributeError, IndexError, TypeError, ValueError):
                node = None
            raise


def steered(inputs: Inputs, values: Mapping[str, float]) -> Inputs:
    """Inputs after the steering that some values describe: less its offset, over its ratio, lagged."""
    offset, ratio = values.get("steering_offset", 0.0), values.get("steering_ratio", 1.0)
    lag = values.get("steering_time_constant", 0.0)
    instant, mean = (inputs.steering - offset) / ratio, (inputs.mean_steering - offset) / ratio
    if not lag:
        return inputs._replace(steering=instant, mean_steering=mean)
    from scipy.signal import lfilter  # noqa: PLC0415 - it loads longer than most commands run

    step = float(inputs.times[1] - inputs.times[0])
    kept = math.exp(-step / lag)
    # The angle at each instant, and its mean until the next: the lag's exact answer to a held demand.
    wheel = np.append(instant[:1], mean[:-1])
    angle, _ = lfilter([1.0 - kept], [1.0, -kept], wheel, zi=[kept * instant[0]])
    share = lag / step * (1.0 - kept)
    return inputs._replace(steering=angle, mean_steering=mean + share * (angle - mean))


def _scaled(unit: Unit, values: Mapping[str, float]) -> Unit:
    def factor(name: str) -> float:
        return values.get(name, 1.0) * values.get(f"{name}.{unit.name}", 1.0)

    stiffness = factor("stiffness")
    axles = tuple(
        replace(axle, cornering_stiffness=axle.cornering_stiffness * stiffness) for axle in unit.axles
    )
    return replace(unit, yaw_inertia=unit.yaw_inertia * factor("inertia"), axles=axles)


def _is_key(name: str) -> bool:
    return name == FRICTION or name.startswith("units.")
