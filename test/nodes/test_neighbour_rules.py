from pathlib import Path
from typing import Any

from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.topic_endpoint_info import TopicEndpointInfo, TopicEndpointTypeEnum

from yawdamp_ros.nodes.neighbours import endpoint_name, heard, is_cut_off, listening, namesakes
from yawdamp_ros.nodes.states import Problem

FLOAT64 = "std_msgs/msg/Float64"
RELIABLE = QoSProfile(depth=10)


def end(name: str, type_name: str = FLOAT64, *, publishes: bool = True, **policies: Any) -> TopicEndpointInfo:  # noqa: ANN401 - of any policy
    """One end of a topic, as the graph describes it."""
    kind = TopicEndpointTypeEnum.PUBLISHER if publishes else TopicEndpointTypeEnum.SUBSCRIPTION
    return TopicEndpointInfo(
        node_name=name,
        node_namespace="/",
        topic_type=type_name,
        endpoint_type=kind,
        qos_profile=QoSProfile(depth=10, **policies),
    )


def test_one_publisher_that_fits_is_no_finding() -> None:
    assert heard("/steering", FLOAT64, RELIABLE, [end("driver")]) == []
    assert heard("/steering", FLOAT64, RELIABLE, []) == []


def test_two_publishers_that_fit_are_one_finding_that_names_both() -> None:
    (finding,) = heard("/steering", FLOAT64, RELIABLE, [end("second"), end("first")])
    assert finding.problem is Problem.SEVERAL_PUBLISHERS
    assert finding.sentence == "/steering: 2 publish at once: /first, /second; the newest wins"


def test_a_publisher_of_another_type_is_not_heard_and_does_not_count_as_a_second() -> None:
    (finding,) = heard(
        "/steering", FLOAT64, RELIABLE, [end("driver"), end("stranger", "sensor_msgs/msg/Imu")]
    )
    assert finding.problem is Problem.TYPE_MISMATCH
    assert (
        "/stranger is not heard: its type is sensor_msgs/msg/Imu, expected std_msgs/msg/Float64" in finding[1]
    )


def test_a_best_effort_publisher_is_not_heard_by_a_reliable_subscription() -> None:
    (finding,) = heard(
        "/steering", FLOAT64, RELIABLE, [end("driver", reliability=ReliabilityPolicy.BEST_EFFORT)]
    )
    assert finding.problem is Problem.QOS_MISMATCH
    assert "/driver is not heard: its QoS does not fit: Best effort publisher" in finding.sentence


def test_a_subscriber_of_an_output_that_wants_more_than_is_offered_hears_nothing() -> None:
    late = end("late", publishes=False, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    fitting = end("plot", publishes=False)
    (finding,) = listening("/truck/yaw", end("yawdamp_sim"), [fitting, late])
    assert finding.problem is Problem.QOS_MISMATCH
    assert finding.sentence.startswith("/truck/yaw: /late hears nothing: its QoS does not fit: ")


def test_an_endpoint_is_named_with_its_namespace() -> None:
    endpoint = end("driver")
    assert endpoint_name(endpoint) == "/driver"
    endpoint.node_namespace = "/left"
    assert endpoint_name(endpoint) == "/left/driver"


def test_a_node_of_the_same_name_is_a_finding() -> None:
    graph = [("yawdamp_sim", "/"), ("driver", "/"), ("yawdamp_sim", "/left")]
    assert namesakes("/yawdamp_sim", graph) == []
    (finding,) = namesakes("/yawdamp_sim", [*graph, ("yawdamp_sim", "/")])
    assert finding.problem is Problem.SAME_NAME
    assert finding.sentence.startswith("2 nodes are called /yawdamp_sim")


def test_shared_memory_counts_as_there_where_it_cannot_be_told(tmp_path: Path) -> None:
    assert not is_cut_off(tmp_path / "no_proc")
    (tmp_path / "3").symlink_to("fastrtps_0123 (deleted)")
    assert is_cut_off(tmp_path)
