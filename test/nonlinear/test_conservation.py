"""Without tyres nothing is lost."""

from dataclasses import replace

import numpy as np

from nonlinear_cases import PLANAR, motion
from yawdamp_ros.nonlinear import NonlinearDynamics, Settings
from yawdamp_ros.vehicle import STANDARD_GRAVITY, Vehicle, complete, load_vehicle, static_loads

A_DOUBLE = load_vehicle("a_double")
UNBOUND = replace(A_DOUBLE, units=tuple(replace(unit, max_articulation=1e3) for unit in A_DOUBLE.units))


def centres(vehicle: Vehicle, state: np.ndarray, *, roll: bool) -> np.ndarray:
    """Places of the centres of gravity by complex numbers; rows of x, y and height above the roll axis."""
    count = len(vehicle.units)
    start = 4 + 2 * count
    lean = np.sin(state[start : start + count]) if roll else np.zeros(count)
    upright = np.cos(state[start : start + count])
    heading, x, y = state[2], state[0], state[1]
    found = []

    def move(forward: complex, left: complex) -> None:
        nonlocal x, y
        x = x + np.cos(heading) * forward - np.sin(heading) * left
        y = y + np.sin(heading) * forward + np.cos(heading) * left

    for index, unit in enumerate(vehicle.units):
        if index:
            ahead = vehicle.units[index - 1]
            move(ahead.rear_hitch, -(ahead.hitch_height - ahead.roll_axis_height) * lean[index - 1])
            heading = heading - state[2 + index]
            move(-unit.front_hitch, (ahead.hitch_height - unit.roll_axis_height) * lean[index])
        x_ground, y_ground = x, y
        arm = unit.cg_height - unit.roll_axis_height
        move(0.0, -arm * lean[index])
        found.append((x, y, arm * upright[index]))
        x, y = x_ground, y_ground
    return np.array(found)


def conserved(dynamics: NonlinearDynamics, state: np.ndarray) -> tuple[float, np.ndarray, float]:
    """Energy, momentum and angular momentum, from velocities by a complex step along the motion."""
    full, roll = complete(dynamics.vehicle), dynamics.settings.roll
    rates = dynamics.derivatives(state, dynamics.inputs(friction=0.0))
    velocity = centres(full, state + 1e-30j * rates, roll=roll).imag / 1e-30
    place = centres(full, state.astype(complex), roll=roll).real
    layout = dynamics.layout
    mass = np.array([unit.mass for unit in full.units])
    yaw_inertia = np.array([unit.yaw_inertia for unit in full.units])
    roll_inertia = np.array([unit.roll_inertia for unit in full.units])
    yaw_rate, angle, roll_rate = state[layout.yaw_rate], state[layout.roll], state[layout.roll_rate]
    energy = 0.5 * (mass @ (velocity[:, :2] ** 2).sum(axis=1) + yaw_inertia @ yaw_rate**2)
    if roll:
        energy += 0.5 * (mass @ velocity[:, 2] ** 2 + roll_inertia @ roll_rate**2)
        energy += STANDARD_GRAVITY * mass @ place[:, 2]
        loads = static_loads(full)
        for index, unit in enumerate(full.units):
            energy += 0.5 * sum(axle.roll_stiffness for axle in unit.axles) * angle[index] ** 2
            if index + 1 < len(full.units):
                behind, load = full.units[index + 1], loads[index + 1].front_hitch
                twist = angle[index] - angle[index + 1] * np.cos(state[3 + index])
                energy += 0.5 * unit.hitch_roll_stiffness * twist**2
                energy += load * (unit.hitch_height - unit.roll_axis_height) * np.cos(angle[index])
                energy -= load * (unit.hitch_height - behind.roll_axis_height) * np.cos(angle[index + 1])
    momentum = mass @ velocity[:, :2]
    angular = mass @ (place[:, 0] * velocity[:, 1] - place[:, 1] * velocity[:, 0]) + yaw_inertia @ yaw_rate
    return float(energy), momentum, float(angular)


def test_a_chain_on_ice_keeps_energy_and_momenta_over_a_minute() -> None:
    dynamics = NonlinearDynamics(UNBOUND, PLANAR)
    layout = dynamics.layout
    start = dynamics.initial_state(10.0)
    start[layout.velocity.start + 1] = 1.0
    start[layout.yaw_rate] = 0.1, -0.05, 0.12, 0.02
    start[layout.articulation] = 0.3, -0.4, 0.2
    inputs = dynamics.inputs(friction=0.0)
    end = motion(dynamics, start, np.array([0.0, 60.0]), lambda _: inputs, tolerance=1e-13)[-1]
    assert np.abs(end[layout.articulation]).max() > 0.5, "it turned"
    before, after = conserved(dynamics, start), conserved(dynamics, end)
    assert abs(after[0] / before[0] - 1.0) < 1e-10
    assert np.abs(after[1] - before[1]).max() < 1e-10 * np.abs(before[1]).max()
    assert abs(after[2] / before[2] - 1.0) < 1e-10


def test_rolling_units_keep_them_too_where_springs_only_store() -> None:
    units = tuple(
        replace(
            unit, hitch_roll_damping=0.0, axles=tuple(replace(axle, roll_damping=0.0) for axle in unit.axles)
        )
        for unit in UNBOUND.units
    )
    settings = Settings(load_shift=False, rolling_resistance=False, drag=False)
    dynamics = NonlinearDynamics(replace(UNBOUND, units=units), settings)
    layout = dynamics.layout
    start = dynamics.initial_state(10.0)
    start[layout.yaw_rate] = 0.1, -0.05, 0.12, 0.02
    start[layout.articulation] = 0.3, -0.4, 0.2
    start[layout.roll] = 0.02, -0.03, 0.01, 0.02
    inputs = dynamics.inputs(friction=0.0)
    end = motion(dynamics, start, np.array([0.0, 3.0]), lambda _: inputs, tolerance=1e-13)[-1]
    assert np.abs(end[layout.roll] - start[layout.roll]).max() > 0.005, "it rolled"
    before, after = conserved(dynamics, start), conserved(dynamics, end)
    assert abs(after[0] / before[0] - 1.0) < 1e-12
    assert np.abs(after[1] - before[1]).max() < 1e-12 * np.abs(before[1]).max()
    assert abs(after[2] / before[2] - 1.0) < 1e-11
