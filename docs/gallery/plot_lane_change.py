"""
A lane change of the interlink
==============================

One sine of steering moves a truck with two trailers sideways by about a lane. Each unit swings a little more
than the one before it: that is rearward amplification.
"""

import matplotlib.pyplot as plt
import numpy as np

from yawdamp_ros import load_vehicle, simulate
from yawdamp_ros.manoeuvres import LaneChange

interlink = load_vehicle("interlink")
response = simulate(interlink, LaneChange(amplitude=0.02), 15.0, sample_period=0.01)

figure, (path, acceleration) = plt.subplots(2, layout="constrained", figsize=(8, 6))
for unit, name in enumerate(response.unit_names):
    path.plot(response.x[:, unit], response.y[:, unit], label=name)
    acceleration.plot(response.time, response.lateral_acceleration[:, unit], label=name)
path.set(xlabel="x [m]", ylabel="y [m]", title="Path of each centre of gravity")
acceleration.set(xlabel="time [s]", ylabel="lateral acceleration [m/s²]")
path.legend()

# %%
# The largest lateral acceleration of each unit:

peaks = np.abs(response.lateral_acceleration).max(axis=0)
for name, peak in zip(response.unit_names, peaks, strict=True):
    print(f"{name}: {peak:.2f} m/s²")
