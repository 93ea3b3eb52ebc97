from collections.abc import Iterator

import pytest
import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger

from yawdamp_ros.nodes.guard import Guard


@pytest.fixture
def node() -> Iterator[Node]:
    context = rclpy.Context()
    context.init()
    made = rclpy.create_node("guarded", context=context)
    yield made
    made.destroy_node()
    context.try_shutdown()


def failing(*_: object) -> None:
    message = "no\nway"
    raise OSError(message)


def test_a_callback_that_fails_is_counted_and_nothing_is_raised(node: Node) -> None:
    guard = Guard(node)
    assert guard(failing)() is None
    guard(failing)(1)
    assert guard.failures == 2


def test_a_callback_that_does_not_fail_gives_what_it_gave(node: Node) -> None:
    guard = Guard(node)
    assert guard(lambda value: value + 1)(1) == 2
    assert guard.failures == 0


def test_a_service_answers_that_it_failed_in_one_line(node: Node) -> None:
    response = Guard(node)(failing)(Trigger.Request(), Trigger.Response(success=True))
    assert (response.success, response.message) == (False, "failed: OSError: no\\nway")


def test_without_its_graph_a_node_goes(node: Node) -> None:
    guard = Guard(node)
    node.context.try_shutdown()
    with pytest.raises(OSError, match="no\nway"):
        guard(failing)()
