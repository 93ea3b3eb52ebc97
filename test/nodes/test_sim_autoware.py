"""Autoware's own message type steers over a real graph; it is built here from its definition."""

import os
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest
from sensor_msgs.msg import JointState

from graph import Graph, stop, until
from runs import run_directory

pytestmark = [
    pytest.mark.graph,
    pytest.mark.skipif(shutil.which("g++") is None, reason="the message is compiled"),
    pytest.mark.skipif(find_spec("rosidl_generator_py") is None, reason="the message is generated"),
]

ROOT = Path(__file__).parents[2]
CONTROLLER = """
import time
import rclpy
from autoware_control_msgs.msg import Lateral
rclpy.init()
publisher = rclpy.create_node("controller").create_publisher(Lateral, "steering", 10)
while True:
    publisher.publish(Lateral(steering_tire_angle=0.0625))
    time.sleep(0.05)
"""


def test_autoware_s_lateral_steers_and_is_recorded_and_repeated(graph: Graph, tmp_path: Path) -> None:
    built = tmp_path / "messages"
    script = ROOT / "test" / "autoware_messages.py"
    prefix = {"AMENT_PREFIX_PATH": os.environ.get("AMENT_PREFIX_PATH", sys.prefix)}
    subprocess.run([sys.executable, str(script), str(built)], env={**os.environ, **prefix}, check=True)
    graph.environment |= {
        "PYTHONPATH": os.pathsep.join([str(built / "out"), str(ROOT)]),
        "LD_LIBRARY_PATH": f"{built / 'lib'}{os.pathsep}{os.environ.get('LD_LIBRARY_PATH', '')}",
        "AMENT_PREFIX_PATH": f"{built}{os.pathsep}{prefix['AMENT_PREFIX_PATH']}",
    }
    graph.listen({"/joint_states": JointState})
    process = graph.command("sim", "--ros-args", "-p", "steering_type:=autoware_control_msgs/msg/Lateral")
    controller = graph.script(CONTROLLER)
    try:
        until(lambda: any(m.position[0] == 0.0625 for m in graph.messages("/joint_states")), "the angle")
    finally:
        controller.kill()
        controller.communicate()
    assert stop(process)[0] == 0
    again = graph.command("resimulate", str(run_directory(graph.directory)))
    assert "every value is bit-identical" in again.communicate(timeout=60)[0]
