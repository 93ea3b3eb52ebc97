"""A vehicle that no driver could hold runs as long as its numbers mean anything."""

import numpy as np
import pytest

from graph import Graph, outcome
from runs import recorded, run_directory
from yawdamp_ros import linear_model, load_vehicle
from yawdamp_ros.analysis import growth
from yawdamp_ros.cli import run

SWAYING = [
    "units.1.axles.0.cornering_stiffness=40000",
    "units.1.axles.1.cornering_stiffness=40000",
    "units.2.axles.0.position=0.5",
    "units.2.axles.1.position=-0.2",
]
SKIDDING = ["units.0.axles.1.cornering_stiffness=50000", "units.0.axles.2.cornering_stiffness=50000"]


def test_the_growing_mode_is_named() -> None:
    assert growth(linear_model(load_vehicle("interlink"))) == ""
    swaying = linear_model(load_vehicle("interlink", SWAYING))
    found = growth(swaying)
    fastest = max(np.linalg.eigvals(swaying.state_matrix), key=lambda value: value.real)
    assert f"doubles every {np.log(2.0) / fastest.real:.3g} s" in found
    assert "trailer_2" in found


@pytest.mark.graph
@pytest.mark.parametrize("changes", [SKIDDING, SWAYING])
def test_an_unstable_vehicle_is_warned_of_and_stopped_before_it_means_nothing(
    graph: Graph, changes: list[str]
) -> None:
    settings = [word for change in changes for word in ("--set", change)]
    status, output, errors = outcome(graph.command("sim", "--manoeuvre", "pulse", *settings))
    assert status == 1
    assert "is unstable at 22.2222 m/s" in errors
    assert "doubles every" in errors
    assert "where the model means nothing" in output
    assert "Traceback" not in errors
    found = run_directory(graph.directory)
    messages = recorded(found)
    for unit in ("truck", "trailer_1", "trailer_2"):
        accelerations = [message.linear_acceleration.y for _, message in messages[f"/{unit}/imu"]]
        assert np.abs(accelerations).max() <= 100.0
    joints = [message.position for _, message in messages["/joint_states"]]
    assert np.abs(joints).max() <= 3.14
    assert run(["resimulate", str(found)]) == 0


@pytest.mark.graph
def test_a_limit_of_ones_own_stops_a_stable_vehicle_too(graph: Graph) -> None:
    limit = ["--ros-args", "-p", "max_lateral_acceleration:=3.0"]
    status, output, _ = outcome(graph.command("sim", "--manoeuvre", "lane_change", *limit))
    assert status == 1
    assert "past 3, where the model means nothing" in output
    messages = recorded(run_directory(graph.directory))["/truck/imu"]
    assert 2.9 < max(abs(message.linear_acceleration.y) for _, message in messages) <= 3.0
