"""The nonlinear model of many vehicles in threads, and its step beside a kernel written by hand in C."""

import os
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

from compiled_c import compiled_steps
from rows import Row, by_turns
from yawdamp_ros.analysis.points import Draws
from yawdamp_ros.analysis.study import Study, evaluate_all
from yawdamp_ros.nonlinear import NonlinearDynamics
from yawdamp_ros.vehicle import load_vehicle, vehicle_text

VEHICLES = 100
STEPS = 12_000
"""Steps of a lane change of 12 s at 1 kHz."""
PRODUCTS = 20_000
CORES = 2


def of_fleets(directory: Path) -> list[Row]:
    """A fleet's lane changes, and single steps."""
    return [_lane_changes(), *_steps(directory)]


def product_time() -> float:
    """Time in s of one matrix-vector product of the size of a linear interlink, preallocated."""
    matrix, vector, result = np.random.default_rng(0).random((7, 7)), np.ones(7), np.empty(7)
    begin = time.perf_counter()
    for _ in range(PRODUCTS):
        np.dot(matrix, vector, out=result)
    return (time.perf_counter() - begin) / PRODUCTS


def _lane_changes() -> Row:
    """Rearward amplification of vehicles drawn at random, over the products that its steps may cost."""
    keys = (("units.1.front_hitch",), ("units.2.front_hitch",))
    study = Study(vehicle_text("interlink"), "interlink", (), "nonlinear", keys, "rearward_amplification")
    points = Draws([(2.0, 5.0), (2.0, 5.0)], VEHICLES, seed=0)
    study.evaluate(points[:1])  # whatever is still to be compiled

    def fleet() -> float:
        begin = time.perf_counter()
        with ThreadPoolExecutor(CORES) as executor:
            list(evaluate_all(study, points, executor.map))
        return (time.perf_counter() - begin) / VEHICLES

    value, reference = by_turns(fleet, lambda: product_time() * STEPS, 3)
    cores = min(CORES, os.cpu_count() or 1)
    what = f"a nonlinear lane change of 12 s at 1 kHz, one of {VEHICLES} in threads on {cores} cores"
    against = f"{STEPS:,} matrix-vector products"
    return Row(what, against, value, reference, "s", f"<= {30 / CORES:g}")


def _steps(directory: Path) -> list[Row]:
    dynamics = NonlinearDynamics(load_vehicle("interlink"))
    by_hand = compiled_steps(dynamics, directory)
    if by_hand is None:
        return []
    start, inputs = dynamics.initial_state(22.0), dynamics.inputs(0.02, speed=22.0)
    ours = dynamics.steps(start, inputs, 0.001, STEPS, STEPS).states[-1]
    theirs = start.copy()
    by_hand(theirs, inputs, 0.001, STEPS)
    np.testing.assert_allclose(theirs, ours, rtol=1e-9, atol=1e-9)

    def own() -> float:
        begin = time.perf_counter()
        dynamics.steps(start, inputs, 0.001, STEPS, STEPS)
        return (time.perf_counter() - begin) / STEPS

    def other() -> float:
        state = start.copy()
        begin = time.perf_counter()
        by_hand(state, inputs, 0.001, STEPS)
        return (time.perf_counter() - begin) / STEPS

    what = "one step of the nonlinear interlink, events noted"
    return [Row(what, "a kernel written by hand in C, by gcc", *by_turns(own, other, 11), "s", "<= 2")]
