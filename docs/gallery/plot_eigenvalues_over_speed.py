"""
Eigenvalues over speed
======================

A combination swings less damped the faster it drives. Every point is an eigenvalue of the interlink at one
speed; a point right of zero is a motion that grows.
"""

import matplotlib.pyplot as plt
import numpy as np

from yawdamp_ros import linear_model, load_vehicle

interlink = load_vehicle("interlink_quarter_stiffness")
speeds = np.linspace(5.0, 45.0, 81)
eigenvalues = np.array([np.linalg.eigvals(linear_model(interlink, speed).state_matrix) for speed in speeds])

figure, axes = plt.subplots(layout="constrained", figsize=(8, 5))
points = axes.scatter(
    eigenvalues.real.ravel(),
    eigenvalues.imag.ravel(),
    c=np.repeat(speeds, eigenvalues.shape[1]),
    s=8,
)
axes.axvline(0.0, color="0.6", linewidth=1)
axes.set(xlabel="real part [1/s]", ylabel="imaginary part [rad/s]", xlim=(-12, 2))
figure.colorbar(points, label="speed [m/s]")

# %%
# The lowest damping ratio at each of some speeds:

from yawdamp_ros.analysis import least_damping_ratio

for speed in (10.0, 20.0, 30.0, 40.0):
    ratio = least_damping_ratio(linear_model(interlink, speed))
    print(f"{speed:.0f} m/s: {ratio:.3f}")
