"""The numerics and the library need no ROS; what needs it says so."""

import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

ROS = (
    "rclpy",
    "builtin_interfaces",
    "geometry_msgs",
    "nav_msgs",
    "sensor_msgs",
    "std_msgs",
    "ament_index_python",
)


def loaded_by(code: str, *, without_ros: bool = False) -> subprocess.CompletedProcess[str]:
    hide = f"import sys; sys.modules.update(dict.fromkeys({ROS!r}))\n" if without_ros else ""
    return subprocess.run([sys.executable, "-c", hide + code], capture_output=True, text=True, check=False)


@pytest.mark.parametrize(
    "code",
    [
        "import yawdamp_ros",
        "from yawdamp_ros import load_vehicle, linear_model, simulate",
        "import yawdamp_ros.vehicle, yawdamp_ros.dynamics, yawdamp_ros.stepping",
        "import yawdamp_ros.manoeuvres, yawdamp_ros.simulation, yawdamp_ros.analysis, yawdamp_ros.logs",
        "import yawdamp_ros.__main__, yawdamp_ros.cli.simulate, yawdamp_ros.runs.outputs",
    ],
)
def test_no_ros_module_is_imported(code: str) -> None:
    found = loaded_by(f"{code}\nimport sys\nprint([name for name in {ROS!r} if name in sys.modules])")
    assert (found.stdout, found.stderr) == ("[]\n", "")


def test_every_message_package_that_is_installed_is_forbidden_to_the_numerics() -> None:
    index = Path(sys.prefix) / "share" / "ament_index" / "resource_index" / "rosidl_interfaces"
    if not index.is_dir():
        pytest.skip("this environment has no ROS")
    installed = {path.name for path in index.iterdir()}
    settings = tomllib.loads((Path(__file__).parents[1] / "pyproject.toml").read_text(encoding="utf-8"))
    contracts = {one["name"]: one for one in settings["tool"]["importlinter"]["contracts"]}
    forbidden = set(contracts["The numerics never import ROS"]["forbidden_modules"])
    assert installed <= forbidden


def test_the_package_alone_imports_nothing_slow() -> None:
    found = loaded_by("import yawdamp_ros, sys\nprint('numpy' in sys.modules, 'scipy' in sys.modules)")
    assert found.stdout == "False False\n"


def test_a_notebook_simulates_without_ros() -> None:
    code = (
        "from yawdamp_ros import load_vehicle, simulate\n"
        "from yawdamp_ros.manoeuvres import LaneChange\n"
        "print(simulate(load_vehicle('interlink'), LaneChange(), 5.0).yaw.shape)"
    )
    assert loaded_by(code, without_ros=True).stdout == "(5001, 3)\n"


def test_an_unknown_name_of_the_package_is_an_attribute_error() -> None:
    import yawdamp_ros  # noqa: PLC0415 - the module is the question

    with pytest.raises(AttributeError, match="no attribute 'load_truck'"):
        yawdamp_ros.load_truck  # noqa: B018


def test_a_command_that_needs_ros_says_what_to_install() -> None:
    found = loaded_by("from yawdamp_ros.cli import run\nprint(run(['sim']))", without_ros=True)
    assert found.stdout == "2\n"
    assert found.stderr.startswith("yawdamp sim: needs ROS 2: source a Jazzy, or pip install")
    assert found.stderr.count("\n") == 1
