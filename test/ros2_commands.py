"""The few commands of ros2cli that the manual uses, for an installation of ROS without it: PyPI has none.

``run``, ``service call``, ``topic pub --once`` and ``param set``, by the same rclpy calls.
"""

import os
import sys
from importlib import import_module
from typing import Any

import rclpy
from rcl_interfaces.srv import SetParameters
from rclpy.node import Node
from rclpy.parameter import Parameter
from ruamel.yaml import YAML


def main() -> int:
    """Do what the arguments say."""
    match sys.argv[1:]:
        case ["run", package, command, *arguments]:
            os.execv(sys.executable, [sys.executable, "-m", package, command, *arguments])  # noqa: S606
        case ["service", "call", service, kind, *fields]:
            return _with_node(lambda node: _call(node, service, kind, _yaml(*fields)))
        case ["param", "set", target, name, value]:
            return _with_node(lambda node: _set(node, target, name, _yaml(value)))
        case ["topic", "pub", "--once", topic, kind, fields]:
            return _with_node(lambda node: _publish(node, topic, kind, _yaml(fields)))
    sys.stderr.write(f"no such command here: {sys.argv[1:]}\n")
    return 2


def _with_node(act: Any) -> int:  # noqa: ANN401
    rclpy.init()
    node = rclpy.create_node("ros2_commands")
    try:
        act(node)
    finally:
        rclpy.shutdown()
    return 0


def _call(node: Node, service: str, kind: str, fields: dict[str, Any]) -> None:
    request_type = _type(kind)
    request = _filled(request_type.Request(), fields)
    answer = _answer(node, request_type, service, request)
    sys.stdout.write(f"response:\n{answer}\n")


def _set(node: Node, target: str, name: str, value: Any) -> None:  # noqa: ANN401
    request = SetParameters.Request(parameters=[Parameter(name, value=value).to_parameter_msg()])
    (result,) = _answer(node, SetParameters, f"{target}/set_parameters", request).results
    sys.stdout.write("Set parameter successful\n" if result.successful else f"Failed: {result.reason}\n")


def _publish(node: Node, topic: str, kind: str, fields: dict[str, Any]) -> None:
    publisher = node.create_publisher(_type(kind), topic, 10)
    while not publisher.get_subscription_count():
        rclpy.spin_once(node, timeout_sec=0.05)
    publisher.publish(_filled(_type(kind)(), fields))
    publisher.wait_for_all_acked()


def _answer(node: Node, kind: Any, service: str, request: Any) -> Any:  # noqa: ANN401
    client = node.create_client(kind, service)
    client.wait_for_service()
    future = client.call_async(request)
    rclpy.spin_until_future_complete(node, future)
    return future.result()


def _type(name: str) -> Any:  # noqa: ANN401
    package, folder, kind = name.split("/")
    return getattr(import_module(f"{package}.{folder}"), kind)


def _filled(message: Any, fields: dict[str, Any]) -> Any:  # noqa: ANN401
    for name, value in fields.items():
        setattr(message, name, value)
    return message


def _yaml(text: str = "{}") -> Any:  # noqa: ANN401
    return YAML(typ="safe", pure=True).load(text)


if __name__ == "__main__":
    sys.exit(main())
