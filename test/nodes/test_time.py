"""Time: stamps follow the clock that a controller can see, and commands are judged on that clock."""

import signal
import time
from typing import Any

import numpy as np
import pytest
from builtin_interfaces.msg import Time
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, Header
from std_srvs.srv import SetBool, Trigger

from graph import Graph, stamps, state, stop, until, values
from runs import PERIOD, recorded, run_directory
from yawdamp_ros.cli import run

pytestmark = pytest.mark.graph

JOINT = ("-p", "steering_type:=sensor_msgs/msg/JointState")
CONTROLLER = """
import rclpy
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState
from std_msgs.msg import Header
rclpy.init()
node = rclpy.create_node("controller")
publisher = node.create_publisher(JointState, "steering", 10)
count = 0
def steer(odometry):
    global count
    count += 1
    header = Header(stamp=odometry.header.stamp)
    publisher.publish(JointState(header=header, name=["steering"], position=[0.001 * (count % 20)]))
node.create_subscription(Odometry, "truck/odom", steer, 10)
rclpy.spin(node)
"""
"""A controller that copies the stamp of what it hears into its command."""


class Driven:
    """A node that such a controller steers."""

    def __init__(self, graph: Graph, *parameters: str) -> None:
        self.graph = graph
        graph.listen({"/truck/odom": Odometry})
        self.process = graph.command("sim", "--ros-args", *JOINT, *parameters)
        self.more(5)
        self.statuses = graph.statuses()
        self._controller = graph.script(CONTROLLER)
        until(lambda: self.counted("accepted") > 0, "a command that is accepted")

    def counted(self, key: str) -> int:
        return int(values(self.statuses("steering")).get(key, "0"))

    def more(self, count: int) -> None:
        before = len(self.graph.received["/truck/odom"])
        until(lambda: len(self.graph.received["/truck/odom"]) >= before + count, f"{count} samples more")

    def still_steered(self) -> None:
        """Commands are accepted again, and the newest are not stale."""
        before = self.counted("accepted")
        until(lambda: self.counted("accepted") > before, "commands that are accepted again")
        until(lambda: state(self.statuses("steering")) == "commanded", "a node that is steered")
        until(lambda: state(self.statuses("steering"), "problems") == "", "no stale command")

    def end(self) -> Any:  # noqa: ANN401 - messages of the recording
        self._controller.terminate()  # killed, it might take the node along: they share memory
        self._controller.communicate()
        status, _, errors = stop(self.process)
        assert status == 0, errors
        path = run_directory(self.graph.directory)
        assert run(["resimulate", str(path)]) == 0
        return recorded(path)


def jumps(messages: Any) -> list[int]:  # noqa: ANN401
    return [message.data for _, message in messages.get("/time_jump", [])]


def test_stamps_follow_ros_time_through_a_pause_and_a_standstill(graph: Graph) -> None:
    driven = Driven(graph)
    assert graph.call("/yawdamp_sim/pause", SetBool, SetBool.Request(data=True)).success
    time.sleep(1.5)
    assert graph.call("/yawdamp_sim/pause", SetBool, SetBool.Request(data=False)).success
    driven.more(20)
    driven.still_steered()
    driven.process.send_signal(signal.SIGSTOP)
    time.sleep(1.5)
    driven.process.send_signal(signal.SIGCONT)
    driven.more(20)
    driven.still_steered()
    messages = driven.end()
    # The pause and what was dropped of the standstill are jumps, and nothing else moves a stamp off the grid.
    # A machine that is busy with other things may add some.
    assert sum(jump > 10**9 for jump in jumps(messages)) >= 2
    gaps = np.diff(stamps([message for _, message in messages["/truck/odom"]]))
    assert sorted(gaps[gaps != PERIOD] - PERIOD) == sorted(jumps(messages))
    assert "/clock" not in dict(graph.node.get_topic_names_and_types())


