"""Vehicles, inputs and integration that the tests of the nonlinear model share."""

import csv
import json
import math
from collections.abc import Callable, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from yawdamp_ros.nonlinear import NonlinearDynamics, Settings
from yawdamp_ros.vehicle import MagicFormula
from yawdamp_ros.vehicle.tir import COEFFICIENTS

DATA = Path(__file__).parent / "data"

PLANAR = Settings(
    track=False,
    roll=False,
    load_shift=False,
    relaxation=False,
    rolling_resistance=False,
    drag=False,
    lowest_demand=-math.inf,
    highest_demand=math.inf,
)
"""The single-track chain with tyres that do not lag."""

UNLIMITED = 1e12
"""Friction without a limit."""


def numbers(name: str) -> Any:  # noqa: ANN401
    return json.loads((DATA / name).read_text(encoding="utf-8"))


def table(name: str) -> dict[str, np.ndarray]:
    with (DATA / name).open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {key: np.array([float(row[key]) for row in rows]) for key in rows[0]}


def magic_formula(**given: float) -> MagicFormula:
    """A magic formula of which all other coefficients are neutral."""
    return MagicFormula(
        "of a test", tuple(given.get(key, 1.0 if key.startswith("L") else 0.0) for key in COEFFICIENTS)
    )


def motion(  # noqa: PLR0913, PLR0917
    dynamics: NonlinearDynamics,
    start: np.ndarray,
    times: np.ndarray,
    inputs: Callable[[float], np.ndarray],
    corners: Sequence[float] = (),
    tolerance: float = 1e-11,
    method: str = "DOP853",
) -> np.ndarray:
    """States at times by SciPy, restarted where the inputs have a corner."""
    ends = [*sorted({float(times[0]), *(float(corner) for corner in corners), float(times[-1])})]
    state, found = start, []
    for begin, end in pairwise(ends):
        inside = times[(times >= begin) & (times < end)]
        run = solve_ivp(
            lambda t, y: dynamics.derivatives(y, inputs(t)),
            (begin, end),
            state,
            method,
            np.append(inside, end),
            rtol=tolerance,
            atol=tolerance,
        )
        assert run.success, run.message
        found.append(run.y.T[:-1])
        state = run.y[:, -1]
    return np.vstack([*found, state])


def deviation(found: np.ndarray, expected: np.ndarray) -> float:
    """Largest difference over the largest expected value."""
    return float(np.abs(found - expected).max() / np.abs(expected).max())
