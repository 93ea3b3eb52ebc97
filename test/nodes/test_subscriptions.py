import pytest
import rclpy
from std_msgs.msg import Float64

from graph import Graph, until
from yawdamp_ros.nodes.subscriptions import SteeringSubscription
from yawdamp_ros.stepping import SteeringInput, Verdict

pytestmark = pytest.mark.graph


def test_commands_that_have_arrived_act_before_the_executor_comes_to_them(graph: Graph) -> None:
    unspun = rclpy.create_node("unspun", context=graph.node.context)
    target = SteeringInput(ratio=1.0, limit=1.0, timeout_steps=10, zero_on_timeout=False, max_age=0.0)
    subscription = SteeringSubscription(
        unspun, "std_msgs/msg/Float64", "", target, step=lambda: 7, now=lambda: 0
    )
    publisher = graph.steering_publisher()
    for angle in (0.1, 0.2):
        publisher.publish(Float64(data=angle))

    def newest_acts() -> bool:
        subscription.take()
        return target.at(7) == 0.2

    until(newest_acts, "the commands")
    assert target.counts[Verdict.ACCEPTED] == 2
    unspun.destroy_node()
