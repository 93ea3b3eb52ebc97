"""A run, from its settings to its samples; no ROS.

``command source -> SteeringInput -> SteeringActuator -> Motion.run -> limits -> Sample -> sinks``
"""

from yawdamp_ros.simulation.commands import Commands
from yawdamp_ros.simulation.errors import SimulationError
from yawdamp_ros.simulation.library import simulate
from yawdamp_ros.simulation.limits import Limits, Stop
from yawdamp_ros.simulation.linear_range import LinearRange
from yawdamp_ros.simulation.models import MODELS, make_motion
from yawdamp_ros.simulation.run import Run, Source
from yawdamp_ros.simulation.settings import SimParameters
from yawdamp_ros.simulation.sink import Sink

__all__ = [
    "MODELS",
    "Commands",
    "Limits",
    "LinearRange",
    "Run",
    "SimParameters",
    "SimulationError",
    "Sink",
    "Source",
    "Stop",
    "make_motion",
    "simulate",
]
