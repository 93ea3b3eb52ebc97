"""Time: one fixed step, the same object for the node and for offline runs."""

from yawdamp_ros.stepping.errors import SteppingError
from yawdamp_ros.stepping.pacer import Pacer
from yawdamp_ros.stepping.response import Response, linear_response, simulate
from yawdamp_ros.stepping.sample import AppliedInput, Sample
from yawdamp_ros.stepping.speed_input import SpeedInput
from yawdamp_ros.stepping.steering_actuator import SteeringActuator
from yawdamp_ros.stepping.steering_input import SteeringInput
from yawdamp_ros.stepping.stepper import Snapshot, Stepper
from yawdamp_ros.stepping.time_grid import TimeGrid
from yawdamp_ros.stepping.validity import meaningless
from yawdamp_ros.stepping.verdict import Verdict

__all__ = [
    "AppliedInput",
    "Pacer",
    "Response",
    "Sample",
    "Snapshot",
    "SpeedInput",
    "SteeringActuator",
    "SteeringInput",
    "Stepper",
    "SteppingError",
    "TimeGrid",
    "Verdict",
    "linear_response",
    "meaningless",
    "simulate",
]
