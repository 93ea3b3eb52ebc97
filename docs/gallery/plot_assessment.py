"""
A verdict in a notebook
=======================

The interlink against the levels of the Australian PBS scheme and of RTAC, rearward amplification of four
combinations over speed, and how far back the second trailer may be loaded.
"""

import matplotlib.pyplot as plt
import numpy as np

from yawdamp_ros import linear_model, load_vehicle
from yawdamp_ros.analysis import MEASURES, assess

interlink = load_vehicle("interlink")
for finding in assess(interlink, srt=0.35):
    value = "none" if finding.value is None else f"{finding.value:.3f}"
    verdict = {True: "pass", False: "FAIL", None: ""}[finding.passed]
    print(f"{finding.measure.name:40} {value:>8} {finding.measure.unit:11} {verdict}")

# %%
# Rearward amplification over speed, for four combinations. The level of RTAC is 2.2.

figure, axes = plt.subplots(layout="constrained", figsize=(8, 5))
speeds = np.linspace(15.0, 30.0, 16)
amplification = MEASURES["rearward_amplification"]
for name in ("tractor_semitrailer", "interlink", "nordic_combination", "a_double"):
    values = [amplification.value(linear_model(load_vehicle(name), speed)) for speed in speeds]
    axes.plot(3.6 * speeds, values, label=name)
axes.axhline(2.2, color="0.5", linestyle="--", label="RTAC")
axes.set(xlabel="speed [km/h]", ylabel="rearward amplification")
axes.legend()

# %%
# Load the second trailer further back. In this file 80 % of its mass is the load.

from pathlib import Path

import yawdamp_ros

docs = Path(yawdamp_ros.__file__).parents[1] / "docs"
offtracking = MEASURES["high_speed_transient_offtracking"]
positions = np.linspace(-3.0, 1.0, 9)
values = []
for position in positions:
    loaded = load_vehicle(docs / "interlink_payload.yaml", [f"units.2.load.0.position={position}"])
    values.append(offtracking.value(linear_model(loaded, offtracking.speed)))
figure, axes = plt.subplots(layout="constrained", figsize=(8, 4))
axes.plot(positions, values, marker="o")
axes.axhline(0.6, color="0.5", linestyle="--", label="PBS level 1")
axes.set(xlabel="position of the load [m], forward positive", ylabel="offtracking [m]", ylim=(0.0, 0.7))
axes.legend()
