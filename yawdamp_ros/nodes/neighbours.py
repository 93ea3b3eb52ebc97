"""Who publishes what the simulator listens to, who listens to what it publishes, and whether that fits."""

from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, NamedTuple

from rclpy.node import Node
from rclpy.qos import QoSCompatibility, qos_check_compatible

from yawdamp_ros.nodes.messages import type_name

CUT_OFF = (
    "the shared memory of Fast DDS was removed: who comes from now on can neither steer nor hear this node; "
    "start it again"
)


class Neighbourhood(NamedTuple):
    """What was found at one look.

    Attributes
    ----------
    publishers : int
        On the inputs, heard or not.
    problems : tuple of str
        With the inputs.
    """

    publishers: int
    problems: tuple[str, ...]


class Neighbours:
    """Watches the other ends of a node's topics; what does not fit is warned of once, when it comes.

    DDS drops what does not fit without a word to either side's user, and of two that steer at once the
    newest command wins, whose ever it is.

    Parameters
    ----------
    node : Node
    inputs : sequence of str
        Topics as the node subscribes to them.
    outputs : sequence of str
        Topics that it publishes, fully qualified.
    """

    def __init__(self, node: Node, inputs: Sequence[str], outputs: Sequence[str]) -> None:
        self._node = node
        self._outputs = tuple(outputs)
        self._inputs = {node.resolve_topic_name(name) for name in inputs}
        self._known: tuple[str, ...] = ()

    def look(self) -> Neighbourhood:
        """Look around, and warn of what is new."""
        publishers = 0
        problems = [CUT_OFF] if _is_cut_off() else []
        for subscription in self._node.subscriptions:
            if subscription.topic_name in self._inputs:
                found = self._node.get_publishers_info_by_topic(subscription.topic_name)
                publishers += len(found)
                problems += _problems(subscription, found)
        unheard = [
            f"{topic}: {_name(listener)} hears nothing: {mismatch}"
            for topic in self._outputs
            for publisher in self._node.get_publishers_info_by_topic(topic)
            if _name(publisher) == self._node.get_fully_qualified_name()
            for listener in self._node.get_subscriptions_info_by_topic(topic)
            if (mismatch := _mismatch(publisher.topic_type, listener, publisher, listener))
        ]
        for problem in (*problems, *unheard):
            if problem not in self._known:
                self._node.get_logger().warning(problem)
        self._known = (*problems, *unheard)
        return Neighbourhood(publishers, tuple(problems))


def _is_cut_off() -> bool:
    """Whether files that this process holds for Fast DDS have gone, as when /dev/shm is tidied up."""
    for descriptor in Path("/proc/self/fd").iterdir():
        with suppress(OSError):  # closed by now
            name = descriptor.readlink().name
            if name.startswith("fastrtps_") and name.endswith(" (deleted)"):
                return True
    return False


def _problems(subscription: Any, publishers: list[Any]) -> list[str]:  # noqa: ANN401 - rclpy's are untyped
    problems = []
    heard = []
    for publisher in publishers:
        if mismatch := _mismatch(type_name(subscription.msg_type), publisher, publisher, subscription):
            problems.append(f"{subscription.topic_name}: {_name(publisher)} is not heard: {mismatch}")
        else:
            heard.append(_name(publisher))
    if len(heard) > 1:
        names = ", ".join(sorted(heard))
        problems.append(f"{subscription.topic_name}: {len(heard)} publish at once: {names}; the newest wins")
    return problems


def _mismatch(expected: str, other: Any, publisher: Any, subscription: Any) -> str:  # noqa: ANN401
    """Why one's own end of a topic of a type does not meet another; empty if it does."""
    if other.topic_type != expected:
        return f"its type is {other.topic_type}, expected {expected}"
    compatibility, reason = qos_check_compatible(publisher.qos_profile, subscription.qos_profile)
    if compatibility == QoSCompatibility.ERROR:
        return f"its QoS does not fit: {reason.removeprefix('ERROR: ').rstrip(';')}"
    return ""


def _name(publisher: Any) -> str:  # noqa: ANN401
    return f"{publisher.node_namespace.rstrip('/')}/{publisher.node_name}"
