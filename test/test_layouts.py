"""The layouts for other programs name topics and fields that a run has."""

import json
import re
from xml.etree import ElementTree as ET

from ruamel.yaml import YAML

from runs import OUTPUTS
from yawdamp_ros.share import share_directory

CONFIG = share_directory() / "config"
FIELDS = {
    **{topic: set(kind.get_fields_and_field_types()) for topic, kind in OUTPUTS.items()},
}


def test_the_foxglove_layout_shows_what_there_is() -> None:
    layout = json.loads((CONFIG / "foxglove_layout.json").read_text(encoding="utf-8"))
    shown = re.findall(r'"value": "(/[^."]+)\.(\w+)', json.dumps(layout))
    assert len(shown) > 10
    for topic, field in shown:
        assert field in FIELDS[topic]
    panels = set(re.findall(r'"(Plot![a-z]+)"', json.dumps(layout["layout"])))
    assert panels == set(layout["configById"])


def test_the_plotjuggler_layout_shows_what_there_is() -> None:
    root = ET.parse(CONFIG / "plotjuggler_layout.xml").getroot()  # noqa: S314 - our own file
    curves = [curve.attrib["name"] for curve in root.iter("curve")]
    assert len(curves) > 10
    names = ("steering", "articulation_1", "articulation_2")
    joints = {f"/joint_states/{name}/position" for name in names}
    for curve in curves:
        topic, _, field = curve.rpartition("/")
        assert curve in joints or field in FIELDS[topic]


def test_the_rviz_configuration_shows_what_there_is() -> None:
    text = (CONFIG / "yawdamp.rviz").read_text(encoding="utf-8")
    manager = YAML(typ="safe", pure=True).load(text)["Visualization Manager"]
    assert manager["Global Options"]["Fixed Frame"] == "odom"
    topics = {display["Topic"]["Value"] for display in manager["Displays"] if "Topic" in display}
    assert topics == {"markers", "truck/odom"}
    assert topics - {"markers"} <= {topic[1:] for topic in OUTPUTS}
