"""The launch files, where `launch` can be imported; it is not on PyPI."""

from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from typing import Any

import pytest

from yawdamp_ros.share import share_directory

LAUNCH = share_directory() / "launch"
FILES = sorted(path.name for path in LAUNCH.glob("*.launch.py"))


def loaded(name: str) -> Any:  # noqa: ANN401 - a module
    """A launch file as a module."""
    pytest.importorskip("launch_ros")
    spec = spec_from_file_location(Path(name).stem.replace(".", "_"), LAUNCH / name)
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def configured(description: Any, **given: str) -> Any:  # noqa: ANN401 - launch's own
    """A launch context with a description's arguments, at their defaults unless given."""
    from launch import LaunchContext  # noqa: PLC0415 - it need not be there

    context = LaunchContext()
    for argument in description.get_launch_arguments():
        default = "".join(part.text for part in argument.default_value or [])
        context.launch_configurations[argument.name] = given.get(argument.name, default)
    return context


@pytest.mark.parametrize("name", ["replay.launch.py", "sim.launch.py"])
def test_each_launch_file_is_there_and_valid_python(name: str) -> None:
    compile((LAUNCH / name).read_text(encoding="utf-8"), name, "exec")
    assert name in FILES


@pytest.mark.parametrize(
    "name, arguments",
    [
        (
            "sim.launch.py",
            {"params_file", "namespace", "speed", "steering_type", "duration", "use_sim_time", "vehicle"},
        ),
        (
            "replay.launch.py",
            {"log", "params_file", "namespace", "speed", "vehicle", "steering_ratio", "duration"},
        ),
    ],
)
def test_each_takes_the_arguments_that_it_names(name: str, arguments: set[str]) -> None:
    description = loaded(name).generate_launch_description()
    assert arguments <= {argument.name for argument in description.get_launch_arguments()}


def test_the_simulator_gets_what_was_given_and_no_other_number() -> None:
    module = loaded("sim.launch.py")
    context = configured(module.generate_launch_description(), speed="20", namespace="left")
    (node,) = module.simulator(context)
    assert node.node_executable == "sim"
    (given,) = node._Node__parameters  # noqa: SLF001 - it has no public name
    names = {"".join(part.text for part in key) for key in given}
    assert names == {"speed", "record", "publish_markers"}


def test_a_log_that_is_missing_starts_no_node() -> None:
    module = loaded("replay.launch.py")
    context = configured(module.generate_launch_description(), log="missing.csv")
    with pytest.raises(FileNotFoundError, match=r"log: missing.csv: no such file"):
        module.nodes(context)


def test_a_replay_that_failed_fails_the_launch() -> None:
    module = loaded("replay.launch.py")

    class Exited:
        returncode = 2

    with pytest.raises(RuntimeError, match="replay ended with status 2"):
        module.replayed(Exited(), None)
