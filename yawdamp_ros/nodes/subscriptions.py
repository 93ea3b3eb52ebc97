"""What the simulator listens to."""

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
from yawdamp_ros.simulation.steering_messages import STEERING_TYPES, message_stamp
from yawdamp_ros.stepping import SpeedInput, Verdict
from yawdamp_ros.stepping.time_grid import SECOND

WARNING_PERIOD = 5.0
"""Seconds between warnings of one kind."""
STEADY = Clock(clock_type=ClockType.STEADY_TIME)
"""What rclpy is to throttle by: by the system's clock, a jump back silences it for as long as the jump."""
QUIET = SubscriptionEventCallbacks(use_default_callbacks=False)
"""What does not fit is said by `Neighbours`, which knows whose it is."""


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
    ) -> None:
        self._receive = guard(self._judge)
        self._warned_at: dict[Verdict, float] = {}
        self._node = node
        self._angle = STEERING_TYPES[type_name]
        self._joint = joint
        self._target = target
        self._now = now
        self._subscription = node.create_subscription(
            steering_class(type_name), "steering", self._receive, QUEUE_DEPTH, event_callbacks=QUIET
        )
        # As rclpy's executor takes: it has no public call for it. Without, commands wait for the executor.
        self._can_take = hasattr(self._subscription.handle, "take_message")

    def take(self) -> None:
        """Drain pending commands now, so that they act in this sample rather than one period later."""
        subscription = self._subscription
        for _ in range(QUEUE_DEPTH if self._can_take else 0):
            with subscription.handle:
                taken = subscription.handle.take_message(subscription.msg_type, subscription.raw)
            if taken is None:
                break
            self._receive(taken[0])

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

    def _warn(self, kind: Verdict, text: str) -> None:
        # rclpy throttles by line of code; of two kinds of trouble neither may hide the other.
        now = time.monotonic()
        if now - self._warned_at.get(kind, -WARNING_PERIOD) >= WARNING_PERIOD:
            self._warned_at[kind] = now
            self._node.get_logger().warning(f"steering: {text}")


def subscribe_speed(node: Node, target: SpeedInput, guard: Guard) -> None:
    """Hand the speed topic to a `SpeedInput`."""

    def receive(message: Float64) -> None:
        verdict = target.offer(message.data)
        if verdict is not Verdict.ACCEPTED:
            node.get_logger().warning(
                f"speed: {message.data}: {VERDICT_SENTENCES[verdict]}, {target.counts[verdict]} so far",
                throttle_duration_sec=WARNING_PERIOD,
                throttle_time_source_type=STEADY,
            )

    node.create_subscription(Float64, "speed", guard(receive), QUEUE_DEPTH, event_callbacks=QUIET)
