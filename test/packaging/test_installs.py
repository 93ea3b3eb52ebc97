"""The package as colcon and as pip install it, used as `ros2 run` uses it."""

import os
import re
import site
import subprocess
import sys
import venv
from importlib.metadata import version
from pathlib import Path

import pytest
from ament_index_python import get_package_prefix

from graph import has_handler, stop, until
from yawdamp_ros.cli.dispatch import COMMANDS

ROOT = Path(__file__).parents[2]


def environment(prefix: Path | None = None, **more: str) -> dict[str, str]:
    """Environment of this process with the bare interpreter's paths, and one prefix of an ament index."""
    kept = {
        name: value for name, value in os.environ.items() if name not in {"AMENT_PREFIX_PATH", "PYTHONPATH"}
    }
    index = {"AMENT_PREFIX_PATH": str(prefix)} if prefix else {}
    return {**kept, **index, "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", **more}


def run(*command: str | Path, cwd: Path, env: dict[str, str]) -> str:
    done = subprocess.run(command, cwd=cwd, env=env, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


COLCON = Path(sys.executable).with_name("colcon")


@pytest.fixture(scope="session")
def colcon_prefix(source: Path) -> Path:
    """Where `colcon build` installed the package."""
    workspace = source.parents[1]
    run(COLCON, "--log-base", "log", "build", cwd=workspace, env=environment())
    return workspace / "install" / "yawdamp_ros"


@pytest.fixture(scope="session")
def symlink_prefix(source: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where `colcon build --symlink-install` installed the package."""
    workspace = tmp_path_factory.mktemp("symlinks")
    options = ["--symlink-install", "--base-paths", source]
    run(COLCON, "--log-base", "log", "build", *options, cwd=workspace, env=environment())
    return workspace / "install" / "yawdamp_ros"


@pytest.fixture(scope="session")
def pip_prefix(source: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A fresh virtual environment in which `pip install` installed the package."""
    prefix = tmp_path_factory.mktemp("venv")
    venv.create(prefix, symlinks=True)
    # Dependencies come from this environment, for speed.
    packages = next(prefix.glob("lib/python*/site-packages"))
    (packages / "dependencies.pth").write_text("\n".join(site.getsitepackages()))
    pip = [sys.executable, "-m", "pip", "--quiet", "--disable-pip-version-check", "--python", str(prefix)]
    run(
        *pip,
        "install",
        "--no-deps",
        "--no-build-isolation",
        "--ignore-installed",
        source,
        cwd=prefix,
        env=environment(),
    )
    return prefix


@pytest.fixture(params=["colcon", "symlink", "pip"])
def prefix(request: pytest.FixtureRequest) -> Path:
    """Each kind of installation in turn."""
    installed: Path = request.getfixturevalue(f"{request.param}_prefix")
    return installed


def python_path(prefix: Path) -> str:
    """Directory of the installed package, which is the build directory where that is linked."""
    packages = next(prefix.glob("lib/python*/site-packages"))
    build = prefix.parents[1] / "build" / "yawdamp_ros"
    return str(packages if (packages / "yawdamp_ros").is_dir() else build)


@pytest.mark.graph
def test_ros2_run_finds_the_executable_and_it_runs(
    prefix: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # What ros2 run does: the package's prefix from the ament index, then lib/<package>/<name>.
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(prefix))
    executable = Path(get_package_prefix("yawdamp_ros"), "lib", "yawdamp_ros", "sim")
    assert os.access(executable, os.X_OK)
    env = environment(prefix, PYTHONPATH=python_path(prefix), ROS_DOMAIN_ID="101")
    process = subprocess.Popen(
        [executable], cwd=tmp_path, env=env, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    until(lambda: process.poll() is not None or any((tmp_path / "runs").glob("*/*.mcap")), "a recording")
    assert process.poll() is not None or has_handler(process, 15)
    status, output, errors = stop(process)
    assert status == 0, errors
    assert "interlink" in output
    assert len(list((tmp_path / "runs").glob("*/metadata.yaml"))) == 1


@pytest.mark.parametrize("command", ["sim", "replay", "simulate"])
def test_ros2_run_finds_every_command_and_its_help_says_what_was_typed(
    prefix: Path, command: str, tmp_path: Path
) -> None:
    env = environment(PYTHONPATH=python_path(prefix))
    shown = run(prefix / "lib" / "yawdamp_ros" / command, "--help", cwd=tmp_path, env=env)
    assert shown.startswith(f"usage: ros2 run yawdamp_ros {command}")


def test_the_path_gets_one_command(prefix: Path, tmp_path: Path) -> None:
    ours = {path.name for path in (prefix / "bin").iterdir()} & {"yawdamp", *COMMANDS}
    assert ours == {"yawdamp"}
    env = environment(PYTHONPATH=python_path(prefix))
    shown = run(prefix / "bin" / "yawdamp", "sim", "--help", cwd=tmp_path, env=env)
    assert shown.startswith("usage: yawdamp sim")


def test_what_runs_is_the_installed_code(prefix: Path, tmp_path: Path) -> None:
    where = "import yawdamp_ros; print(yawdamp_ros.__file__)"
    env = environment(PYTHONPATH=python_path(prefix))
    imported = run(sys.executable, "-c", where, cwd=tmp_path, env=env).strip()
    assert Path(imported).is_relative_to(python_path(prefix))


def test_colcon_test_runs_the_tests_where_launch_testing_collects_them(
    colcon_prefix: Path, source: Path
) -> None:
    env = environment(
        colcon_prefix,
        PYTHONPATH=f"{ROOT / 'test' / 'packaging'}:{python_path(colcon_prefix)}",
    )
    workspace = source.parents[1]
    options = ["--event-handlers", "console_direct+", "--return-code-on-test-failure"]
    # colcon sets PYTEST_ADDOPTS itself, and takes a dash for pytest after a blank only.
    options += ["--pytest-args", " -p", "launch_testing_stand_in", " -k", "version"]
    shown = run(COLCON, "--log-base", "log", "test", *options, cwd=workspace, env=env)
    assert re.search(r"[1-9]\d* passed, \d+ deselected", shown), shown


def test_data_files_are_found_without_an_ament_index(prefix: Path, tmp_path: Path) -> None:
    code = (
        "from yawdamp_ros.share import share_directory; from yawdamp_ros import load_vehicle; "
        "print(share_directory()); load_vehicle('interlink')"
    )
    env = environment(PYTHONPATH=python_path(prefix))
    share = Path(run(sys.executable, "-c", code, cwd=tmp_path, env=env).strip())
    assert share.name == "yawdamp_ros"
    for name in ("package.xml", "config/vehicle.schema.json", "config/sim.yaml", "launch/sim.launch.py"):
        assert (share / name).is_file(), name


def test_templates_of_pages_are_installed(prefix: Path) -> None:
    found = {page.name for page in Path(python_path(prefix)).glob("yawdamp_ros/pictures/*.html")}
    assert found == {page.name for page in (ROOT / "yawdamp_ros" / "pictures").glob("*.html")} != set()


def test_colcon_puts_its_environment_hooks_in_place(colcon_prefix: Path) -> None:
    # A package.xml that colcon cannot read is built all the same, but without these.
    assert (colcon_prefix / "share/yawdamp_ros/hook/ament_prefix_path.sh").is_file()
    assert (colcon_prefix / "share/ament_index/resource_index/packages/yawdamp_ros").is_file()


def test_versions_agree() -> None:
    assert f"<version>{version('yawdamp_ros')}</version>" in (ROOT / "package.xml").read_text()
