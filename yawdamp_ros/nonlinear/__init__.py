"""The nonlinear model: exact chain, saturating tyres, roll, and events at the limits."""

from yawdamp_ros.nonlinear.compiled import COMPILED
from yawdamp_ros.nonlinear.dynamics import NonlinearDynamics, Steps
from yawdamp_ros.nonlinear.errors import NonlinearError
from yawdamp_ros.nonlinear.events import Event, EventKind
from yawdamp_ros.nonlinear.layout import InputLayout, StateLayout
from yawdamp_ros.nonlinear.outputs import Outputs
from yawdamp_ros.nonlinear.settings import Settings
from yawdamp_ros.nonlinear.steady import Linearisation, SteadyTurn, linearise, steady_turn

__all__ = [
    "COMPILED",
    "Event",
    "EventKind",
    "InputLayout",
    "Linearisation",
    "NonlinearDynamics",
    "NonlinearError",
    "Outputs",
    "Settings",
    "StateLayout",
    "SteadyTurn",
    "Steps",
    "linearise",
    "steady_turn",
]
