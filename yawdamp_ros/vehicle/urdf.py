"""A vehicle as URDF, for robot_state_publisher and viewers."""

from xml.etree.ElementTree import Element, SubElement, indent, tostring

from yawdamp_ros.vehicle.model import Unit, Vehicle
from yawdamp_ros.vehicle.shape import HEIGHT, WIDTH, extent, hitch_frame, steered_axle_link


def urdf(vehicle: Vehicle) -> str:
    """Robot description: a link for every unit, a joint for every hitch, one for the steered axle.

    The joints are those of ``joint_states``: an articulation angle is the yaw of the unit ahead less that
    of the unit behind, so that its axis points down. A unit's frame lies at its centre of gravity.

    Parameters
    ----------
    vehicle : Vehicle

    Returns
    -------
    str
        XML.
    """
    robot = Element("robot", name=vehicle.name)
    for unit in vehicle.units:
        _link(robot, unit)
    for joint, ((rear_hitch, front_hitch), towing, towed) in enumerate(
        zip(vehicle.hitches, vehicle.units, vehicle.units[1:], strict=False), 1
    ):
        SubElement(robot, "link", name=hitch_frame(towed.name))
        ends = towing.name, hitch_frame(towed.name)
        _revolute(robot, f"articulation_{joint}", ends, rear_hitch, -1)
        fixed = SubElement(robot, "joint", name=f"{towed.name}_front", type="fixed")
        _ends(fixed, hitch_frame(towed.name), towed.name, -front_hitch)
    lead = vehicle.units[0]
    steered = next(axle.position for axle in lead.axles if axle.steered)
    SubElement(robot, "link", name=steered_axle_link(lead.name))
    _revolute(robot, "steering", (lead.name, steered_axle_link(lead.name)), steered, 1)
    indent(robot)
    return '<?xml version="1.0"?>\n' + tostring(robot, encoding="unicode") + "\n"


def _link(robot: Element, unit: Unit) -> None:
    rear, front = extent(unit)
    link = SubElement(robot, "link", name=unit.name)
    inertial = SubElement(link, "inertial")
    SubElement(inertial, "mass", value=repr(unit.mass))
    # The model has no roll and no pitch; a yaw inertia alone makes no rigid body.
    half = repr(0.5 * unit.yaw_inertia)
    SubElement(inertial, "inertia", ixx=half, iyy=half, izz=repr(unit.yaw_inertia), ixy="0", ixz="0", iyz="0")
    visual = SubElement(link, "visual")
    SubElement(visual, "origin", xyz=f"{0.5 * (front + rear):.6g} 0 {0.5 * HEIGHT:g}")
    SubElement(
        SubElement(visual, "geometry"), "box", size=f"{max(front - rear, 0.1):.6g} {WIDTH:g} {HEIGHT:g}"
    )


def _revolute(robot: Element, name: str, ends: tuple[str, str], x: float, axis: int) -> None:
    joint = SubElement(robot, "joint", name=name, type="continuous")
    _ends(joint, *ends, x)
    SubElement(joint, "axis", xyz=f"0 0 {axis}")


def _ends(joint: Element, parent: str, child: str, x: float) -> None:
    SubElement(joint, "parent", link=parent)
    SubElement(joint, "child", link=child)
    SubElement(joint, "origin", xyz=f"{x!r} 0 0")
