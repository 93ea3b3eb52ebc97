"""How long a sweep for stability takes, over one eigvals call on the same stacked matrices."""

import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from yawdamp_ros.analysis.study import Study, draw, evaluate_all
from yawdamp_ros.dynamics.consistent import state_space
from yawdamp_ros.vehicle import load_stack, vehicle_text

COUNT, REPETITIONS = 100_000, 5
SPANS = {
    "units.0.axles.1.cornering_stiffness": (1e5, 6e5),
    "units.1.mass": (4e3, 36e3),
    "units.2.front_hitch": (2.0, 6.0),
    "speed": (10.0, 40.0),
}


def seconds(work: Callable[[], object]) -> float:
    """Median time of several runs, in s."""
    taken = []
    for _ in range(REPETITIONS):
        start = time.perf_counter()
        work()
        taken.append(time.perf_counter() - start)
    return statistics.median(taken)


def main() -> None:
    """Measure, and print the ratios."""
    text = vehicle_text("interlink")
    study = Study(text, "interlink", (), "consistent", tuple((key,) for key in SPANS))
    points = draw(list(SPANS.values()), COUNT, seed=0)
    stack = load_stack(text, "interlink", (), dict(zip(SPANS, points.T, strict=True)))
    matrices, _ = state_space(stack, stack.speed)
    eigvals = seconds(lambda: np.linalg.eigvals(matrices))
    print(f"eigvals of {COUNT} stacked matrices  {eigvals:.3f} s")
    sweep = seconds(lambda: list(evaluate_all(study, points)))
    print(f"the sweep                            {sweep:.3f} s  ({sweep / eigvals:.2f} times)")

    def command() -> None:
        with tempfile.TemporaryDirectory() as directory:
            ranges = [f"--range={key}={low}:{high}" for key, (low, high) in SPANS.items()]
            output = Path(directory) / "sweep.csv"
            arguments = [f"--random={COUNT}", *ranges, f"--output={output}"]
            subprocess.run(  # noqa: S603 - this package's own command
                [sys.executable, "-m", "yawdamp_ros", "sweep", *arguments],
                check=True,
                stdout=subprocess.DEVNULL,
            )

    whole = seconds(command)
    print(f"the command, start and CSV included  {whole:.3f} s  ({whole / eigvals:.2f} times)")


if __name__ == "__main__":
    main()
