"""The walk through an assessment comes to its verdicts."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_verdicts_are_those_of_the_exit_status() -> None:
    for vehicle, status in (("docs/interlink_payload.yaml", 0), ("a_double", 1)):
        command = [sys.executable, "-m", "yawdamp_ros", "assess", "--vehicle", vehicle, "--srt", "0.35"]
        assert subprocess.run(command, cwd=ROOT, capture_output=True, check=False).returncode == status
