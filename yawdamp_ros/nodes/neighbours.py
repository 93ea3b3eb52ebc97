"""Checks of the publishers and subscribers at the other ends of the simulator's topics."""

from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

from rclpy.node import Node
from rclpy.qos import QoSCompatibility, QoSProfile, qos_check_compatible
from rclpy.topic_endpoint_info import TopicEndpointInfo

from yawdamp_ros.nodes.states import Problem
from yawdamp_ros.runs.encoder import type_name

DESCRIPTORS = Path("/proc/self/fd")
"""Open files of this process."""
CUT_OFF = (
    "the shared memory of Fast DDS was removed: who comes from now on can neither steer nor hear this node; "
    "start it again"
)


class Finding(NamedTuple):
    """Mismatch between the node and its neighbours.

    Attributes
    ----------
    problem : Problem
    sentence : str
        Sentence with the topic and its publishers.
    topic : str
        Input concerned; empty if the node is concerned.
    """

    problem: Problem
    sentence: str
    topic: str = ""


class Neighbourhood(NamedTuple):
    """Findings of one inspection of the graph.

    Attributes
    ----------
    publishers : int
        Number of publishers on the inputs, matched or not.
    findings : tuple of Finding
        Findings on the inputs.
    """

    publishers: int
    findings: tuple[Finding, ...]


class Neighbours:
    """Watches the other ends of a node's topics and warns once of each new mismatch.

    DDS drops mismatched messages without a report to either user. If two nodes steer at once, the
    newest command wins, whatever its source.

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
        self._known: tuple[Finding, ...] = ()

    def look(self) -> Neighbourhood:
        """Inspect the graph and warn of new findings."""
        publishers = 0
        findings = [Finding(Problem.SHARED_MEMORY_REMOVED, CUT_OFF)] if is_cut_off() else []
        name = self._node.get_fully_qualified_name()
        findings += namesakes(name, self._node.get_node_names_and_namespaces())
        for subscription in self._node.subscriptions:
            if subscription.topic_name in self._inputs:
                found = self._node.get_publishers_info_by_topic(subscription.topic_name)
                publishers += len(found)
                findings += heard(
                    subscription.topic_name, type_name(subscription.msg_type), subscription.qos_profile, found
                )
        unheard = [
            finding
            for topic in self._outputs
            for publisher in self._node.get_publishers_info_by_topic(topic)
            if endpoint_name(publisher) == name
            for finding in listening(topic, publisher, self._node.get_subscriptions_info_by_topic(topic))
        ]
        for finding in (*findings, *unheard):
            if finding not in self._known:
                self._node.get_logger().warning(finding.sentence)
        self._known = (*findings, *unheard)
        return Neighbourhood(publishers, tuple(findings))


def heard(
    topic: str, expected: str, qos: QoSProfile, publishers: Sequence[TopicEndpointInfo]
) -> list[Finding]:
    """Findings on the publishers of an input.

    Parameters
    ----------
    topic : str
    expected : str
        Message type of the node's subscription.
    qos : QoSProfile
        Quality of service of the node's subscription.
    publishers : sequence of TopicEndpointInfo

    Returns
    -------
    list of Finding
    """
    findings, names = [], []
    for publisher in publishers:
        if mismatch := _mismatch(expected, publisher.topic_type, publisher.qos_profile, qos):
            problem, reason = mismatch
            sentence = f"{topic}: {endpoint_name(publisher)} is not heard: {reason}"
            findings.append(Finding(problem, sentence, topic))
        else:
            names.append(endpoint_name(publisher))
    if len(names) > 1:
        listed = ", ".join(sorted(names))
        sentence = f"{topic}: {len(names)} publish at once: {listed}; the newest wins"
        findings.append(Finding(Problem.SEVERAL_PUBLISHERS, sentence, topic))
    return findings


def namesakes(name: str, nodes: Sequence[tuple[str, str]]) -> list[Finding]:
    """Findings on nodes with the same name as this one.

    Parameters
    ----------
    name : str
        Fully qualified.
    nodes : sequence of (str, str)
        Name and namespace of every node on the graph, this one among them.

    Returns
    -------
    list of Finding
    """
    count = sum(f"{namespace.rstrip('/')}/{node}" == name for node, namespace in nodes)
    if count < 2:  # noqa: PLR2004 - another than this one
        return []
    sentence = f"{count} nodes are called {name}: services and parameters reach either of them"
    return [Finding(Problem.SAME_NAME, sentence)]


def listening(
    topic: str, publisher: TopicEndpointInfo, listeners: Sequence[TopicEndpointInfo]
) -> list[Finding]:
    """Findings on the subscribers of an output.

    Parameters
    ----------
    topic : str
    publisher : TopicEndpointInfo
        Publisher of the node.
    listeners : sequence of TopicEndpointInfo

    Returns
    -------
    list of Finding
    """
    findings = []
    for listener in listeners:
        mismatch = _mismatch(
            publisher.topic_type, listener.topic_type, publisher.qos_profile, listener.qos_profile
        )
        if mismatch:
            problem, reason = mismatch
            findings.append(Finding(problem, f"{topic}: {endpoint_name(listener)} hears nothing: {reason}"))
    return findings


def endpoint_name(endpoint: TopicEndpointInfo) -> str:
    """Fully qualified name of the node that an endpoint belongs to."""
    return f"{endpoint.node_namespace.rstrip('/')}/{endpoint.node_name}"


def is_cut_off(descriptors: Path = DESCRIPTORS) -> bool:
    """True if files that this process holds for Fast DDS are gone, as when /dev/shm is cleaned.

    Without /proc or a free descriptor the files cannot be checked and count as present.
    """
    with suppress(OSError):
        for descriptor in descriptors.iterdir():
            with suppress(OSError):  # closed by now
                name = descriptor.readlink().name
                if name.startswith("fastrtps_") and name.endswith(" (deleted)"):
                    return True
    return False


def _mismatch(
    expected: str, found: str, publisher: QoSProfile, subscription: QoSProfile
) -> tuple[Problem, str] | None:
    """Reason that two ends of a topic do not match; None if they match."""
    if found != expected:
        return Problem.TYPE_MISMATCH, f"its type is {found}, expected {expected}"
    compatibility, reason = qos_check_compatible(publisher, subscription)
    if compatibility == QoSCompatibility.ERROR:
        reason = reason.removeprefix("ERROR: ").rstrip(";")
        return Problem.QOS_MISMATCH, f"its QoS does not fit: {reason}"
    return None
