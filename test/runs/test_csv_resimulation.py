"""Runs repeated elsewhere differ by rounding, however many units there are."""

import os
import platform
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from random_vehicles import made_up
from yawdamp_ros import linear_model
from yawdamp_ros.dynamics import LinearModel
from yawdamp_ros.runs.csv_resimulation import TOLERANCE, first_mismatch
from yawdamp_ros.stepping import Response, TimeGrid
from yawdamp_ros.stepping.response import respond

VEHICLES, STEPS = 1000, 1000
GRID = TimeGrid.of(0.005, 0.005)


def stable_models() -> list[LinearModel]:
    """Random stable vehicles of 1 to 12 units, with the axles of trailers behind their centres of gravity."""
    generator, found = np.random.default_rng(5), []
    while len(found) < VEHICLES:
        vehicle = made_up(generator, (1, 12))
        units = [
            replace(
                unit,
                axles=tuple(
                    replace(axle, position=-abs(axle.position)) if not axle.steered else axle
                    for axle in unit.axles
                ),
            )
            for unit in vehicle.units
        ]
        model = linear_model(replace(vehicle, units=tuple(units)))
        # Not at the very edge, so that every build finds the same ones.
        if np.linalg.eigvals(model.state_matrix).real.max() < -1e-6:
            found.append(model)
    return found


def responses() -> list[Response]:
    angles = 0.03 * np.sin(0.012 * np.arange(STEPS))
    return [respond(model, angles, GRID) for model in stable_models()]


@pytest.mark.skipif(platform.machine() != "x86_64", reason="these kernels are of x86-64")
def test_1000_stable_vehicles_agree_with_other_blas_kernels(tmp_path: Path) -> None:
    other = tmp_path / "other.npy"
    environment = {
        **os.environ,
        "OPENBLAS_CORETYPE": "Prescott",
        "PYTHONPATH": str(Path(__file__).parents[1]),
    }
    subprocess.run([sys.executable, __file__, str(other)], check=True, env=environment)
    with other.open("rb") as file:
        elsewhere = [np.load(file) for _ in range(VEHICLES)]
    here = responses()
    parted = 0
    for response, values in zip(here, elsewhere, strict=True):
        units = len(response.unit_names)
        yaw, yaw_rate, acceleration, articulation = np.split(values, [units, 2 * units, 3 * units], axis=1)
        repeated = replace(
            response, yaw=yaw, yaw_rate=yaw_rate, lateral_acceleration=acceleration, articulation=articulation
        )
        assert first_mismatch(response, repeated, TOLERANCE) is None
        parted += first_mismatch(response, repeated, 0.0) is not None
    assert parted > VEHICLES / 2  # they are other kernels


def test_a_difference_of_more_than_that_is_found() -> None:
    model = stable_models()[0]
    response = respond(model, 0.03 * np.sin(0.012 * np.arange(STEPS)), GRID)
    changed = response.yaw_rate.copy()
    changed[100, -1] += 3.0 * TOLERANCE * np.abs(changed).max()
    found = first_mismatch(response, replace(response, yaw_rate=changed), TOLERANCE)
    assert (found.time, found.quantity) == (0.5, "yaw_rate")


if __name__ == "__main__":
    with Path(sys.argv[1]).open("wb") as opened:
        for each in responses():
            parts = each.yaw, each.yaw_rate, each.lateral_acceleration, each.articulation
            np.save(opened, np.hstack(parts))
