"""What a vehicle combination is, and how one is read from a file."""

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
from yawdamp_ros.vehicle.tyres import fancher_stiffness, printed_stiffness

__all__ = [
    "STANDARD_GRAVITY",
    "Axle",
    "Suspicion",
    "Unit",
    "Vehicle",
    "VehicleError",
    "VehicleSource",
    "builtin_vehicles",
    "examined_vehicle",
    "fancher_stiffness",
    "load_stack",
    "load_vehicle",
    "parse_vehicle",
    "printed_stiffness",
    "suspicions",
    "unstacked",
    "vehicle_text",
]
