"""Control steps in process: a controller at 100 Hz on a rig of 1 kHz, as an environment takes them."""

import math
import time
from pathlib import Path

from rows import Row
from yawdamp_ros.simulation import SimParameters
from yawdamp_ros.simulation.plant import Plant

STEPS = 2000
ROUNDS = 5
WANTED = {"consistent": 5000.0, "nonlinear": 2000.0}
"""Steps a second by model, on one core."""


def rate(plant: Plant) -> float:
    """Control steps for each second of the processor."""
    last = f"{plant.vehicle.unit_names[-1]}/yaw_moment"
    moments = last in plant.commands.held
    begun = time.process_time()
    for step in range(STEPS):
        inputs = {"steering": 0.02 * math.sin(0.01 * step)}
        if moments:
            inputs[last] = 1e4 * math.sin(0.02 * step)
        plant.step(inputs)
    return STEPS / (time.process_time() - begun)


def of_plants(_: Path) -> list[Row]:
    """Control steps of the interlink, by model."""
    rows = []
    for model, wanted in WANTED.items():
        source = "acceleration" if model == "nonlinear" else "parameter"
        plant = Plant(SimParameters(model=model, longitudinal_source=source, speed=15.0))
        rate(plant)
        rates = [rate(plant) for _ in range(ROUNDS)]
        what = f"control steps in process, the interlink, {model}"
        rows.append(Row(what, f"{wanted:.0f} a second", rates, [wanted] * ROUNDS, "Hz", ">= 1"))
    return rows
