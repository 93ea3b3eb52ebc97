"""A lane-keeping prototype: it steers the simulated truck along a path, through topics alone.

    python -m yawdamp_ros sim &
    python examples/lane_keeping.py --output lane_keeping.png

The path changes lanes by 3.5 m, between 100 m and 200 m ahead. The prototype looks 1.5 s ahead, steers on
the circle that leads there, and allows for the truck's understeer. It knows nothing of the simulator but
``truck/odom`` and ``steering``.
"""

import argparse
import math
import sys

import rclpy
from nav_msgs.msg import Odometry
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Float64

LANE = 3.5
"""Width of the lane change in m."""
PREVIEW = 1.5
"""Time in s that the prototype looks ahead."""
WHEELBASE = 4.68
"""Wheelbase of a single-track vehicle that turns like the truck [m]."""
UNDERSTEER = 0.00475
"""Steer angle for lateral acceleration, beyond the wheelbase's share, rad/(m/s^2)."""


def path(x: float) -> float:
    """Lateral position in m of the path at a distance in m: a smooth change to the left lane."""
    share = min(max((x - 100.0) / 100.0, 0.0), 1.0)
    return LANE * (share - math.sin(math.tau * share) / math.tau)


class LaneKeeper(Node):
    """Steers on the circle through a point of the path ahead.

    Attributes
    ----------
    driven : list of (float, float)
        Positions of the truck so far, in m.
    """

    def __init__(self) -> None:
        super().__init__("lane_keeper")
        self.driven: list[tuple[float, float]] = []
        self._publisher = self.create_publisher(Float64, "steering", 10)
        self.create_subscription(Odometry, "truck/odom", self._steer, 10)

    def _steer(self, odometry: Odometry) -> None:
        position, orientation = odometry.pose.pose.position, odometry.pose.pose.orientation
        yaw = 2.0 * math.atan2(orientation.z, orientation.w)
        speed = odometry.twist.twist.linear.x
        self.driven.append((position.x, position.y))
        distance = PREVIEW * speed
        aim = position.x + distance
        ahead, aside = distance, path(aim) - position.y
        # The aim as the truck sees it: to the left of its own heading.
        left = aside * math.cos(yaw) - ahead * math.sin(yaw)
        curvature = 2.0 * left / (ahead**2 + aside**2)
        self._publisher.publish(Float64(data=curvature * (WHEELBASE + UNDERSTEER * speed**2)))


def main() -> int:
    """Steer for a distance, then draw what was driven."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--distance", type=float, default=350.0, metavar="M", help="default: 350")
    parser.add_argument("--output", metavar="FILE", help="picture of the path and what was driven")
    options = parser.parse_args()
    rclpy.init()
    node = LaneKeeper()
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    try:
        while not node.driven or node.driven[-1][0] < options.distance:
            executor.spin_once()
    except (KeyboardInterrupt, ExternalShutdownException):
        return 1
    finally:
        rclpy.try_shutdown()
    worst = max(abs(y - path(x)) for x, y in node.driven)
    last = node.driven[-1][1] - path(node.driven[-1][0])
    print(f"worst distance from the path {worst:.2f} m, at the end {last:+.2f} m")
    if options.output:
        draw(node.driven, options.output)
    return 0


def draw(driven: list[tuple[float, float]], output: str) -> None:
    """Draw the path and what was driven."""
    from matplotlib.figure import Figure  # noqa: PLC0415 - only where a picture is wanted

    figure = Figure(figsize=(9.0, 3.2), layout="constrained")
    axes = figure.add_subplot()
    x = [point[0] for point in driven]
    axes.plot(x, [path(value) for value in x], color="0.6", linewidth=4.0, label="path")
    axes.plot(x, [point[1] for point in driven], color="#0072b2", label="truck's centre of gravity")
    axes.set(xlabel="x, m", ylabel="y (left), m", title="Lane keeping through topics")
    axes.grid(visible=True, color="0.9")
    axes.legend(loc="upper left")
    figure.savefig(output)


if __name__ == "__main__":
    sys.exit(main())
