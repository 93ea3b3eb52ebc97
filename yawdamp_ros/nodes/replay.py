"""The replay node: a steering log on the topic, at its own pace."""

import threading
import time
from collections.abc import Callable

from rclpy.node import Node
from rclpy.time import Time
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Float64
from std_srvs.srv import SetBool

from yawdamp_ros.logs import SteeringLog
from yawdamp_ros.nodes.graph import wait_for_subscribers
from yawdamp_ros.nodes.stop_request import StopRequest
from yawdamp_ros.runs.run_writer import QUEUE_DEPTH
from yawdamp_ros.simulation.inputs import LONGITUDINAL
from yawdamp_ros.stepping.time_grid import nanoseconds

STEERING = "steering"
"""Topic of the steering."""
POLL = 0.02
"""Interval between checks for a subscriber, a pause or its end [s]."""
SETTLING = 0.3
"""Delay from the discovery of a subscriber to the first sample [s]."""


class ReplayNode(Node):
    """Publishes a steering log on ``steering``; ``~/pause`` halts and resumes it.

    The log's speed goes out on ``speed``, its acceleration on ``acceleration``.

    Parameters
    ----------
    log : SteeringLog
        Log with the angles to publish [rad].
    rate : float
        Speed of the replay: 2 is twice as fast as recorded.
    stop : StopRequest
    publish_clock : bool
        Whether the log's own time goes out on ``/clock``.

    Attributes
    ----------
    lateness, worst_lateness : float
        Delay after the deadline of the last sample, and the largest delay so far [s].
    """

    def __init__(self, log: SteeringLog, rate: float, stop: StopRequest, *, publish_clock: bool) -> None:
        super().__init__("yawdamp_replay")
        self._log = log
        self._rate = rate
        self._stop = stop
        names = [*(name for name in LONGITUDINAL if name in log.inputs), STEERING]
        self._topics = {name: self.create_publisher(Float64, name, QUEUE_DEPTH) for name in names}
        self._moments = _moments(log)
        self._clock_publisher = self.create_publisher(Clock, "/clock", QUEUE_DEPTH) if publish_clock else None
        self._paused = threading.Event()
        self.lateness = self.worst_lateness = 0.0
        self.create_service(SetBool, "~/pause", self._on_pause)

    @property
    def topic(self) -> str:
        """Fully qualified name of the topic."""
        return str(self._topics[STEERING].topic_name)

    def wait_for_subscriber(self) -> bool:
        """Wait until somebody listens; return False if the stop request came first."""
        while self._topics[STEERING].get_subscription_count() == 0:
            if self._stop.wait(POLL):
                return False
        # The subscriber may not have discovered this publisher yet.
        return not self._stop.wait(SETTLING)

    def play(self, progress: Callable[[float], None], *, loop: bool) -> None:
        """Publish the log, once or again and again, until it ends or the stop request comes.

        Each sample has its own deadline on the steady clock, counted from the start, so that lateness
        does not add up, over rounds neither. From the last sample of a round to the first of the next is the
        mean interval of the log.

        Parameters
        ----------
        progress : callable
            Function that receives the time of each sample [s].
        loop : bool
        """
        start = time.monotonic()
        length = self._log.duration * len(self._log.times) / max(len(self._log.times) - 1, 1)
        while self._play_round(start, progress) and loop:
            start = self._start_of_round + length / self._rate

    def _play_round(self, start: float, progress: Callable[[float], None]) -> bool:
        """Publish the log once; return False if the stop request came first."""
        message = Float64()
        for at, name, message.data in self._moments:
            while True:
                if self._paused.is_set():
                    start += self._wait_while_paused()
                delay = start + at / self._rate - time.monotonic()
                # A long wait is split, so that a pause during it acts.
                if delay <= 0.0 or self._stop.wait(min(delay, POLL)):
                    break
            if self._stop.requested:
                return False
            self._topics[name].publish(message)
            self.lateness = time.monotonic() - start - at / self._rate
            self.worst_lateness = max(self.worst_lateness, self.lateness)
            if self._clock_publisher is not None:
                now = self._log.start_time + nanoseconds(at)
                self._clock_publisher.publish(Clock(clock=Time(nanoseconds=now).to_msg()))
            progress(at)
        self._start_of_round = start
        return True

    def close(self) -> None:
        """Wait until subscribers have received all messages."""
        wait_for_subscribers([*self._topics.values()])

    def _wait_while_paused(self) -> float:
        """Wait for the pause to end; return its duration [s]."""
        since = time.monotonic()
        while self._paused.is_set() and not self._stop.wait(POLL):
            pass
        return time.monotonic() - since

    def _on_pause(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        if request.data:
            self._paused.set()
        else:
            self._paused.clear()
        response.success, response.message = True, "paused" if request.data else "playing"
        return response


def _moments(log: SteeringLog) -> list[tuple[float, str, float]]:
    """Time [s], topic and value of each message to publish, in order.

    Speed and acceleration go out before the steering of the same time, so that all act from one step on.
    """
    signals = {name: log.inputs[name] for name in LONGITUDINAL if name in log.inputs}
    signals[STEERING] = log.times, log.angles
    moments = [
        (at, name, value)
        for name, signal in signals.items()
        for at, value in zip(*signal, strict=True)
        if at <= log.duration
    ]
    # Sorting is stable: at one time the order is that of the signals.
    return sorted(moments, key=lambda moment: moment[0])
