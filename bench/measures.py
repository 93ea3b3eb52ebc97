"""Measures of 100,000 interlinks beside as many stacked eigenvalue problems."""

import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from threadpoolctl import threadpool_limits

from rows import Row
from yawdamp_ros.analysis import MEASURES
from yawdamp_ros.analysis.points import Draws
from yawdamp_ros.analysis.study import Study, evaluate_all
from yawdamp_ros.dynamics.consistent import state_space
from yawdamp_ros.vehicle import load_stack, vehicle_text

POINTS = 100_000
SPANS = {
    "units.0.axles.1.cornering_stiffness": (3e5, 6e5),
    "units.1.mass": (4e3, 36e3),
    "units.2.front_hitch": (2.0, 6.0),
}
CRITICAL = "critical_speed"


def of_stacks(_directory: Path) -> list[Row]:
    """Every measure, on one core; the eigenvalue problems before and after each."""
    text = vehicle_text("interlink")
    points = Draws(list(SPANS.values()), POINTS, seed=0)[:]
    stack = load_stack(text, "interlink", (), dict(zip(SPANS, points.T, strict=True)))
    matrices, _ = state_space(stack, stack.speed)
    rows = []
    with threadpool_limits(1):
        before = _seconds(lambda: np.linalg.eigvals(matrices))
        for name in MEASURES:
            study = Study(text, "interlink", (), "consistent", tuple((key,) for key in SPANS), name)
            took = _seconds(lambda study=study: [*evaluate_all(study, points)])
            after = _seconds(lambda: np.linalg.eigvals(matrices))
            wanted = "<= 400" if name == CRITICAL else "<= 120"
            what = f"`{name}` of {POINTS:,} interlinks"
            rows.append(Row(what, "stacked eigvals", [took], [before, after], "s", wanted))
            before = after
    return rows


def _seconds(work: Callable[[], object]) -> float:
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin
