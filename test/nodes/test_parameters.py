import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
import rclpy
from rclpy.node import Node
from rclpy.parameter import Parameter

from yawdamp_ros.nodes.errors import NodeError
from yawdamp_ros.nodes.parameters import (
    changed,
    declare_derived,
    declare_parameters,
    parameter_descriptor,
)
from yawdamp_ros.simulation.settings import FORMER_NAMES, PARAMETERS, SimParameters


def asked(**values: object) -> list[Parameter]:
    return [Parameter(name, value=value) for name, value in values.items()]


@contextmanager
def node_given(*arguments: str) -> Iterator[Node]:
    """A node that was started with some arguments after --ros-args."""
    context = rclpy.Context()
    context.init(args=["--ros-args", *arguments])
    node = Node("yawdamp_sim", context=context, automatically_declare_parameters_from_overrides=True)
    try:
        yield node
    finally:
        node.destroy_node()
        context.try_shutdown()


def test_what_may_change_changes() -> None:
    new = changed(SimParameters(), asked(speed=18.0, max_steering_angle=0.3))
    assert (new.speed, new.max_steering_angle) == (18.0, 0.3)
    assert changed(SimParameters(), asked(use_sim_time=True)) == SimParameters()


@pytest.mark.parametrize(
    "values, said",
    [
        ({"speed": 18}, "parameter speed: 18: expected a double, write 18.0"),
        ({"speed": 400.0}, "parameter speed: 400.0: expected a number from"),
        ({"speed": math.nan}, "parameter speed: nan: expected a number from"),
        ({"speed": 0.0}, "speed: 0.0: model consistent cannot stand .* leave it out for the vehicle's own"),
        ({"longitudinal_source": "acceleration"}, "expected model nonlinear"),
        ({"on_steering_timeout": "panic"}, "on_steering_timeout: 'panic': expected one of hold, zero"),
        ({"real_time_factor": 0.05}, "real_time_factor: 0.05: expected 0, or 0.1 to 100"),
        ({"record_directory": "/etc"}, "record_directory: '/etc': expected one below the working directory"),
        ({"record_directory": "a/../.."}, "expected one below the working directory"),
        ({"record_directory": "a\n"}, "expected one below the working directory"),
        ({"record_directory": "."}, "expected one below the working directory"),
        ({"record_directory": "./."}, "expected one below the working directory"),
        ({"record_directory": "a/" * 2000}, "expected one below the working directory"),
    ],
)
def test_a_change_that_cannot_be_is_refused_by_what_is_wrong_with_it(
    values: dict[str, object], said: str
) -> None:
    with pytest.raises(NodeError, match=said):
        changed(SimParameters(), asked(**values))


def test_a_directory_through_a_link_that_leads_out_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "out").symlink_to("/")
    assert changed(SimParameters(), asked(record_directory="runs/next")).record_directory == "runs/next"
    with pytest.raises(NodeError, match="below the working directory"):
        changed(SimParameters(), asked(record_directory="out/next"))


@pytest.mark.parametrize("name", PARAMETERS)
def test_a_descriptor_says_whether_how_far_and_to_what_a_parameter_may_change(name: str) -> None:
    declared = PARAMETERS[name]
    descriptor = parameter_descriptor(declared)
    assert descriptor.read_only is not declared.metadata["dynamic"]
    assert descriptor.description == declared.metadata["description"]
    default = getattr(SimParameters(), declared.name)
    if declared.metadata["kind"] in {int, float}:
        described = [*descriptor.floating_point_range, *descriptor.integer_range]
        # No range holds NaN: where a number may be NaN, its constraint is said in words.
        nan = default is not None and math.isnan(default)
        assert bool(descriptor.additional_constraints) if nan else len(described) == 1
    for choice in declared.metadata["choices"]:
        assert choice in descriptor.additional_constraints


@pytest.mark.graph
def test_the_manoeuvre_s_parameters_are_a_group() -> None:
    with node_given("-p", "manoeuvre.name:=sine", "-p", "manoeuvre.amplitude:=0.02") as node:
        settings = declare_parameters(node)
        assert settings.manoeuvre == "sine"
        assert settings.manoeuvre_settings == {"amplitude": 0.02}
        assert node.get_parameter("manoeuvre.amplitude").value == 0.02
        declare_derived(node, {"speed": 22.5, "initial_speed": 22.5, "publish_clock": settings.clock})
        assert set(PARAMETERS) <= set(node.get_parameters_by_prefix(""))


