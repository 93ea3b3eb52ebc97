"""Publishers of a sample."""

from collections import Counter
from collections.abc import Iterable, Sequence
from typing import Any

from rclpy.event_handler import PublisherEventCallbacks
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.time import Time
from rosgraph_msgs.msg import Clock
from visualization_msgs.msg import MarkerArray

from yawdamp_ros.nodes.errors import NodeError
from yawdamp_ros.nodes.graph import wait_for_subscribers
from yawdamp_ros.nodes.scene import markers
from yawdamp_ros.runs.encoder import Encoded, Encoder, message_class
from yawdamp_ros.runs.outputs import EVENTS
from yawdamp_ros.runs.recipe import EVENT_TYPE, event_message
from yawdamp_ros.runs.run_writer import QUEUE_DEPTH
from yawdamp_ros.simulation import SimParameters
from yawdamp_ros.stepping import Event
from yawdamp_ros.vehicle import Vehicle

NO_EVENTS = PublisherEventCallbacks(use_default_callbacks=False)


class Topics:
    """Publishers of all messages of a sample.

    Parameters
    ----------
    node : Node
    vehicle : Vehicle
    encoder : Encoder
        Encoder of the messages to publish.
    settings : SimParameters
    events : bool
        Whether the model has events.

    Attributes
    ----------
    names : list of str
        Fully qualified names of the topics that the encoder serialises.
    without_tf : str
        Reason for missing frames on ``/tf``; empty if they are published.
    """

    def __init__(
        self, node: Node, vehicle: Vehicle, encoder: Encoder, settings: SimParameters, *, events: bool
    ) -> None:
        self._node = node
        self._vehicle = vehicle
        self._frame_prefix = settings.frame_prefix
        self._publishers = [
            # No event handlers: the executor would add each to a wait set at every wake-up.
            node.create_publisher(message_class(kind), topic, QUEUE_DEPTH, event_callbacks=NO_EVENTS)
            for topic, kind in encoder.types.items()
        ]
        self.names = [publisher.topic_name for publisher in self._publishers]
        for topic, count in Counter(self.names).items():
            if count > 1:
                message = f"topic {topic}: {count} outputs are remapped to it; expected one each"
                raise NodeError(message)
        self._newest: Encoded | None = None
        self._events: Any = None
        if events:
            self._events = node.create_publisher(message_class(EVENT_TYPE), EVENTS, QUEUE_DEPTH)
        self._clock: Any = None
        if settings.clock:
            self.publish_clock()
        self._markers = (
            node.create_publisher(MarkerArray, "markers", QUEUE_DEPTH) if settings.publish_markers else None
        )
        self._frames = encoder.frames
        self._tf, self._tf_static, self.without_tf = None, None, "publish_tf is false"
        if settings.publish_tf:
            self._tf, self._tf_static, self.without_tf = _tf_publishers(node)

    @property
    def clock(self) -> bool:
        """True if simulated time is published on /clock."""
        return self._clock is not None

    def publish_clock(self) -> None:
        """Publish simulated time on /clock from now on, without end: nodes that follow it need it."""
        if self._clock is None:
            self._clock = self._node.create_publisher(Clock, "/clock", QUEUE_DEPTH)

    def write(self, encoded: Encoded) -> None:
        """Publish a sample of one instant."""
        self._newest = encoded
        self._publish_events(encoded.sample.events)
        [stamp], [messages] = encoded.stamps, encoded.messages
        if self._clock is not None:
            self._clock.publish(Clock(clock=Time(nanoseconds=stamp).to_msg()))
        for publisher, data in zip(self._publishers, messages, strict=True):
            publisher.publish(data)
        scene = self._vehicle, encoded.sample, stamp, self._frame_prefix
        if self._tf is not None:
            self._tf.publish(encoded.frames[0])
        if self._tf_static is not None and self._frames is not None:
            self._tf_static.publish(self._frames.fixed(stamp))
            self._tf_static = None  # one message suffices: the publisher belongs to the node
        if self._markers is not None:
            self._markers.publish(markers(*scene))

    def tell(self, events: Sequence[tuple[int, Event]]) -> None:
        """Publish events that no sample bears; see `EncodedSink`."""
        self._publish_events(event for _, event in events)

    def _publish_events(self, events: Iterable[Event]) -> None:
        if self._events is not None:
            for event in events:
                self._events.publish(event_message(event))

    def repeat(self) -> None:
        """Publish the newest sample again for late subscribers."""
        if self._newest is not None:
            self.write(self._newest)

    def close(self) -> None:
        """Wait until subscribers have received all messages."""
        if self._node.context.ok():
            wait_for_subscribers(self._publishers)


def _tf_publishers(node: Node) -> tuple[Any, Any, str]:
    try:
        from tf2_msgs.msg import TFMessage  # noqa: PLC0415 - not on PyPI, so it need not be there
    except ImportError:
        return None, None, "tf2_msgs is not installed"
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    moving = node.create_publisher(TFMessage, "/tf", 100)
    return moving, node.create_publisher(TFMessage, "/tf_static", latched), ""
