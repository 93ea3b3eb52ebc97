"""The replay node: a steering log on the topic, at its own pace."""

import time
from collections.abc import Callable

from rclpy.duration import Duration
from rclpy.node import Node
from std_msgs.msg import Float64

from yawdamp_ros.logs import SteeringLog
from yawdamp_ros.nodes.stop_request import StopRequest

QUEUE_DEPTH = 10
SUBSCRIBER_POLL = 0.02
"""Seconds between looks for a subscriber."""


class ReplayNode(Node):
    """Publishes a steering log on ``steering``.

    Parameters
    ----------
    log : SteeringLog
        In the angles to publish, rad.
    rate : float
        Speed of the replay: 2 is twice as fast as recorded.
    stop : StopRequest
    """

    def __init__(self, log: SteeringLog, rate: float, stop: StopRequest) -> None:
        super().__init__("yawdamp_replay")
        self._log = log
        self._rate = rate
        self._stop = stop
        self._publisher = self.create_publisher(Float64, "steering", QUEUE_DEPTH)

    @property
    def topic(self) -> str:
        """Fully qualified name of the topic."""
        return str(self._publisher.topic_name)

    def wait_for_subscriber(self) -> bool:
        """Wait until somebody listens; return False if the stop request came first."""
        while self._publisher.get_subscription_count() == 0:
            if self._stop.wait(SUBSCRIBER_POLL):
                return False
        return True

    def play(self, progress: Callable[[float], None]) -> bool:
        """Publish the log once; return False if the stop request came first.

        Each sample has its own deadline on the steady clock, counted from the start, so that lateness
        does not add up.

        Parameters
        ----------
        progress : callable
            Told the time of each sample in s.
        """
        start = time.monotonic()
        message = Float64()
        for at, angle in zip(self._log.times, self._log.angles, strict=True):
            delay = start + at / self._rate - time.monotonic()
            if delay > 0.0 and self._stop.wait(delay):
                return False
            message.data = angle
            self._publisher.publish(message)
            progress(at)
        return not self._stop.requested

    def close(self) -> None:
        """Let subscribers have what was published."""
        self._publisher.wait_for_all_acked(Duration(seconds=1))
