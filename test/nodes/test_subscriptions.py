import pytest
import rclpy
from std_msgs.msg import Float64

from graph import Graph, until
from yawdamp_ros.nodes.guard import Guard
from yawdamp_ros.nodes.subscriptions import SteeringSubscription
from yawdamp_ros.simulation import Commands, SimParameters, make_motion
from yawdamp_ros.stepping import TimeGrid, Verdict
from yawdamp_ros.vehicle import load_vehicle

pytestmark = pytest.mark.graph


def test_commands_that_have_arrived_act_before_the_executor_comes_to_them(graph: Graph) -> None:
    unspun = rclpy.create_node("unspun", context=graph.node.context)
    motion = make_motion(load_vehicle("interlink"), "consistent", None, 0.001)
    target = Commands(SimParameters(), TimeGrid.of(0.001, 0.01), motion)
    subscription = SteeringSubscription(
        unspun, "std_msgs/msg/Float64", "", target, now=lambda: 0, guard=Guard(unspun)
    )
    publisher = graph.steering_publisher()
    for angle in (0.1, 0.2):
        publisher.publish(Float64(data=angle))

    def newest_acts() -> bool:
        subscription.take()
        return target.steering_input.at(1) == 0.2

    until(newest_acts, "the commands")
    assert target.steering_input.counts[Verdict.ACCEPTED] == 2
    received = [(command.step, command.angle, command.message.data) for command in target.received()]
    assert received == [(1, 0.1, 0.1), (1, 0.2, 0.2)]
    unspun.destroy_node()
