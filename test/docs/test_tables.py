"""Tables of the manual and the parameter file are those of the declarations."""

import math
import re
from pathlib import Path
from typing import Any

import pytest
from ruamel.yaml import YAML

import pages
import parameter_table
import reference_pages
from yawdamp_ros.cli.dispatch import COMMANDS
from yawdamp_ros.share import share_directory
from yawdamp_ros.simulation.settings import PARAMETERS, SimParameters
from yawdamp_ros.vehicle import builtin_vehicles

ROOT = Path(__file__).parents[2]
OF_OTHERS = {"--params-file", "--ros-args", "--help", "--no-deps", "--disable-pip"}


@pytest.fixture(scope="module")
def reference(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = tmp_path_factory.mktemp("project")
    (root / "bench").symlink_to(ROOT / "bench")
    (root / "docs" / "reference").mkdir(parents=True)
    reference_pages.write(root / "docs" / "reference")
    return root / "docs" / "reference"


def flat(parameters: dict[str, Any], prefix: str = "") -> dict[str, Any]:
    """Parameters as the node names them, groups joined by dots."""
    found: dict[str, Any] = {}
    for name, value in parameters.items():
        found |= flat(value, f"{prefix}{name}.") if isinstance(value, dict) else {prefix + name: value}
    return found


def test_the_parameter_file_is_that_of_the_declarations() -> None:
    text = (share_directory() / "config" / "sim.yaml").read_text(encoding="utf-8")
    assert text == parameter_table.parameter_file()
    given = flat(YAML(typ="safe", pure=True).load(text)["/**"]["ros__parameters"])
    defaults = {
        name: getattr(SimParameters(), declared.name)
        for name, declared in PARAMETERS.items()
        if not declared.metadata["otherwise"]
    }
    assert list(given) == list(defaults)
    for name, default in defaults.items():
        both_nan = isinstance(default, float) and math.isnan(default) and math.isnan(given[name])
        assert both_nan or (given[name], type(given[name])) == (default, type(default)), name


def test_every_command_has_a_section(reference: Path) -> None:
    text = (reference / "commands.md").read_text(encoding="utf-8")
    for name in COMMANDS:
        assert f"\n## {name}\n" in text


def test_every_parameter_and_vehicle_has_a_row(reference: Path) -> None:
    parameters = (reference / "parameters.md").read_text(encoding="utf-8")
    vehicles = (reference / "vehicles.md").read_text(encoding="utf-8")
    for name in PARAMETERS:
        assert f"\n| `{name}` |" in parameters
    for name in builtin_vehicles():
        assert f"\n| `{name}` |" in vehicles


def test_every_option_that_a_page_names_is_one_of_a_command() -> None:
    helps = "".join(reference_pages.help_of(name) for name in COMMANDS)
    known = set(re.findall(r"--[a-z][a-z-]+", helps))
    for path in (ROOT / "docs").rglob("*.md"):
        if pages.MADE.isdisjoint(path.parts):
            options = re.findall(r"`(--[a-z][a-z-]+)", path.read_text(encoding="utf-8"))
            assert set(options) - known - OF_OTHERS == set(), path.name


def test_the_table_of_services_names_those_of_the_node() -> None:
    server = (ROOT / "yawdamp_ros" / "nodes" / "server.py").read_text(encoding="utf-8")
    offered = {
        (name, f"std_srvs/{kind}") for kind, name in re.findall(r'create_service\((\w+), "(~/\w+)"', server)
    }
    text = (ROOT / "docs" / "reference" / "node.md").read_text(encoding="utf-8")
    assert set(re.findall(r"^\| `(~/\w+)` \| (\S+) \|", text, re.MULTILINE)) == offered
    assert len(offered) == 4
