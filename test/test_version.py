import xml.etree.ElementTree as ET
from importlib.metadata import version
from pathlib import Path

from yawdamp_ros.version import VERSION


def test_the_version_is_that_of_the_package_for_pip_and_for_ros() -> None:
    package = ET.parse(Path(__file__).parents[1] / "package.xml").getroot()  # noqa: S314 - our own file
    assert [version("yawdamp_ros"), package.findtext("version")] == [VERSION, VERSION]
