import subprocess
import sys
from importlib import import_module
from pkgutil import iter_modules
from types import ModuleType

import pytest

import yawdamp_ros

NOT_FOR_IMPORT = {"cli", "nodes"}
"""Packages that are run rather than imported."""


@pytest.mark.parametrize("package", ["yawdamp_ros", "yawdamp_ros.analysis", "yawdamp_ros.logs"])
def test_every_name_loads_and_none_is_hidden_by_a_module(package: str) -> None:
    found = import_module(package)
    names = {name for name in found.__all__ if not isinstance(getattr(found, name), ModuleType)}
    assert not {module.name for module in iter_modules(found.__path__)} & names


def test_a_name_that_there_is_not_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match=r"'yawdamp_ros.logs' has no attribute 'nothing'"):
        import_module("yawdamp_ros.logs").nothing  # noqa: B018


def test_dir_gives_the_public_names_and_rooms_and_no_others() -> None:
    rooms = {module.name for module in iter_modules(yawdamp_ros.__path__) if module.ispkg} - NOT_FOR_IMPORT
    names = {"__version__", "linear_model", "load_drive", "load_run", "load_vehicle", "simulate"}
    assert set(dir(yawdamp_ros)) == names | rooms
    for room in ("analysis", "logs"):
        assert dir(getattr(yawdamp_ros, room)) == sorted(getattr(yawdamp_ros, room).__all__)


def test_a_room_is_there_after_importing_the_package_alone() -> None:
    code = "import yawdamp_ros as y; print(y.analysis.assess.__name__, y.library.simulate is y.simulate)"
    assert subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    ).stdout == ("assess True\n")


def test_importing_the_package_loads_no_library() -> None:
    code = "import sys, yawdamp_ros; print({'numpy', 'scipy', 'rclpy'} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "set()\n"
