"""What is declared is what is needed, and what is tested."""

import ast
import re
import sys
import xml.etree.ElementTree as ET
from importlib.metadata import requires
from pathlib import Path

from packaging.requirements import Requirement
from packaging.version import Version

ROOT = Path(__file__).parents[2]
PACKAGE = ET.parse(ROOT / "package.xml").getroot()  # noqa: S314 - our own file
KEYS = {element.text for element in PACKAGE if element.tag in {"depend", "exec_depend", "test_depend"}}

MODULES = {"ruamel": "python3-ruamel.yaml", "rosbags": "python3-rosbags-pip"}
"""Keys that are not python3-<module>, by module."""
BROUGHT_ALONG = {"mcap", "mcap_ros2", "zstandard", "setuptools", "packaging", "PIL"}
"""By mcap-ros2-support, by pytest and colcon, and by matplotlib."""
OWN = {"yawdamp_ros"} | {path.stem for folder in ("test", "docs") for path in (ROOT / folder).iterdir()}
NOT_COLLECTED = {"fuzz.py"}


def locked(name: str) -> dict[str, Version]:
    """Lowest version of each distribution in a lock file."""
    found: dict[str, Version] = {}
    for line in (ROOT / name).read_text(encoding="utf-8").splitlines():
        distribution, version = re.match(r"([\w.-]+)==([^ ;]+)", line).groups()
        key = distribution.lower().replace(".", "-")
        found[key] = min(found.get(key, Version(version)), Version(version))
    return found


def test_every_key_of_package_xml_is_in_the_table_and_no_other() -> None:
    text = (ROOT / "docs" / "dependencies.md").read_text(encoding="utf-8")
    table = text.partition("Optional")[0]
    assert set(re.findall(r"^\| `([^`]+)` \|", table, flags=re.MULTILINE)) == KEYS


def test_lower_bounds_are_the_lowest_versions_that_are_tested() -> None:
    locks = [locked("requirements.lock"), locked("requirements-noble.lock")]
    bounds = {
        (requirement.name.lower().replace(".", "-"), Version(each.version))
        for requirement in map(Requirement, requires("yawdamp_ros") or [])
        for each in requirement.specifier
        if each.operator == ">=" and "docs" not in str(requirement.marker)
    }
    assert len(bounds) > 8
    lowest = {(name, min(lock[name] for lock in locks if name in lock)) for name, _ in bounds}
    assert bounds == lowest


def test_every_test_file_has_a_base_name_of_its_own() -> None:
    names = [path.name for path in (ROOT / "test").rglob("test_*.py")]
    assert len(names) == len(set(names)), sorted(name for name in names if names.count(name) > 1)


def test_the_tests_import_nothing_that_package_xml_does_not_bring() -> None:
    for path in (ROOT / "test").rglob("*.py"):
        if "soak" in path.parts or path.name in NOT_COLLECTED:
            continue
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            names += [node.module or ""] if isinstance(node, ast.ImportFrom) else []
            for name in (each.partition(".")[0] for each in names):
                if name not in sys.stdlib_module_names | OWN | BROUGHT_ALONG:
                    assert KEYS & {name, MODULES.get(name, f"python3-{name}")}, f"{path}: {name}"