def test_each_step_of_a_lockstep_bears_the_time_of_its_step(graph: Graph) -> None:
    driven = Driven(graph)
    assert graph.call("/yawdamp_sim/pause", SetBool, SetBool.Request(data=True)).success
    for _ in range(3):
        time.sleep(0.6)
        before = time.time_ns()
        assert graph.call("/yawdamp_sim/step", Trigger, Trigger.Request()).success
        after = time.time_ns()
        until(
            lambda before=before: stamps(graph.messages("/truck/odom"))[-1] >= before - PERIOD, "the sample"
        )
        assert stamps(graph.messages("/truck/odom"))[-1] <= after + PERIOD
    driven.end()


@pytest.mark.parametrize("factor", ["0.5", "4.0"])
def test_with_another_factor_the_clock_goes_out_and_commands_are_judged_on_it(
    graph: Graph, factor: str
) -> None:
    graph.listen({"/clock": Clock})
    driven = Driven(graph, "-p", f"real_time_factor:={factor}", "-p", "max_steering_age:=2.0")
    driven.more(50)
    driven.still_steered()
    messages = driven.end()
    assert jumps(messages) == []
    clock = [message.clock.sec * 10**9 + message.clock.nanosec for message in graph.messages("/clock")]
    assert set(clock) <= set(stamps([message for _, message in messages["/truck/odom"]]))
    assert len(clock) > 50


def test_a_factor_that_changes_while_running_lets_the_clock_out(graph: Graph) -> None:
    driven = Driven(graph, "-p", "max_steering_age:=2.0")
    assert graph.publishers("/clock") == 0
    assert graph.set_parameter("/yawdamp_sim", "real_time_factor", 2.0).successful
    until(lambda: graph.publishers("/clock") == 1, "/clock")
    driven.still_steered()
    driven.end()


def test_a_clock_that_is_refused_stays_in(graph: Graph) -> None:
    process = graph.command("sim", "--ros-args", "-p", "real_time_factor:=2.0", "-p", "publish_clock:=false")
    until(lambda: graph.publishers("/truck/odom") == 1, "the node")
    assert graph.publishers("/clock") == 0
    assert graph.parameter("/yawdamp_sim", "publish_clock") is False
    assert stop(process)[0] == 0


def test_the_speed_in_force_is_told_and_shows_in_the_imu_while_it_changes(graph: Graph) -> None:
    process = graph.command("sim", "--speed", "18", "--ros-args", "-p", "longitudinal_source:=speed")
    until(lambda: graph.publishers("/truck/odom") == 1, "the node")
    assert graph.parameter("/yawdamp_sim", "speed") == 18.0
    publisher = graph.publisher(Float64, "/speed")
    publisher.publish(Float64(data=18.5))
    until(lambda: graph.parameter("/yawdamp_sim", "speed") == 18.5, "the speed in force")
    refused = graph.set_parameter("/yawdamp_sim", "speed", 20.0)
    assert not refused.successful
    assert "publish there" in refused.reason
    assert stop(process)[0] == 0
    messages = recorded(run_directory(graph.directory))
    shown = [message.linear_acceleration.x for _, message in messages["/truck/imu"]]
    # 0.5 m/s in one sample period of 10 ms.
    assert [value for value in shown if value] == [pytest.approx(50.0)]
    assert run(["resimulate", str(run_directory(graph.directory))]) == 0


def test_a_controller_that_went_silent_is_told_of_once_whenever_it_does(graph: Graph) -> None:
    process = graph.command("sim", "--ros-args", *JOINT, "-p", "steering_timeout:=0.3")
    statuses = graph.statuses()
    publisher = graph.publisher(JointState, "/steering")
    for _ in range(2):
        now = time.time_ns()
        header = Header(stamp=Time(sec=now // 10**9, nanosec=now % 10**9))
        publisher.publish(JointState(header=header, name=["steering"], position=[0.01]))
        time.sleep(1.2)
        until(lambda: state(statuses("steering")) == "timed_out", "the silence")
        time.sleep(2.2)
    errors = stop(process)[2]
    assert errors.count("steering: no command for 0.3 s; the last one is held") == 2
