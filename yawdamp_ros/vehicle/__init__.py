"""Vehicle combinations as records, and their files."""

from yawdamp_ros.vehicle.complete import Assumed, assumed, complete, given
from yawdamp_ros.vehicle.errors import VehicleError
from yawdamp_ros.vehicle.load import (
    VehicleSource,
    builtin_vehicles,
    examined_vehicle,
    load_stack,
    load_vehicle,
    parse_vehicle,
    vehicle_text,
)
from yawdamp_ros.vehicle.model import STANDARD_GRAVITY, Axle, Unit, Vehicle, unstacked
from yawdamp_ros.vehicle.plausibility import Suspicion, suspicions
from yawdamp_ros.vehicle.source import vehicle_source
from yawdamp_ros.vehicle.statics import StaticLoads, Supports, static_loads, supports
from yawdamp_ros.vehicle.tir import MagicFormula, parse_tir, read_tir
from yawdamp_ros.vehicle.tyres import fancher_stiffness, printed_stiffness

__all__ = [
    "STANDARD_GRAVITY",
    "Assumed",
    "Axle",
    "MagicFormula",
    "StaticLoads",
    "Supports",
    "Suspicion",
    "Unit",
    "Vehicle",
    "VehicleError",
    "VehicleSource",
    "assumed",
    "builtin_vehicles",
    "complete",
    "examined_vehicle",
    "fancher_stiffness",
    "given",
    "load_stack",
    "load_vehicle",
    "parse_tir",
    "parse_vehicle",
    "printed_stiffness",
    "read_tir",
    "static_loads",
    "supports",
    "suspicions",
    "unstacked",
    "vehicle_source",
    "vehicle_text",
]
