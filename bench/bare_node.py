"""The least that a node of rclpy can be: a timer, a subscription, the simulator's messages, all constant."""

import signal
import sys
import time

import rclpy
from nav_msgs.msg import Odometry
from rclpy.node import Node
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import Float64

UNITS = ("truck", "trailer_1", "trailer_2")


class BareNode(Node):
    """Publishes the messages of the interlink at a rate in Hz, and counts those it misses."""

    def __init__(self, rate: float) -> None:
        super().__init__("bare")
        self._ticks, self._rate = 0, rate
        self._first = self._last = 0.0
        names = ["steering", "articulation_1", "articulation_2"]
        zeros = [0.0, 0.0, 0.0]
        messages = {f"{unit}/imu": Imu() for unit in UNITS}
        messages |= {f"{unit}/odom": Odometry(child_frame_id=unit) for unit in UNITS}
        messages["joint_states"] = JointState(name=names, position=zeros, velocity=zeros, effort=zeros)
        scalars = ("yaw", "yaw_rate", "lateral_acceleration")
        messages |= {f"{unit}/{scalar}": Float64() for unit in UNITS for scalar in scalars}
        self._outputs = [
            (self.create_publisher(type(message), topic, 10), message) for topic, message in messages.items()
        ]
        self.create_subscription(Float64, "steering", lambda _: None, 10)
        self.create_timer(1.0 / rate, self._publish)

    def _publish(self) -> None:
        for publisher, message in self._outputs:
            publisher.publish(message)
        self._last = time.monotonic()
        self._first = self._first or self._last
        self._ticks += 1

    @property
    def missed(self) -> int:
        """Periods between the first time that the timer fired and the last at which it did not."""
        return round((self._last - self._first) * self._rate) + 1 - self._ticks


def main() -> None:
    """Run at the rate of the command line until SIGINT; then say how many periods were missed."""
    rclpy.init()
    node = BareNode(float(sys.argv[1]))

    def end(*_: object) -> None:
        # Said at once: the middleware of a fast node may hang where it ends.
        print(node.missed, flush=True)
        rclpy.try_shutdown()

    signal.signal(signal.SIGINT, end)
    try:
        rclpy.spin(node)
    except Exception:  # of several types, by where the signal came
        if rclpy.ok():
            raise


if __name__ == "__main__":
    main()
