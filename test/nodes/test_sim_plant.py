"""The plant through topics: it waits, brakes, stands and reverses, and what it did repeats."""

import numpy as np
import pytest
from nav_msgs.msg import Odometry
from rcl_interfaces.srv import GetParameters
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64
from std_srvs.srv import SetBool, Trigger

from graph import Graph, outcome, state, stop, until
from runs import recorded, run_directory
from yawdamp_ros.runs.resimulation import Resimulation

pytestmark = pytest.mark.graph


def seconds(odometry: Odometry) -> float:
    return float(odometry.header.stamp.sec + 1e-9 * odometry.header.stamp.nanosec)


def samples(graph: Graph) -> int:
    """Samples so far; the first is repeated for as long as time stands."""
    return len({seconds(sample) for sample in graph.messages("/truck/odom")})


@pytest.mark.parametrize("articulation", ["[0.0]", "[0.1, 0.05]"])
def test_a_rig_waits_brakes_stands_and_backs_through_topics(graph: Graph, articulation: str) -> None:
    graph.listen({"/truck/odom": Odometry, "/joint_states": JointState})
    process = graph.command(
        "sim",
        "--ros-args",
        *("-p", "model:=nonlinear", "-p", "real_time_factor:=10.0", "-p", "publish_rate:=20.0"),
        *("-p", "longitudinal_source:=acceleration", "-p", "wait_for_command:=true"),
        *("-p", "initial_speed:=22.2222", "-p", "initial_pose:=[10.0, 5.0, 0.5]"),
        *("-p", f"initial_articulation:={articulation}"),
    )
    until(lambda: bool(graph.received["/truck/odom"]), "the first sample")
    statuses = graph.statuses()
    assert state(statuses("timing")) == "paused"
    first = graph.messages("/truck/odom")[0]
    assert (first.pose.pose.position.x, first.pose.pose.position.y) == (10.0, 5.0)
    if articulation != "[0.0]":
        assert list(graph.messages("/joint_states")[0].position[:3]) == [0.0, 0.1, 0.05]
    topics = ("acceleration", "gear", "trailer_2/brake", "speed")
    publishers = {name: graph.publisher(Float64, f"/{name}") for name in topics}
    publishers["acceleration"].publish(Float64(data=-3.0))

    def way() -> float:
        """Distance that was backed so far in m."""
        poses = [deserialize_message(data, Odometry) for data in graph.received["/truck/odom"][1500:]]
        return -0.05 * sum(each.twist.twist.linear.x for each in poses)

    until(lambda: len(graph.received["/truck/odom"]) > 20 * 75, "more than a minute at rest")
    publishers["speed"].publish(Float64(data=9.0))  # of the two the source names the other
    publishers["gear"].publish(Float64(data=-1.0))
    publishers["acceleration"].publish(Float64(data=0.8))
    until(lambda: way() > 5.0, "the rig to back")
    publishers["acceleration"].publish(Float64(data=0.1))
    until(lambda: way() > 20.0, "20 m backwards")
    publishers["trailer_2/brake"].publish(Float64(data=99.0))
    until(lambda: "trailer_2/brake_clamped" in state(statuses("inputs"), "problems"), "the clamped brake")
    status, _, errors = stop(process)
    assert "stopped at" not in errors
    assert status == 0
    assert "speed: 9.0: rejected, longitudinal_source or friction_file names another source" in errors
    poses = graph.messages("/truck/odom")
    time = np.array([seconds(each) for each in poses])
    time -= time[0]
    where = np.array([(each.pose.pose.position.x, each.pose.pose.position.y) for each in poses])
    at_rest = (time > 11.0) & (time < 72.0)
    assert np.ptp(where[at_rest], axis=0).max() < 1e-3
    assert max(each.twist.twist.linear.x for each in poses) < 22.3
    again = Resimulation(run_directory(graph.directory))
    list(again.compare())
    assert (again.bit_identical, again.agrees) == (True, True)
    assert [m.data for _, m in recorded(run_directory(graph.directory))["/trailer_2/brake"]] == [15.0]


def test_it_starts_paused_and_steps_many_samples_and_a_linear_model_begins_straight(graph: Graph) -> None:
    graph.listen({"/truck/odom": Odometry})
    process = graph.command(
        "sim",
        "--ros-args",
        *("-p", "start_paused:=true", "-p", "step_samples:=25", "-p", "initial_speed:=15.0"),
    )
    until(lambda: bool(graph.received["/truck/odom"]), "the first sample")
    assert (
        graph.call("/yawdamp_sim/step", Trigger, Trigger.Request()).message
        == "stepped: simulated time 0.25 s"
    )
    until(lambda: samples(graph) == 26, "25 samples more")
    assert graph.call("/yawdamp_sim/pause", SetBool, SetBool.Request(data=False)).success
    until(lambda: samples(graph) > 30, "time to go on")
    assert (
        graph.call(
            "/yawdamp_sim/get_parameters", GetParameters, GetParameters.Request(names=["initial_speed"])
        )
        .values[0]
        .double_value
        == 15.0
    )
    assert stop(process)[0] == 0
    status, _, errors = outcome(graph.command("sim", "--ros-args", "-p", "initial_articulation:=[0.1, 0.0]"))
    assert status == 2
    assert "a linear model begins straight" in errors
