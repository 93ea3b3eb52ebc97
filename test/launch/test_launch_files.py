"""The launch files, where `launch` can be imported; it is not on PyPI."""

from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

import pytest

from yawdamp_ros.share import share_directory

LAUNCH = share_directory() / "launch"
FILES = sorted(path.name for path in LAUNCH.glob("*.launch.py"))


@pytest.mark.parametrize("name", ["replay.launch.py", "sim.launch.py"])
def test_each_launch_file_is_there_and_valid_python(name: str) -> None:
    compile((LAUNCH / name).read_text(encoding="utf-8"), name, "exec")
    assert name in FILES


@pytest.mark.parametrize("name", FILES)
def test_each_describes_the_simulator(name: str) -> None:
    pytest.importorskip("launch_ros")
    spec = spec_from_file_location(Path(name).stem.replace(".", "_"), LAUNCH / name)
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    description = module.generate_launch_description()
    nodes = [entity for entity in description.entities if type(entity).__name__ == "Node"]
    assert "sim" in {node.node_executable for node in nodes}
