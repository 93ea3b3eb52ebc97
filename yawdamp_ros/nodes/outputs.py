"""What the simulator publishes of a sample."""

from typing import Any

from rclpy.event_handler import PublisherEventCallbacks
from rclpy.node import Node
from rclpy.time import Time
from rosgraph_msgs.msg import Clock
from visualization_msgs.msg import MarkerArray

from yawdamp_ros.nodes.graph import wait_for_subscribers
from yawdamp_ros.nodes.messages import Noise, OutputMessages
from yawdamp_ros.nodes.scene import markers, transforms
from yawdamp_ros.simulation.settings import SimParameters
from yawdamp_ros.stepping import Sample
from yawdamp_ros.vehicle import Vehicle

QUEUE_DEPTH = 10
NO_EVENTS = PublisherEventCallbacks(use_default_callbacks=False)


class Outputs:
    """Publishers of everything that a sample becomes.

    Parameters
    ----------
    node : Node
    vehicle : Vehicle
    settings : SimParameters

    Attributes
    ----------
    messages : OutputMessages
        Those that are recorded, too.
    topics : list of str
        Their fully qualified names.
    without_tf : str
        Why there are no frames on ``/tf``; empty if there are.
    """

    def __init__(self, node: Node, vehicle: Vehicle, settings: SimParameters) -> None:
        self._vehicle = vehicle
        noise = Noise(
            settings.yaw_stddev,
            settings.yaw_rate_stddev,
            settings.lateral_acceleration_stddev,
            settings.noise_seed,
        )
        self._frame_prefix = settings.frame_prefix
        self.messages = OutputMessages(
            vehicle.unit_names,
            publish_scalars=settings.publish_scalars,
            noise=noise,
            frame_prefix=settings.frame_prefix,
        )
        self._publishers = [
            # Without event handlers, each of which the executor puts into a wait set at every wake-up.
            node.create_publisher(kind, topic, QUEUE_DEPTH, event_callbacks=NO_EVENTS)
            for topic, kind in self.messages.types.items()
        ]
        self.topics = [publisher.topic_name for publisher in self._publishers]
        self._clock = node.create_publisher(Clock, "/clock", QUEUE_DEPTH) if settings.publish_clock else None
        self._markers = (
            node.create_publisher(MarkerArray, "markers", QUEUE_DEPTH) if settings.publish_markers else None
        )
        self._tf, self._tf_class, self.without_tf = None, None, "publish_tf is false"
        if settings.publish_tf:
            self._tf, self._tf_class, self.without_tf = _tf_publisher(node)

    def publish(self, sample: Sample, stamp: int) -> list[bytes]:
        """Publish a sample with a stamp in ns; return the messages that are recorded, serialised once."""
        if self._clock is not None:
            self._clock.publish(Clock(clock=Time(nanoseconds=stamp).to_msg()))
        [serialised] = self.messages.serialised(sample, [stamp])
        for publisher, data in zip(self._publishers, serialised, strict=True):
            publisher.publish(data)
        if self._tf is not None and self._tf_class is not None:
            self._tf.publish(
                self._tf_class(transforms=transforms(self._vehicle, sample, stamp, self._frame_prefix))
            )
        if self._markers is not None:
            self._markers.publish(markers(self._vehicle, sample, stamp, self._frame_prefix))
        return serialised

    def close(self) -> None:
        """Let subscribers have what was published."""
        wait_for_subscribers(self._publishers)


def _tf_publisher(node: Node) -> tuple[Any, Any, str]:
    try:
        from tf2_msgs.msg import TFMessage  # noqa: PLC0415 - not on PyPI, so it need not be there
    except ImportError:
        return None, None, "tf2_msgs is not installed"
    return node.create_publisher(TFMessage, "/tf", 100), TFMessage, ""
