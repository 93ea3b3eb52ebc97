"""Steering as a function of time."""

from yawdamp_ros.manoeuvres.errors import ManoeuvreError
from yawdamp_ros.manoeuvres.manoeuvre import MANOEUVRES, Manoeuvre, make_manoeuvre
from yawdamp_ros.manoeuvres.shapes import Chirp, LaneChange, Pulse, Ramp, Sine, Step

__all__ = [
    "MANOEUVRES",
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
