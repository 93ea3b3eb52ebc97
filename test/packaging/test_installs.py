"""The package as colcon and as pip install it, used as `ros2 run` uses it."""

import os
import site
import subprocess
import sys
import venv
from importlib.metadata import version
from pathlib import Path

import pytest
from ament_index_python import get_package_prefix

from graph import has_handler, stop, until

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


@pytest.fixture(scope="session")
def source(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of what git tracks, so that builds leave nothing in the checkout."""
    copy = tmp_path_factory.mktemp("workspace") / "src" / "yawdamp_ros"
    copy.mkdir(parents=True)
    files = run("git", "ls-files", "-z", cwd=ROOT, env=dict(os.environ)).split("\0")[:-1]
    run("cp", "--parents", "-P", *files, copy, cwd=ROOT, env=dict(os.environ))
    return copy


@pytest.fixture(scope="session")
def colcon_prefix(source: Path) -> Path:
    """Where `colcon build` installed the package."""
    workspace = source.parents[1]
    colcon = Path(sys.executable).with_name("colcon")
    run(colcon, "--log-base", "log", "build", cwd=workspace, env=environment())
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


@pytest.fixture(params=["colcon", "pip"])
def prefix(request: pytest.FixtureRequest) -> Path:
    """Each kind of installation in turn."""
    installed: Path = request.getfixturevalue(f"{request.param}_prefix")
    return installed


def python_path(prefix: Path) -> str:
    return str(next(prefix.glob("lib/python*/site-packages")))


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
def test_every_command_is_there_and_is_the_installed_code(prefix: Path, command: str, tmp_path: Path) -> None:
    env = environment(PYTHONPATH=python_path(prefix))
    shown = run(prefix / "lib" / "yawdamp_ros" / command, "--help", cwd=tmp_path, env=env)
    assert shown.startswith(f"usage: yawdamp_ros {command}")
    where = "import yawdamp_ros; print(yawdamp_ros.__file__)"
    imported = run(sys.executable, "-c", where, cwd=tmp_path, env=env).strip()
    assert Path(imported).is_relative_to(prefix)


def test_data_files_are_found_without_an_ament_index(prefix: Path, tmp_path: Path) -> None:
    code = (
        "from yawdamp_ros.share import share_directory; from yawdamp_ros import load_vehicle; "
        "print(share_directory()); load_vehicle('interlink')"
    )
    env = environment(PYTHONPATH=python_path(prefix))
    share = Path(run(sys.executable, "-c", code, cwd=tmp_path, env=env).strip())
    assert share == prefix / "share" / "yawdamp_ros"
    for name in ("package.xml", "config/vehicle.schema.json", "config/sim.yaml", "launch/sim.launch.py"):
        assert (share / name).is_file(), name


def test_page_of_an_assessment_is_installed(prefix: Path) -> None:
    (page,) = Path(python_path(prefix)).glob("yawdamp_ros/pictures/*.html")
    assert page.name == "assessment.html"


def test_colcon_puts_its_environment_hooks_in_place(colcon_prefix: Path) -> None:
    # A package.xml that colcon cannot read is built all the same, but without these.
    assert (colcon_prefix / "share/yawdamp_ros/hook/ament_prefix_path.sh").is_file()
    assert (colcon_prefix / "share/ament_index/resource_index/packages/yawdamp_ros").is_file()


def test_versions_agree() -> None:
    assert f"<version>{version('yawdamp_ros')}</version>" in (ROOT / "package.xml").read_text()
