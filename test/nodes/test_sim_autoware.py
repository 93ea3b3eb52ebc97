"""Autoware's own message type steers over a real graph; it is built here from its definition."""

import os
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState

from graph import Graph, stamps, stop, until
from runs import run_directory
from yawdamp_ros.vehicle import load_vehicle, supports

pytestmark = [
    pytest.mark.graph,
    pytest.mark.skipif(shutil.which("g++") is None, reason="the message is compiled"),
    pytest.mark.skipif(find_spec("rosidl_generator_py") is None, reason="the message is generated"),
]

ROOT = Path(__file__).parents[2]
STEERING = """
import time
import rclpy
from autoware_control_msgs.msg import Lateral
rclpy.init()
publisher = rclpy.create_node("controller").create_publisher(Lateral, "steering", 10)
while True:
    publisher.publish(Lateral(steering_tire_angle=0.0625))
    time.sleep(0.05)
"""
DRIVER = """
import rclpy
from autoware_control_msgs.msg import Control
from autoware_vehicle_msgs.msg import (
    ControlModeReport, GearCommand, GearReport, SteeringReport, VelocityReport)
rclpy.init()
node = rclpy.create_node("driver")
heard = {}
for name, kind in (("velocity_status", VelocityReport), ("steering_status", SteeringReport),
                   ("gear_status", GearReport), ("control_mode", ControlModeReport)):
    node.create_subscription(kind, f"/vehicle/status/{name}", lambda m, n=name: heard.update({n: m}), 1)
control = node.create_publisher(Control, "/control/command/control_cmd", 1)
shift = node.create_publisher(GearCommand, "/control/command/gear_cmd", 1)

def drive(acceleration, gear, done):
    command = Control()
    command.lateral.steering_tire_angle = 0.0625
    command.longitudinal.acceleration, command.longitudinal.is_defined_acceleration = acceleration, True
    while not (len(heard) == 4 and done(heard["velocity_status"].longitudinal_velocity)):
        shift.publish(GearCommand(command=gear))
        control.publish(command)
        rclpy.spin_once(node, timeout_sec=0.02)

drive(-1.5, GearCommand.DRIVE, lambda speed: abs(speed) < 0.01)
print(heard["gear_status"].report, f'{heard["steering_status"].steering_tire_angle:.3f}', flush=True)
drive(0.5, GearCommand.REVERSE, lambda speed: speed < -0.5)
print(heard["gear_status"].report, heard["control_mode"].mode, flush=True)
"""


@pytest.fixture(scope="module")
def messages(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """Environment in which Autoware's messages are installed."""
    built = tmp_path_factory.mktemp("messages")
    script = ROOT / "test" / "autoware_messages.py"
    prefix = {"AMENT_PREFIX_PATH": os.environ.get("AMENT_PREFIX_PATH", sys.prefix)}
    subprocess.run([sys.executable, str(script), str(built)], env={**os.environ, **prefix}, check=True)
    return {
        "PYTHONPATH": os.pathsep.join([str(built / "out"), str(ROOT)]),
        "LD_LIBRARY_PATH": f"{built / 'lib'}{os.pathsep}{os.environ.get('LD_LIBRARY_PATH', '')}",
        "AMENT_PREFIX_PATH": f"{built}{os.pathsep}{prefix['AMENT_PREFIX_PATH']}",
    }


def test_autoware_s_lateral_steers_and_is_recorded_and_repeated(
    graph: Graph, messages: dict[str, str]
) -> None:
    graph.environment |= messages
    graph.listen({"/joint_states": JointState})
    process = graph.command("sim", "--ros-args", "-p", "steering_type:=autoware_control_msgs/msg/Lateral")
    controller = graph.script(STEERING)
    try:
        until(lambda: any(m.position[0] == 0.0625 for m in graph.messages("/joint_states")), "the angle")
    finally:
        controller.terminate()
        controller.communicate()
    assert stop(process)[0] == 0
    again = graph.command("resimulate", str(run_directory(graph.directory)))
    assert "every value is bit-identical" in again.communicate(timeout=60)[0]


def test_autoware_brakes_a_rig_shifts_it_into_reverse_and_backs_it(
    graph: Graph, messages: dict[str, str]
) -> None:
    graph.environment |= messages
    graph.listen({"/localization/kinematic_state": Odometry, "/truck/odom": Odometry})
    process = graph.command(
        "sim",
        "--ros-args",
        *("-p", "autoware:=true", "-p", "model:=nonlinear", "-p", "initial_speed:=5.0"),
        *("-p", "wait_for_command:=true", "-p", "real_time_factor:=2.0", "-p", "publish_rate:=20.0"),
        *("-p", "acceleration_dead_time:=0.1", "-p", "acceleration_time_constant:=0.27"),
        *("-p", "steering_dead_time:=0.24", "-p", "steering_time_constant:=0.27"),
    )
    driver = graph.script(DRIVER)
    try:
        told = driver.communicate(timeout=60)[0].split()
    finally:
        driver.terminate()
    assert told == ["2", "0.062", "20", "1"]
    status, _, errors = stop(process)
    assert (status, "rejected" in errors) == (0, False)
    found = graph.messages("/localization/kinematic_state")
    (state,) = {(each.header.frame_id, each.child_frame_id) for each in found}
    assert state == ("map", "base_link")
    # Autoware's vehicle frame is at the rear axles, that of the truck at its centre of gravity.
    rear = supports(load_vehicle("interlink").units[0]).rear
    by_stamp = dict(zip(stamps(odometry := graph.messages("/truck/odom")), odometry, strict=True))
    pairs = [
        (each, by_stamp[stamp]) for stamp, each in zip(stamps(found), found, strict=True) if stamp in by_stamp
    ]
    assert len(pairs) > 20
    for shown, truth in pairs:
        turn = truth.pose.pose.orientation
        heading = complex(turn.w, turn.z) ** 2
        place = complex(truth.pose.pose.position.x, truth.pose.pose.position.y) + rear * heading
        assert complex(shown.pose.pose.position.x, shown.pose.pose.position.y) == pytest.approx(place)
        sideways = truth.twist.twist.linear.y + rear * truth.twist.twist.angular.z
        assert shown.twist.twist.linear.y == pytest.approx(sideways)
    assert found[-1].pose.pose.position.x < max(each.pose.pose.position.x for each in found) - 0.05
    again = graph.command("resimulate", str(run_directory(graph.directory)))
    assert "every value is bit-identical" in again.communicate(timeout=60)[0]
