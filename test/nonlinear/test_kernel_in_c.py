"""The kernel in C that the benchmark measures against computes the same motion."""

import sys
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

from yawdamp_ros.nonlinear import NonlinearDynamics
from yawdamp_ros.vehicle import load_vehicle

BENCH = Path(__file__).parents[2] / "bench"


def test_it_takes_the_same_steps(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "path", [str(BENCH), *sys.path])
    dynamics = NonlinearDynamics(load_vehicle("interlink"))
    by_hand = import_module("compiled_c").compiled_steps(dynamics, tmp_path)
    if by_hand is None:
        pytest.skip("no gcc")
    state, inputs = dynamics.initial_state(22.0), dynamics.inputs(0.05, acceleration=0.3)
    expected = dynamics.steps(state, inputs, 0.001, 2000, 2000).states[-1]
    by_hand(state, inputs, 0.001, 2000)
    np.testing.assert_allclose(state, expected, rtol=1e-9, atol=1e-9)
