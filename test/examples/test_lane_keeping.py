import re
import subprocess
import sys
from pathlib import Path

import pytest

from graph import Graph, stop
from runs import recorded, run_directory

pytestmark = pytest.mark.graph

EXAMPLE = Path(__file__).parents[2] / "examples" / "lane_keeping.py"


def test_the_prototype_keeps_the_truck_on_its_path(graph: Graph) -> None:
    node = graph.command("sim")
    picture = graph.directory / "lane_keeping.png"
    shown = subprocess.run(
        [sys.executable, str(EXAMPLE), "--output", str(picture)],
        env=graph.environment,
        cwd=graph.directory,
        check=True,
        capture_output=True,
        text=True,
        timeout=90,
    ).stdout
    assert stop(node)[0] == 0
    worst, last = map(float, re.findall(r"([-+]?\d+\.\d+) m", shown))
    # A truck that is not steered ends 3.5 m beside the path.
    assert worst < 0.8
    assert abs(last) < 0.2
    assert picture.read_bytes().startswith(b"\x89PNG")
    odometry = [
        message.pose.pose.position for _, message in recorded(run_directory(graph.directory))["/truck/odom"]
    ]
    assert odometry[-1].y == pytest.approx(3.5, abs=0.3)
