"""
Jackknife, trailer swing and rollover
=====================================

Three ways in which a combination is lost. Linear theory shows none of them: its tyres never saturate, its
wheels never lock, and it has no height.

A tractor and its semitrailer turn on a slippery road, friction 0.3, and brake. What happens depends on which
axle locks.
"""

import matplotlib.pyplot as plt
import numpy as np

from yawdamp_ros import load_vehicle
from yawdamp_ros.simulation import make_motion
from yawdamp_ros.stepping import AppliedInput, Sample

STEP = 0.001
BRAKES_AFTER = 200
"""Periods of ten steps."""


def brake_in_a_turn(shares: tuple[float, float, float], *, anti_lock: bool) -> list[Sample]:
    """Steer into a turn, then brake; shares are of the steer, the drive and the trailer axle."""
    steer, drive, trailer = shares
    changes = [
        f"units.0.axles.0.brake_share={steer}",
        f"units.0.axles.1.brake_share={drive}",
        f"units.1.axles.0.brake_share={trailer}",
        *(f"units.{unit}.abs={str(anti_lock).lower()}" for unit in (0, 1)),
    ]
    motion = make_motion(load_vehicle("truck_trailer", changes), "nonlinear", 15.0, STEP)
    motion.apply(AppliedInput(0, "friction", 0.3))
    samples = [motion.sample()]
    for period in range(600):
        if period == BRAKES_AFTER:
            motion.apply(AppliedInput(motion.step, "acceleration", -3.5))
        angle = min(0.02, 0.02 * period / 100)
        samples.append(motion.run([angle] * 10))
    return samples


runs = {
    "drive axle locks: jackknife": brake_in_a_turn((0.1, 1.0, 0.1), anti_lock=False),
    "trailer axle locks: trailer swing": brake_in_a_turn((0.1, 0.1, 1.0), anti_lock=False),
    "with ABS: neither": brake_in_a_turn((0.6, 1.0, 1.0), anti_lock=True),
}
for name, samples in runs.items():
    print(name)
    for sample in samples:
        for event in sample.events:
            print(f"  {event.step * STEP:.2f} s: {event.name} of {event.where}")

# %%
# The units every half second, seen from above, and the articulation.

figure, axes = plt.subplots(3, 2, layout="constrained", figsize=(11, 7), width_ratios=(2.2, 1))
vehicle = load_vehicle("truck_trailer")
ends = [(1.4 + 2.062, -2.723 - 1.0), (7.483 + 1.2, -3.76 - 1.0)]
for (above, beside), (name, samples) in zip(axes, runs.items(), strict=True):
    for sample in samples[200::50]:
        for unit, (front, rear) in enumerate(ends):
            centre = sample.x[unit] + 1j * sample.y[unit]
            line = centre + np.array([front, rear]) * sample.heading[unit]
            above.plot(line.real, line.imag, color=f"C{unit}", linewidth=3, alpha=0.6)
    above.set(title=name, aspect="equal", xlabel="x [m]", ylabel="y [m]", xlim=(10, 85), ylim=(-2, 16))
    time = [float(sample.step) * STEP for sample in samples]
    beside.plot(time, np.degrees([sample.articulation[0] for sample in samples]))
    beside.set(xlabel="time [s]", ylabel="articulation [°]", ylim=(-100, 100))

# %%
# Rollover needs grip, not the lack of it. The A-double changes lanes on a dry road with the steering of the
# report.

from yawdamp_ros import simulate
from yawdamp_ros.manoeuvres import LaneChange

response = simulate(load_vehicle("a_double"), LaneChange(), 15.0, sample_period=0.01, model="nonlinear")
for event in response.events:
    print(f"{event.step * STEP:.2f} s: {event.name} of {event.where}")

figure, (ratio, roll) = plt.subplots(2, sharex=True, layout="constrained", figsize=(8, 5))
for unit, name in enumerate(response.unit_names):
    ratio.plot(response.time, response.extra["load_transfer_ratio"][:, unit], label=name)
    roll.plot(response.time, np.degrees(response.extra["roll"][:, unit]))
ratio.set(ylabel="load transfer ratio")
roll.set(xlabel="time [s]", ylabel="roll [°]")
ratio.legend()
