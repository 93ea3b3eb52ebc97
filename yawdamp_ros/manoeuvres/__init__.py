"""Steering as a function of time."""

from yawdamp_ros.manoeuvres.errors import ManoeuvreError
from yawdamp_ros.manoeuvres.manoeuvre import MANOEUVRES, SETTINGS, Manoeuvre, make_manoeuvre
from yawdamp_ros.manoeuvres.shapes import Chirp, LaneChange, Pulse, Ramp, Sine, Step

__all__ = [
    "MANOEUVRES",
    "SETTINGS",
    "Chirp",
    "LaneChange",
    "Manoeuvre",
    "ManoeuvreError",
    "Pulse",
    "Ramp",
    "Sine",
    "Step",
    "make_manoeuvre",
]
