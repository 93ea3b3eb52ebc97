from pathlib import Path

import numpy as np
import pytest

from yawdamp_ros import load_vehicle, simulate
from yawdamp_ros.cli import run
from yawdamp_ros.logs import LogError
from yawdamp_ros.manoeuvres import Step
from yawdamp_ros.runs.response_recording import read_response_recording


def test_a_recorded_run_reads_back_as_the_response_that_it_is(tmp_path: Path) -> None:
    path = tmp_path / "run"
    # Twelve seconds of turning: the heading passes half a turn, where a quaternion starts anew.
    options = ["--vehicle", "truck_trailer", "--duration", "12", "--output", str(path)]
    assert run(["simulate", "--manoeuvre", "step", *options]) == 0
    read = read_response_recording(path)
    expected = simulate(load_vehicle("truck_trailer"), Step(), 12.0, sample_period=0.01)
    assert read.unit_names == expected.unit_names
    assert expected.yaw.max() > np.pi
    np.testing.assert_allclose(read.yaw, expected.yaw, atol=1e-12)
    for field in ("time", "steering_angle", "yaw_rate", "lateral_acceleration", "articulation", "x", "y"):
        np.testing.assert_array_equal(getattr(read, field), getattr(expected, field))


def test_a_recording_without_a_run_is_refused(tmp_path: Path) -> None:
    (tmp_path / "empty.mcap").write_bytes(b"\x89MCAP0\r\n")
    with pytest.raises(LogError, match=r"empty.mcap: no run: expected joint_states"):
        read_response_recording(tmp_path / "empty.mcap")
