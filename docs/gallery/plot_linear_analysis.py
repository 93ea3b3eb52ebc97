"""
Linear analysis in a notebook
=============================

Modes, transfer functions and measures of the A-double, from the vehicle file to a Bode diagram.
"""

import matplotlib.pyplot as plt
import numpy as np

from yawdamp_ros import linear_model, load_vehicle
from yawdamp_ros.analysis import modes, transfer_function

a_double = load_vehicle("a_double")
model = linear_model(a_double)
for mode in modes(model):
    print(f"{mode.eigenvalue:.3f}  damping ratio {mode.damping_ratio:.3f}")

# %%
# The model is a plain state space. How does each unit's lateral acceleration answer to steering?

frequencies = np.geomspace(0.05, 4.0, 300)
figure, (gain, phase) = plt.subplots(2, sharex=True, layout="constrained", figsize=(8, 6))
for unit in a_double.unit_names:
    transfer = transfer_function(model, f"{unit}/lateral_acceleration")
    response = np.array([transfer(2j * np.pi * frequency) for frequency in frequencies])
    gain.loglog(frequencies, np.abs(response), label=unit)
    phase.semilogx(frequencies, np.degrees(np.unwrap(np.angle(response))))
gain.set(ylabel="gain [m/s² per rad]")
phase.set(xlabel="frequency [Hz]", ylabel="phase [°]")
gain.legend()

# %%
# Which axle matters most? Reduce the stiffness of each unit's axles by a tenth and look at the damping.

from yawdamp_ros.analysis import least_damping_ratio

print(f"as it is: {least_damping_ratio(model):.4f}")
for index, unit in enumerate(a_double.units):
    changes = [
        f"units.{index}.axles.{axle}.cornering_stiffness={0.9 * each.cornering_stiffness}"
        for axle, each in enumerate(unit.axles)
    ]
    softer = linear_model(load_vehicle("a_double", changes))
    print(f"{unit.name} 10 % softer: {least_damping_ratio(softer):.4f}")