@pytest.mark.graph
def test_a_group_can_be_given_in_a_file_both_ways(tmp_path: Path) -> None:
    for text in ("manoeuvre: {name: ramp, width: 2.0}", "manoeuvre.name: ramp\n    manoeuvre.width: 2.0"):
        path = tmp_path / "file.yaml"
        path.write_text(f"/**:\n  ros__parameters:\n    {text}\n")
        with node_given("--params-file", str(path)) as node:
            settings = declare_parameters(node)
            assert (settings.manoeuvre, settings.width) == ("ramp", 2.0)


@pytest.mark.graph
def test_former_names_are_accepted_with_a_warning(capfd: pytest.CaptureFixture[str]) -> None:
    assert dict(FORMER_NAMES)["manoeuvre"] == "manoeuvre.name"
    with node_given("-p", "manoeuvre:=chirp", "-p", "sweep_time:=3.0") as node:
        settings = declare_parameters(node)
        assert (settings.manoeuvre, settings.sweep_time) == ("chirp", 3.0)
        assert not node.has_parameter("sweep_time")
        assert node.get_parameter("manoeuvre.sweep_time").value == 3.0
    errors = capfd.readouterr().err
    assert "parameter manoeuvre: renamed to manoeuvre.name" in errors
    assert "parameter sweep_time: renamed to manoeuvre.sweep_time" in errors


@pytest.mark.graph
@pytest.mark.parametrize(
    "given, said",
    [
        (["amplitude:=0.1", "manoeuvre.amplitude:=0.2"], "manoeuvre.amplitude is given as well"),
        (["manoeuvre.amplitud:=0.1"], "no such parameter; did you mean manoeuvre.amplitude?"),
        (["speeed:=20.0"], "parameter speeed: no such parameter; did you mean speed?"),
        (["publish_rate:=50"], "publish_rate: 50: expected a double, write 50.0"),
        (["manoeuvre.amplitude:=0.1"], "manoeuvre.amplitude: manoeuvre.name is none"),
    ],
)
def test_what_cannot_be_declared_is_refused_by_what_is_wrong_with_it(given: list[str], said: str) -> None:
    arguments = [word for parameter in given for word in ("-p", parameter)]
    with node_given(*arguments) as node, pytest.raises(NodeError) as raised:
        declare_parameters(node)
    assert said in str(raised.value)


@pytest.mark.graph
def test_a_speed_that_is_not_given_is_absent_until_the_vehicle_s_own_is_known() -> None:
    with node_given() as node:
        assert declare_parameters(node).speed is None
        assert not node.has_parameter("speed")
        declare_derived(node, {"speed": 22.5})
        assert node.get_parameter("speed").value == 22.5
        (described,) = node.describe_parameter("speed").floating_point_range
        assert described.to_value == 70.0


@pytest.mark.graph
@pytest.mark.parametrize("speed", ["0.0", "-3.0"])
def test_a_speed_of_0_is_refused_and_is_not_the_vehicle_s_own(speed: str) -> None:
    said = "model consistent cannot stand or reverse; expected at least 0.01 m/s"
    with node_given("-p", f"speed:={speed}") as node, pytest.raises(NodeError, match=said):
        declare_parameters(node)


def test_the_speed_of_the_topic_is_not_a_parameter_s_to_set() -> None:
    followed = SimParameters(speed=20.0, longitudinal_source="speed")
    assert followed.problem() == ""
    with pytest.raises(NodeError, match="publish there"):
        changed(followed, asked(speed=15.0))


@pytest.mark.parametrize(
    "given, factor, clock",
    [(None, 1.0, False), (None, 2.0, True), (None, 0.0, True), (False, 2.0, False), (True, 1.0, True)],
)
def test_the_clock_goes_out_where_simulated_time_is_not_real_time_unless_it_is_said(
    given: bool | None,  # noqa: FBT001 - a parameter of the node
    factor: float,
    clock: bool,  # noqa: FBT001
) -> None:
    assert SimParameters(publish_clock=given, real_time_factor=factor).clock is clock


@pytest.mark.graph
def test_a_namespace_is_the_prefix_of_the_frames_unless_another_is_given() -> None:
    with node_given("-r", "__ns:=/left") as node:
        assert declare_parameters(node).frame_prefix == "left/"
        assert node.get_parameter("frame_prefix").value == "left/"
    with node_given("-r", "__ns:=/left", "-p", "frame_prefix:=mine/") as node:
        assert declare_parameters(node).frame_prefix == "mine/"
    with node_given() as node:
        assert declare_parameters(node).frame_prefix == ""
