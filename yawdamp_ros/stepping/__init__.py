"""Time: one fixed step, the same object for the node and for offline runs."""

from yawdamp_ros.stepping.delayed_demand import DelayedDemand
from yawdamp_ros.stepping.errors import SteppingError
from yawdamp_ros.stepping.held_input import HeldInput
from yawdamp_ros.stepping.motion import Motion
from yawdamp_ros.stepping.pacer import Pacer
from yawdamp_ros.stepping.response import Response, linear_response
from yawdamp_ros.stepping.sample import AppliedInput, Command, Event, Sample
from yawdamp_ros.stepping.start import Start
from yawdamp_ros.stepping.steering_actuator import SteeringActuator
from yawdamp_ros.stepping.steering_input import SteeringInput
from yawdamp_ros.stepping.stepper import Stepper
from yawdamp_ros.stepping.time_grid import TimeGrid
from yawdamp_ros.stepping.verdict import Verdict

__all__ = [
    "AppliedInput",
    "Command",
    "DelayedDemand",
    "Event",
    "HeldInput",
    "Motion",
    "Pacer",
    "Response",
    "Sample",
    "Start",
    "SteeringActuator",
    "SteeringInput",
    "Stepper",
    "SteppingError",
    "TimeGrid",
    "Verdict",
    "linear_response",
]
