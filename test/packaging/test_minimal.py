"""An environment that holds what package.xml's hard dependencies give, and nothing else."""

import os
import subprocess
import sys
import venv
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from importlib.metadata import Distribution, PackageNotFoundError, distribution
from pathlib import Path

import pytest
from packaging.requirements import Requirement

ROOT = Path(__file__).parents[2]
NOT_ON_PYPI = {"launch", "launch_ros", "rviz2", "tf2_msgs"}


def hard_dependencies() -> Iterator[str]:
    """Distributions of PyPI that package.xml's keys stand for."""
    for element in ET.parse(ROOT / "package.xml").getroot():  # noqa: S314 - our own file
        if element.tag not in {"depend", "exec_depend"} or element.text in NOT_ON_PYPI:
            continue
        key = str(element.text)
        if key == "mcap-ros2-support":
            yield key
        else:
            yield (
                key.removeprefix("python3-") if key.startswith("python3-") else f"ros-{key}".replace("_", "-")
            )
    yield "ros-rmw-fastrtps-cpp"  # a middleware, which every ROS has


def with_dependencies(names: Iterator[str]) -> list[Distribution]:
    """Distributions and what they require, without extras."""
    found: dict[str, Distribution] = {}
    waiting = list(names)
    while waiting:
        name = waiting.pop()
        if name in found:
            continue
        try:
            found[name] = distribution(name)
        except PackageNotFoundError:
            continue
        requirements = map(Requirement, found[name].requires or [])
        waiting += [
            each.name for each in requirements if not each.marker or each.marker.evaluate({"extra": ""})
        ]
    return list(found.values())


@pytest.fixture(scope="module")
def minimal(source: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A virtual environment of links to installed distributions, and the package, installed by pip."""
    prefix = tmp_path_factory.mktemp("minimal")
    venv.create(prefix, symlinks=True)
    packages = next(prefix.glob("lib/python*/site-packages"))
    for each in with_dependencies(hard_dependencies()):
        for file in each.files or []:
            link = Path(os.path.normpath(packages / file))
            if "include" in file.parts:
                continue
            target = Path(os.path.normpath(str(file.locate())))
            if target.is_file() and not link.exists() and link.is_relative_to(prefix):
                link.parent.mkdir(parents=True, exist_ok=True)
                link.symlink_to(target)
    pip = [sys.executable, "-m", "pip", "--quiet", "--disable-pip-version-check"]
    # Built here: what builds the package is no dependency of it.
    build = [*pip, "wheel", "--no-deps", "--no-build-isolation", "--wheel-dir", str(prefix), str(source)]
    subprocess.run(build, check=True, cwd=prefix, env=clean_environment())
    (wheel,) = prefix.glob("*.whl")
    install = [*pip, "--python", str(prefix), "install", "--no-deps", str(wheel)]
    subprocess.run(install, check=True, cwd=prefix, env=clean_environment())
    return prefix


def clean_environment(**more: str) -> dict[str, str]:
    hidden = {"AMENT_PREFIX_PATH", "PYTHONPATH", "LD_LIBRARY_PATH", "_ROS_WHEELS_BOOTSTRAP_COMPLETE"}
    kept = {name: value for name, value in os.environ.items() if name not in hidden}
    return {**kept, "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", **more}


def yawdamp(minimal: Path, *arguments: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [minimal / "bin" / "yawdamp", *arguments],
        cwd=cwd,
        env=clean_environment(ROS_DOMAIN_ID="103"),
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )


def test_the_optional_libraries_are_not_there(minimal: Path) -> None:
    code = (
        "from importlib.util import find_spec; "
        "names = 'matplotlib', 'plotly', 'openpyxl', 'control', 'distributed', 'pytest'; "
        "print([m for m in names if find_spec(m)])"
    )
    found = subprocess.run(
        [minimal / "bin" / "python", "-c", code],
        env=clean_environment(),
        capture_output=True,
        text=True,
        check=True,
    )
    assert found.stdout == "[]\n"


def test_simulate_records_and_the_run_is_resimulated(minimal: Path, tmp_path: Path) -> None:
    options = ["--manoeuvre", "lane_change", "--duration", "3", "--output", "run"]
    done = yawdamp(minimal, "simulate", *options, cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    again = yawdamp(minimal, "resimulate", "run", cwd=tmp_path)
    assert again.returncode == 0, again.stderr
    assert "every value is bit-identical" in again.stdout


@pytest.mark.graph
def test_the_node_runs_and_its_run_is_resimulated(minimal: Path, tmp_path: Path) -> None:
    options = ["--manoeuvre", "lane_change", "--duration", "2", "--output", "run"]
    done = yawdamp(minimal, "sim", *options, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    again = yawdamp(minimal, "resimulate", "run", cwd=tmp_path)
    assert again.returncode == 0, again.stdout + again.stderr


@pytest.mark.parametrize("command", ["assess", "stability", "sweep --vary speed=10:30:3", "urdf"])
def test_what_draws_nothing_works(minimal: Path, command: str, tmp_path: Path) -> None:
    done = yawdamp(minimal, *command.split(), cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")


PICTURES = "sudo apt install python3-{0}, or pip install 'yawdamp_ros[pictures]'"
TABLES = "sudo apt install python3-{0}, or pip install 'yawdamp_ros[tables]'"
CLUSTER = "sudo apt install python3-{0}, or pip install 'yawdamp_ros[cluster]'"


@pytest.mark.parametrize(
    "command, library, install",
    [
        ("plot run.csv", "matplotlib", PICTURES),
        ("plot run.csv --output run.html", "plotly", PICTURES),
        ("stability --vary speed=10:30:3 --plot a.png", "matplotlib", PICTURES),
        ("stability --bode a.png", "matplotlib", PICTURES),
        ("sweep --vary speed=10:30:3 --plot a.png", "matplotlib", PICTURES),
        ("assess --xlsx a.xlsx", "openpyxl", TABLES),
        ("sweep --vary speed=10:30:3 --scheduler tcp://127.0.0.1:1", "distributed", CLUSTER),
    ],
)
def test_what_needs_an_optional_library_says_how_to_install_it(
    minimal: Path, command: str, library: str, install: str, tmp_path: Path
) -> None:
    name, *options = command.split()
    done = yawdamp(minimal, name, *options, cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, "")
    needs = f"yawdamp {name}: needs {library}, which is not installed: {install.format(library)}\n"
    assert done.stderr == needs
