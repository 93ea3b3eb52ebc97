"""Subscriptions of the simulator."""

import time
from collections.abc import Callable
from typing import Any

from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from std_msgs.msg import Float64

from yawdamp_ros.nodes.errors import NodeError
from yawdamp_ros.nodes.guard import Guard
from yawdamp_ros.nodes.states import VERDICT_SENTENCES
from yawdamp_ros.runs.encoder import message_class
from yawdamp_ros.runs.run_writer import QUEUE_DEPTH
from yawdamp_ros.simulation import Commands
from yawdamp_ros.simulation.commands import ACCEPTED
from yawdamp_ros.simulation.steering_messages import LONGITUDINAL_TYPES, STEERING_TYPES, message_stamp
from yawdamp_ros.stepping import Verdict
from yawdamp_ros.stepping.time_grid import SECOND

WARNING_PERIOD = 5.0
"""Seconds between warnings of one kind."""
STEADY = Clock(clock_type=ClockType.STEADY_TIME)
"""Clock of rclpy's throttling: a jump back of the system's clock would silence it for as long as the jump."""
QUIET = SubscriptionEventCallbacks(use_default_callbacks=False)
"""No callbacks of rclpy: `Neighbours` reports a mismatch and names the other node."""


def steering_class(type_name: str) -> Any:  # noqa: ANN401 - generated classes share no base
    """Class of a message type that can hold steering.

    Raises
    ------
    NodeError
        If the package that defines it is not installed.
    """
    try:
        return message_class(type_name)
    except (ImportError, AttributeError) as error:
        package = type_name.partition("/")[0]
        message = f"parameter steering_type: {type_name}: needs the package {package}, which is not installed"
        raise NodeError(message) from error


class SteeringSubscription:
    """Hands steering commands of any of the known types to `Commands`.

    Parameters
    ----------
    node : Node
    type_name : str
        One of `STEERING_TYPES`.
    joint : str
        Joint that steers, where the type is JointState.
    target : Commands
    now : callable
        Time in ns that stamps are held against.
    guard : Guard
    topic : str

    Attributes
    ----------
    topic : str

    Raises
    ------
    NodeError
        If the message package is not installed.
    """

    def __init__(  # noqa: PLR0913 - each is one thing that a command is judged by
        self,
        node: Node,
        type_name: str,
        joint: str,
        target: Commands,
        *,
        now: Callable[[], int],
        guard: Guard,
        topic: str = "steering",
    ) -> None:
        self._receive = guard(self._judge)
        self.topic = topic
        self._warn = _Warnings(node, topic)
        self._angle = STEERING_TYPES[type_name]
        self._demand = LONGITUDINAL_TYPES.get(type_name)
        self._joint = joint
        self._target = target
        self._now = now
        self._subscription = node.create_subscription(
            steering_class(type_name), topic, self._receive, QUEUE_DEPTH, event_callbacks=QUIET
        )

    def take(self) -> None:
        """Drain pending commands now, so that they act in this sample rather than one period later."""
        _drain(self._subscription, self._receive)

    def _judge(self, message: Any) -> None:  # noqa: ANN401 - of the type asked for
        command = self._angle(message, self._joint)
        if command is None:
            self._target.steering_input.reject(Verdict.NO_JOINT)
            self._warn(Verdict.NO_JOINT, f"no joint {self._joint!r} with a position")
            return
        stamp = message_stamp(message)
        age = (self._now() - stamp) / SECOND if stamp else None
        verdict = self._target.steer(command, age, message)
        if verdict is not Verdict.ACCEPTED:
            stamped = "" if age is None else f", stamped {age:.3g} s ago"
            count = self._target.steering_input.counts[verdict]
            self._warn(verdict, f"{command}{stamped}: {VERDICT_SENTENCES[verdict]}, {count} so far")
        if self._demand is not None and verdict in ACCEPTED and self._target.by_steering:
            name, value, verdict = self._target.follow(self._demand(message))
            if verdict is not Verdict.ACCEPTED:
                count = self._target.held[name].counts[verdict]
                self._warn(verdict, f"{name} {value}: {VERDICT_SENTENCES[verdict]}, {count} so far")


class InputSubscription:
    """Hands one of the inputs besides steering to `Commands`.

    Parameters
    ----------
    node : Node
    name : str
        One of `Commands.held`.
    target : Commands
    guard : Guard
    topic : str
        Topic; empty for the name.
    kind : type
        Message class.
    value : callable
        Function from a message to the value.

    Attributes
    ----------
    topic : str
    """

    def __init__(  # noqa: PLR0913 - the last three are of inputs in other packages' words
        self,
        node: Node,
        name: str,
        target: Commands,
        guard: Guard,
        *,
        topic: str = "",
        kind: Any = Float64,  # noqa: ANN401 - generated classes share no base
        value: Callable[[Any], float] = lambda message: float(message.data),
    ) -> None:
        self.topic = topic or name
        self._name, self._target, self._value = name, target, value
        self._receive = guard(self._judge)
        self._warn = _Warnings(node, name)
        self._subscription = node.create_subscription(
            kind, self.topic, self._receive, QUEUE_DEPTH, event_callbacks=QUIET
        )

    def take(self) -> None:
        """See `SteeringSubscription.take`."""
        _drain(self._subscription, self._receive)

    def _judge(self, message: Any) -> None:  # noqa: ANN401 - of the kind
        value = self._value(message)
        verdict = self._target.demand(self._name, value)
        if verdict is not Verdict.ACCEPTED:
            count = self._target.held[self._name].counts[verdict]
            self._warn(verdict, f"{value}: {VERDICT_SENTENCES[verdict]}, {count} so far")


class _Warnings:
    """Warnings of a topic, throttled by verdict: rclpy throttles by line of code, which would mix them."""

    def __init__(self, node: Node, topic: str) -> None:
        self._node, self._topic = node, topic
        self._warned_at: dict[Verdict, float] = {}

    def __call__(self, verdict: Verdict, text: str) -> None:
        now = time.monotonic()
        if now - self._warned_at.get(verdict, -WARNING_PERIOD) >= WARNING_PERIOD:
            self._warned_at[verdict] = now
            self._node.get_logger().warning(f"{self._topic}: {text}")


def _drain(subscription: Any, receive: Callable[[Any], None]) -> None:  # noqa: ANN401 - rclpy's
    """Take pending messages."""
    # Same call as in rclpy's executor, which has no public one. Without it, commands wait for the executor.
    if not hasattr(subscription.handle, "take_message"):
        return
    for _ in range(QUEUE_DEPTH):
        with subscription.handle:
            taken = subscription.handle.take_message(subscription.msg_type, subscription.raw)
        if taken is None:
            return
        receive(taken[0])
