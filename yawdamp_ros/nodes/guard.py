"""One guard for every callback: errors are logged and counted, and the node goes on."""

import time
from collections.abc import Callable
from functools import wraps
from typing import Any

from rclpy.node import Node

from yawdamp_ros.errors import one_line
from yawdamp_ros.nodes.states import Reply, answer

WARNING_PERIOD = 5.0
"""Seconds between errors of one callback in the log."""


class Guard:
    """Wraps callbacks, so that no error in one ends the node.

    Parameters
    ----------
    node : Node
        Node that logs the errors.

    Attributes
    ----------
    failures : int
        Errors that were caught.
    """

    def __init__(self, node: Node) -> None:
        self.failures = 0
        self._node = node
        self._told_at: dict[str, float] = {}

    def __call__(self, callback: Callable[..., Any]) -> Callable[..., Any]:
        """Guard a callback of a timer, a subscription or a service; a service answers that it failed."""

        @wraps(callback)
        def guarded(*arguments: Any) -> Any:  # noqa: ANN401 - of any callback
            try:
                return callback(*arguments)
            except Exception as error:
                if not self._node.context.ok():
                    raise  # the graph is gone, and the node has no purpose without it
                sentence = one_line(f"{type(error).__name__}: {error}")
                self._note(callback.__name__.strip("_"), sentence)
                response: Any = arguments[-1] if arguments else None
                if hasattr(response, "success"):
                    response.success, response.message = False, answer(Reply.FAILED, sentence)
                return response

        return guarded

    def _note(self, name: str, sentence: str) -> None:
        self.failures += 1
        now = time.monotonic()
        if now - self._told_at.get(name, -WARNING_PERIOD) >= WARNING_PERIOD:
            self._told_at[name] = now
            self._node.get_logger().error(
                f"{name} failed: {sentence}; {self.failures} failures so far, the simulation goes on"
            )
