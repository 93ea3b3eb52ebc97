"""The robot description, followed joint by joint as robot_state_publisher would."""

import math
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from hypothesis import given

from strategies import vehicles
from yawdamp_ros import linear_model, load_vehicle
from yawdamp_ros.cli import run
from yawdamp_ros.stepping import Stepper
from yawdamp_ros.vehicle import Vehicle
from yawdamp_ros.vehicle.urdf import urdf


def frame_of(robot: ET.Element, link: str, joints: dict[str, float]) -> tuple[float, float, float]:
    """Pose of a link in the frame of the first one."""
    for joint in robot.iter("joint"):
        child, parent = joint.find("child"), joint.find("parent")
        assert child is not None
        assert parent is not None
        if child.attrib["link"] == link:
            x, y, yaw = frame_of(robot, parent.attrib["link"], joints)
            origin, axis = joint.find("origin"), joint.find("axis")
            assert origin is not None
            ahead = float(origin.attrib["xyz"].split()[0])
            turn = (
                0.0 if axis is None else joints[joint.attrib["name"]] * float(axis.attrib["xyz"].split()[2])
            )
            return x + ahead * math.cos(yaw), y + ahead * math.sin(yaw), yaw + turn
    return 0.0, 0.0, 0.0


@given(vehicles(min_units=2))
def test_its_joints_put_every_unit_where_the_simulation_has_it(vehicle: Vehicle) -> None:
    stepper = Stepper(linear_model(vehicle), 0.01)
    stepper.steer(0.05)
    for _ in range(100):
        stepper.advance()
    sample = stepper.sample()
    joints = {f"articulation_{index}": angle for index, angle in enumerate(sample.articulation, 1)}
    robot = ET.fromstring(urdf(vehicle))  # noqa: S314 - our own text
    x0, y0, yaw0 = sample.x[0], sample.y[0], sample.yaw[0]
    for index, name in enumerate(vehicle.unit_names):
        x, y, yaw = frame_of(robot, name, joints)
        found = [
            x0 + x * math.cos(yaw0) - y * math.sin(yaw0),
            y0 + x * math.sin(yaw0) + y * math.cos(yaw0),
            yaw0 + yaw,
        ]
        expected = [sample.x[index], sample.y[index], sample.yaw[index]]
        np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9)


def test_links_joints_and_masses_are_those_of_the_vehicle() -> None:
    robot = ET.fromstring(urdf(load_vehicle("interlink")))  # noqa: S314
    assert robot.attrib["name"] == "interlink"
    joints = {joint.attrib["name"]: joint.attrib["type"] for joint in robot.iter("joint")}
    assert joints == {
        "articulation_1": "continuous",
        "trailer_1_front": "fixed",
        "articulation_2": "continuous",
        "trailer_2_front": "fixed",
        "steering": "continuous",
    }
    assert [float(mass.attrib["value"]) for mass in robot.iter("mass")] == [9200.0, 16906.0, 29894.0]


def test_the_command_prints_or_writes_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["urdf", "--vehicle", "truck_trailer"]) == 0
    printed = capsys.readouterr().out
    assert run(["urdf", "--vehicle", "truck_trailer", "--output", str(tmp_path / "a.urdf")]) == 0
    assert (tmp_path / "a.urdf").read_text() == printed
    assert run(["urdf", "--output", str(tmp_path / "none" / "a.urdf")]) == 2
    assert "cannot be written: No such file" in capsys.readouterr().err
