"""Autoware's vehicle interface, for a node where its messages are installed.

Topics and signs are those of its simple_planning_simulator: a positive acceleration drives in the direction
of the gear. Names are relative, so that a namespace keeps rigs apart.
"""

from collections.abc import Callable, Sequence
from typing import Any

from geometry_msgs.msg import Point, Quaternion, Vector3
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.time import Time

from yawdamp_ros.nodes.errors import NodeError
from yawdamp_ros.nodes.guard import Guard
from yawdamp_ros.nodes.subscriptions import InputSubscription
from yawdamp_ros.runs.encoder import Encoded, message_class
from yawdamp_ros.runs.run_writer import QUEUE_DEPTH
from yawdamp_ros.simulation import Commands
from yawdamp_ros.stepping import Event
from yawdamp_ros.stepping.pose import pose
from yawdamp_ros.vehicle import Unit, supports

CONTROL = "control/command/control_cmd"
"""Topic that steers and drives, in place of ``steering``."""
GEAR = "control/command/gear_cmd"
STATUS = "vehicle/status/"
NEUTRAL, DRIVE, LAST_DRIVE, REVERSE, REVERSE_2, PARK, LOW, LOW_2 = 1, 2, 19, 20, 21, 22, 23, 24
"""Gears of autoware_vehicle_msgs' GearCommand."""
AUTONOMOUS = 1
"""Mode of its ControlModeReport."""


def gear(command: int) -> float:
    """Gear of the model by a gear of Autoware.

    Parameters
    ----------
    command : int
        Field of GearCommand.

    Returns
    -------
    float
        1 forwards, 0 neutral, -1 backwards; NaN for none of them, which is rejected.

    Examples
    --------
    >>> gear(20)
    -1.0
    """
    if DRIVE <= command <= LAST_DRIVE or command in {LOW, LOW_2}:
        return 1.0
    if command in {REVERSE, REVERSE_2}:
        return -1.0
    return 0.0 if command in {NEUTRAL, PARK} else float("nan")


def gear_subscription(node: Node, target: Commands, guard: Guard) -> InputSubscription:
    """Subscribe to gears, in place of the topic ``gear``.

    Raises
    ------
    NodeError
        If autoware_vehicle_msgs is not installed.
    """
    kind = _class("GearCommand")
    return InputSubscription(
        node, "gear", target, guard, topic=GEAR, kind=kind, value=lambda message: gear(message.command)
    )


class AutowareStatus:
    """Publishers of what Autoware's nodes know of a vehicle, an `EncodedSink`.

    Parameters
    ----------
    node : Node
    lead : Unit
        Unit whose rear axles are Autoware's ``base_link``.
    commands : Commands
        Commands of the run, for the gear in force.
    world : str
        Frame of the pose.

    Raises
    ------
    NodeError
        If autoware_vehicle_msgs is not installed.
    """

    def __init__(self, node: Node, lead: Unit, commands: Commands, world: str) -> None:
        def publisher(kind: Any, topic: str) -> Callable[[Any], None]:  # noqa: ANN401 - generated
            publish: Callable[[Any], None] = node.create_publisher(kind, topic, QUEUE_DEPTH).publish
            return publish

        kinds = [_class(f"{name}Report") for name in ("Velocity", "Steering", "Gear", "ControlMode")]
        self._velocity, self._steering, self._gear, self._mode = kinds
        topics = ("velocity_status", "steering_status", "gear_status", "control_mode")
        self._publish = [publisher(kind, STATUS + topic) for kind, topic in zip(kinds, topics, strict=True)]
        self._locate = publisher(Odometry, "localization/kinematic_state")
        self._rear = supports(lead).rear
        self._commands, self._world = commands, world

    def write(self, encoded: Encoded) -> None:
        """Publish a sample of one instant; see `EncodedSink`."""
        sample = encoded.sample
        stamp = Time(nanoseconds=encoded.stamps[0]).to_msg()
        forward, yaw_rate = float(sample.velocity[0].real), float(sample.yaw_rate[0])
        left = float(sample.velocity[0].imag) + self._rear * yaw_rate
        velocity = self._velocity(longitudinal_velocity=forward, lateral_velocity=left, heading_rate=yaw_rate)
        velocity.header.stamp, velocity.header.frame_id = stamp, "base_link"
        messages = (
            velocity,
            self._steering(stamp=stamp, steering_tire_angle=float(sample.steering_angle)),
            self._gear(stamp=stamp, report=self._present_gear()),
            self._mode(stamp=stamp, mode=AUTONOMOUS),
        )
        for publish, message in zip(self._publish, messages, strict=True):
            publish(message)
        place, half = pose(sample, 0, ahead=self._rear)
        state = Odometry(child_frame_id="base_link")
        state.header.stamp, state.header.frame_id = stamp, self._world
        state.pose.pose.position = Point(x=place.real, y=place.imag)
        state.pose.pose.orientation = Quaternion(z=half.imag, w=half.real)
        state.twist.twist.linear, state.twist.twist.angular = Vector3(x=forward, y=left), Vector3(z=yaw_rate)
        self._locate(state)

    def tell(self, events: Sequence[tuple[int, Event]]) -> None:
        """See `EncodedSink`; Autoware has no topic of them."""

    def close(self) -> None:
        """See `EncodedSink`."""

    def _present_gear(self) -> int:
        held = self._commands.held.get("gear")
        value = None if held is None else held.value
        return DRIVE if value is None or value > 0.0 else REVERSE if value < 0.0 else NEUTRAL


def _class(name: str) -> Any:  # noqa: ANN401 - generated classes share no base
    try:
        return message_class(f"autoware_vehicle_msgs/msg/{name}")
    except (ImportError, AttributeError) as error:
        message = "parameter autoware: needs the package autoware_vehicle_msgs, which is not installed"
        raise NodeError(message) from error
