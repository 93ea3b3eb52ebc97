"""Runs as the npm readers see them, on which browser tools are built."""

import json
import shutil
import subprocess
from pathlib import Path

import pytest

from yawdamp_ros.cli import run

SCRIPT = Path(__file__).parent / "npm"

pytestmark = pytest.mark.skipif(
    not (shutil.which("node") and shutil.which("npm")), reason="node and npm are not installed"
)


def test_the_npm_readers_decode_every_message(tmp_path: Path) -> None:
    project = shutil.copytree(SCRIPT, tmp_path / "npm", ignore=shutil.ignore_patterns("node_modules"))
    subprocess.run(["npm", "ci", "--silent"], cwd=project, check=True, timeout=100)
    step = ["simulate", "--manoeuvre", "step", "--start", "0", "--duration", "2", "--output"]
    for output in ("run", "run.csv"):
        assert run([*step, str(tmp_path / output)]) == 0
    shown = subprocess.run(
        ["node", "read_run.mjs", str(tmp_path / "run" / "run_0.mcap")],
        cwd=project,
        check=True,
        capture_output=True,
        text=True,
    )
    found = json.loads(shown.stdout)
    assert found["profile"] == "ros2"
    topics = found["topics"]
    assert {name: topic["count"] for name, topic in topics.items()} == {
        "/steering_applied": 1,
        "/speed": 1,
        "/joint_states": 201,
        "/tf": 201,
        "/tf_static": 1,
        **{
            f"/{unit}/{output}": 201
            for unit in ("truck", "trailer_1", "trailer_2")
            for output in ("imu", "odom", "yaw", "yaw_rate", "lateral_acceleration")
        },
    }
    header, *_, last = (tmp_path / "run.csv").read_text().splitlines()
    row = dict(zip(header.split(","), map(float, last.split(",")), strict=True))
    for unit in ("truck", "trailer_1", "trailer_2"):
        imu, odom = topics[f"/{unit}/imu"]["last"], topics[f"/{unit}/odom"]["last"]
        assert imu["header"]["stamp"]["sec"] == 2
        assert imu["angular_velocity"]["z"] == row[f"{unit}/yaw_rate"]
        assert imu["linear_acceleration"]["y"] == row[f"{unit}/lateral_acceleration"]
        assert odom["child_frame_id"] == unit
        assert topics[f"/{unit}/yaw"]["last"]["data"] == row[f"{unit}/yaw"]
    joints = topics["/joint_states"]["last"]
    assert joints["name"] == ["steering", "articulation_1", "articulation_2"]
    assert joints["position"] == [0.1, row["articulation_1"], row["articulation_2"]]
