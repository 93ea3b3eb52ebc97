"""Neither a peer nor the state of the system ends the node."""

import resource
from pathlib import Path

import pytest
from sensor_msgs.msg import Imu
from std_srvs.srv import SetBool

from graph import Graph, outcome, stop, until

pytestmark = pytest.mark.graph


def more_samples(graph: Graph, count: int) -> None:
    before = len(graph.received["/truck/imu"])
    until(lambda: len(graph.received["/truck/imu"]) >= before + count, f"{count} samples more")


def test_a_directory_that_is_none_is_refused_and_the_node_goes_on(graph: Graph) -> None:
    node = graph.command("sim", "--no-record")
    graph.listen({"/truck/imu": Imu})
    more_samples(graph, 1)
    for place in (".", "./.", "a/" * 2000):
        assert not graph.set_parameter("/yawdamp_sim", "record_directory", place).successful
        more_samples(graph, 5)
    assert graph.call("/yawdamp_sim/record", SetBool, SetBool.Request(data=True)).success
    more_samples(graph, 5)
    assert stop(node)[0] == 0


def test_without_free_descriptors_the_simulation_goes_on(graph: Graph) -> None:
    node = graph.command("sim", "--no-record")
    graph.listen({"/truck/imu": Imu})
    more_samples(graph, 20)
    used = max(int(entry.name) for entry in Path(f"/proc/{node.pid}/fd").iterdir()) + 1
    hard = resource.prlimit(node.pid, resource.RLIMIT_NOFILE)[1]
    resource.prlimit(node.pid, resource.RLIMIT_NOFILE, (used, hard))
    answer = graph.call("/yawdamp_sim/record", SetBool, SetBool.Request(data=True))
    assert not answer.success
    assert answer.message.startswith("failed: ")
    more_samples(graph, 150)  # past a second of diagnostics
    resource.prlimit(node.pid, resource.RLIMIT_NOFILE, (hard, hard))
    assert graph.call("/yawdamp_sim/record", SetBool, SetBool.Request(data=True)).success
    more_samples(graph, 5)
    stop(node)


def test_outputs_that_are_remapped_to_one_topic_are_refused(graph: Graph) -> None:
    command = ("sim", "--ros-args", "-r", "truck/yaw:=a", "-r", "truck/yaw_rate:=a")
    status, _, errors = outcome(graph.command(*command))
    assert status == 2
    assert errors.endswith("topic /a: 2 outputs are remapped to it; expected one each\n")


def test_a_domain_that_cannot_be_is_wrong_use(graph: Graph) -> None:
    graph.environment["ROS_DOMAIN_ID"] = "999"
    status, _, errors = outcome(graph.command("sim", "--duration", "1"))
    assert status == 2
    assert errors.endswith("ROS_DOMAIN_ID: '999': expected a number from 0 to 232\n")
    assert len(errors.splitlines()) == 1
