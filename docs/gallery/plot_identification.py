"""
Identify a vehicle from a drive
===============================

A drive that was made with 0.85 times the cornering stiffness of the vehicle file, and with sensors that have
offsets and noise. What does it say about the vehicle?
"""

from pathlib import Path

import matplotlib.pyplot as plt

import yawdamp_ros
from yawdamp_ros import load_drive
from yawdamp_ros.drives import identify
from yawdamp_ros.vehicle import VehicleSource, vehicle_text

docs = Path(yawdamp_ros.__file__).parents[1] / "docs"
drive = load_drive(docs / "recorded_drive.csv").steered_by(18.0)
print("\n".join(drive.described()))

# %%
# Fit the stiffness, the yaw inertia and the steering offset. The truth is 0.85, 1 and 0.0039 rad.

found = identify(drive, VehicleSource(vehicle_text("truck_trailer"), ()))
for estimate in found.estimates:
    print(f"{estimate.parameter.name:30} {estimate.value:10.4g}  {estimate.low:.4g} to {estimate.high:.4g}")

# %%
# The fit used two thirds of the drive. On the rest, measured yaw rate of the trailer less the simulated one,
# with the numbers of the file and with those of the fit:

output = "trailer/yaw_rate"
before = next(each for each in found.before if each.output == output)
after = next(each for each in found.checked if each.output == output)
figure, (signal, error) = plt.subplots(2, sharex=True, layout="constrained", figsize=(8, 6))
signal.plot(after.times, after.measured, color="0.7", label="measured, less the identified offset")
signal.plot(after.times, after.simulated, label="identified vehicle")
error.plot(before.times, before.measured - before.simulated, label=f"vehicle file, R² {before.r_squared:.2f}")
error.plot(after.times, after.measured - after.simulated, label=f"identified, R² {after.r_squared:.2f}")
signal.set(ylabel="yaw rate [rad/s]")
error.set(xlabel="time [s]", ylabel="error [rad/s]")
signal.legend()
error.legend()

# %%
# Do the estimates depend on each other? Stiffness and the delay of the steering do; inertia stands alone.

figure, axes = plt.subplots(layout="constrained", figsize=(6, 5))
image = axes.imshow(found.correlations, cmap="RdBu", vmin=-1.0, vmax=1.0)
names = [estimate.parameter.name for estimate in found.estimates]
axes.set_xticks(range(len(names)), names, rotation=60, ha="right", fontsize=7)
axes.set_yticks(range(len(names)), names, fontsize=7)
figure.colorbar(image, label="correlation")
