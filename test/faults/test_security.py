"""The permissions that config/sros2 gives the node are those that it needs, and what it does without."""

import re
import shutil
import subprocess
import xml.etree.ElementTree as ET
from fnmatch import fnmatchcase
from pathlib import Path

import pytest

from graph import Graph, outcome, stop, until

ROOT = Path(__file__).parents[2]
SROS2 = ROOT / "config" / "sros2"
PAGE = (ROOT / "docs" / "how_to" / "restrict_who_may_steer.md").read_text(encoding="utf-8")


def permitted(direction: str) -> list[str]:
    """Topics of DDS that the node may publish or subscribe to."""
    root = ET.parse(SROS2 / "permissions.xml").getroot()  # noqa: S314 - our own file
    return [str(topic.text) for topic in root.findall(f".//allow_rule/{direction}/topics/topic")]


def covered(names: set[str], direction: str) -> bool:
    return all(any(fnmatchcase(name, pattern) for pattern in permitted(direction)) for name in names)


def test_whoever_is_not_allowed_is_denied() -> None:
    root = ET.parse(SROS2 / "permissions.xml").getroot()  # noqa: S314
    assert [element.text for element in root.iter("default")] == ["DENY"]
    assert root.find(".//allow_rule/publish/topics/topic[.='*']") is None
    governance = ET.parse(SROS2 / "governance.xml").getroot()  # noqa: S314
    assert [one.text for one in governance.iter("allow_unauthenticated_participants")] == ["false"]


@pytest.mark.skipif(shutil.which("openssl") is None, reason="openssl signs them")
def test_the_manuals_lines_sign_them(tmp_path: Path) -> None:
    lines = next(block for block in re.findall(r"```sh\n(.*?)```", PAGE, re.DOTALL) if "smime" in block)
    signing = lines[lines.index("for ") : lines.index("done") + len("done")]
    for directory in ("public", "private", "enclaves/yawdamp_sim"):
        (tmp_path / "keys" / directory).mkdir(parents=True)
    (tmp_path / "config").symlink_to(SROS2.parent)
    key, certificate = "keys/private/permissions_ca.key.pem", "keys/public/permissions_ca.cert.pem"

    def openssl(*arguments: str) -> bytes:
        return subprocess.run(["openssl", *arguments], cwd=tmp_path, check=True, capture_output=True).stdout

    openssl("ecparam", "-name", "prime256v1", "-genkey", "-noout", "-out", key)
    openssl("req", "-x509", "-new", "-key", key, "-days", "2", "-subj", "/CN=ca", "-out", certificate)
    subprocess.run(["sh", "-e", "-c", signing], cwd=tmp_path, check=True, capture_output=True)
    for document in ("permissions", "governance"):
        signed = f"keys/enclaves/yawdamp_sim/{document}.p7s"
        content = openssl("smime", "-verify", "-text", "-in", signed, "-CAfile", certificate)
        assert content.split() == (SROS2 / f"{document}.xml").read_bytes().split()


@pytest.mark.graph
def test_the_permissions_are_all_that_the_node_says_and_hears_and_nothing_else(graph: Graph) -> None:
    extras = ["publish_clock:=true", "publish_markers:=true", "model:=nonlinear"]
    extras.append("vehicle_overrides:=[units.1.axles.0.steered=commanded]")
    options = [word for extra in extras for word in ("-p", extra)]
    process = graph.command("sim", "--no-record", "--ros-args", *options)
    node = graph.node
    here = ("yawdamp_sim", "/")
    until(lambda: here in node.get_node_names_and_namespaces(), "the node")
    until(lambda: node.count_publishers("/diagnostics") > 0, "its publishers")
    until(lambda: len(node.get_service_names_and_types_by_node(*here)) > 9, "its services")
    said = {f"rt{name}" for name, _ in node.get_publisher_names_and_types_by_node(*here)}
    heard = {f"rt{name}" for name, _ in node.get_subscriber_names_and_types_by_node(*here)}
    services = {name for name, _ in node.get_service_names_and_types_by_node(*here)}
    assert stop(process)[0] == 0
    assert covered(said | {f"rr{name}Reply" for name in services}, "publish")
    assert covered(heard | {f"rq{name}Request" for name in services}, "subscribe")
    # Each permission is used, but for those of what is not there or not the node's own.
    others = {"ros_discovery_info", "rt/tf", "rt/tf_static", "rt/clock", "rt/parameter_events"}
    others |= {
        "rt/vehicle/status/*",
        "rt/localization/kinematic_state",
        "rt/control/command/*_cmd",
    }  # autoware
    used = said | heard | {f"rr{name}Reply" for name in services} | {f"rq{name}Request" for name in services}
    for pattern in {*permitted("publish"), *permitted("subscribe")} - others:
        assert any(fnmatchcase(name, pattern) for name in used), pattern


@pytest.mark.graph
def test_security_that_cannot_be_had_is_one_line(graph: Graph) -> None:
    graph.environment |= {
        "ROS_SECURITY_ENABLE": "true",
        "ROS_SECURITY_STRATEGY": "Enforce",
        "ROS_SECURITY_KEYSTORE": str(graph.directory),
    }
    (graph.directory / "enclaves" / "yawdamp_sim").mkdir(parents=True)
    status, _, errors = outcome(graph.command("sim", "--ros-args", "--enclave", "/yawdamp_sim"))
    assert status == 2
    assert errors.startswith("python -m yawdamp_ros sim: ")
    assert len(errors.splitlines()) == 1
