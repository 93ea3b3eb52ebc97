"""Recorded drives as arrays: their channels, what a model makes of them, and what they say of a vehicle."""

from yawdamp_ros.drives.channel import QUANTITIES, UNITS, Channel, quantity_of
from yawdamp_ros.drives.drive import INPUTS, Drive
from yawdamp_ros.drives.errors import DriveError

__all__ = ["INPUTS", "QUANTITIES", "UNITS", "Channel", "Drive", "DriveError", "quantity_of"]
