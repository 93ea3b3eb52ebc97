import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given

from strategies import vehicles
from yawdamp_ros import linear_model, load_vehicle, simulate
from yawdamp_ros.dynamics import equations_of_motion
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.vehicle import Axle, Unit, Vehicle

OPENVD = json.loads((Path(__file__).parents[1] / "data" / "openvd_tractor_semitrailer.json").read_text())


def newton_euler(vehicle: Vehicle, speed: float) -> tuple[FloatArray, FloatArray]:
    """State and input matrix from free bodies: forces, moments and hitch forces, unit by unit.

    Unknowns are the lateral velocities' and yaw rates' derivatives of every unit and the lateral force in
    every hitch; the hitches' velocities are equal seen from both sides.
    """
    units, hitches = vehicle.units, vehicle.hitches
    n = len(units)
    states = 2 * n
    # Lateral velocity of every unit, in its own frame, by the state [v_1, r, theta].
    velocity = np.zeros((n, states))
    velocity[0, 0] = 1.0
    for k, (rear, front) in enumerate(hitches):
        velocity[k + 1] = velocity[k]
        velocity[k + 1, 1 + k] += rear
        velocity[k + 1, 2 + k] -= front
        velocity[k + 1, 1 + n + k] += speed
    left = np.zeros((3 * n - 1, 3 * n - 1))
    right = np.zeros((3 * n - 1, states))
    steering = np.zeros(3 * n - 1)
    for k, unit in enumerate(units):
        force, moment = 2 * k, 2 * k + 1
        left[force, k] = unit.mass
        left[moment, n + k] = unit.yaw_inertia
        right[force, 1 + k] -= unit.mass * speed
        for axle in unit.axles:
            slip = velocity[k] / speed
            slip[1 + k] += axle.position / speed
            right[force] -= axle.cornering_stiffness * slip
            right[moment] -= axle.cornering_stiffness * axle.position * slip
            if axle.steered:
                steering[force] += axle.cornering_stiffness
                steering[moment] += axle.cornering_stiffness * axle.position
    for k, (rear, front) in enumerate(hitches):
        hitch = 2 * n + k
        left[2 * k, hitch], left[2 * k + 1, hitch] = 1.0, rear
        left[2 * k + 2, hitch], left[2 * k + 3, hitch] = -1.0, -front
        left[hitch, [k, n + k, k + 1, n + k + 1]] = 1.0, rear, -1.0, -front
        right[hitch, [1 + k, 2 + k]] = -speed, speed
    rates = np.linalg.solve(left, right)
    by_steering = np.linalg.solve(left, steering)
    state_matrix = np.zeros((states, states))
    state_matrix[: n + 1] = rates[[0, *range(n, 2 * n)]]
    for k in range(n - 1):
        state_matrix[n + 1 + k, [1 + k, 2 + k]] = 1.0, -1.0
    input_matrix = np.zeros(states)
    input_matrix[: n + 1] = by_steering[[0, *range(n, 2 * n)]]
    return state_matrix, input_matrix


@given(vehicles())
def test_free_bodies_with_hitch_forces_give_the_same_matrices(vehicle: Vehicle) -> None:
    model = linear_model(vehicle)
    state_matrix, input_matrix = newton_euler(vehicle, vehicle.speed)
    scale = np.abs(state_matrix).max()
    np.testing.assert_allclose(model.state_matrix, state_matrix, rtol=1e-7, atol=1e-9 * scale)
    np.testing.assert_allclose(
        model.input_matrix, input_matrix, rtol=1e-7, atol=1e-9 * np.abs(input_matrix).max()
    )


@given(vehicles())
def test_mass_and_damping_are_symmetric_and_mass_is_positive(vehicle: Vehicle) -> None:
    motion = equations_of_motion(vehicle)
    np.testing.assert_allclose(motion.mass, motion.mass.T)
    np.testing.assert_allclose(motion.damping, motion.damping.T)
    assert np.linalg.eigvalsh(motion.mass).min() > 0.0


@given(vehicles())
def test_forces_do_not_depend_on_which_way_the_whole_combination_heads(vehicle: Vehicle) -> None:
    motion = equations_of_motion(vehicle)
    np.testing.assert_allclose(motion.stiffness.sum(axis=1), motion.damping[:, 0], rtol=1e-12)


@given(vehicles(min_units=2))
def test_in_a_steady_turn_all_units_turn_alike(vehicle: Vehicle) -> None:
    model = linear_model(vehicle)
    steady = np.linalg.solve(model.state_matrix, -model.input_matrix)
    yaw_rates = steady[1 : 1 + len(vehicle.units)]
    np.testing.assert_allclose(yaw_rates, yaw_rates[0], rtol=1e-6, atol=1e-9)
    outputs = model.output_matrix @ steady + model.feedthrough
    names = model.output_names
    for unit in vehicle.unit_names:
        acceleration = outputs[names.index(f"{unit}/lateral_acceleration")]
        assert acceleration == pytest.approx(vehicle.speed * yaw_rates[0], rel=1e-6, abs=1e-6)


@pytest.mark.parametrize(
    "name, expected",
    [
        ("single_vehicle", [-9.4275 + 6.5990j]),
        ("truck_trailer", [-4.03097 + 1.33835j, -2.08245 + 1.73774j]),
        ("interlink", [-4.77762 + 4.15810j, -3.32057 + 2.89114j, -1.80233 + 2.06468j]),
    ],
)
def test_eigenvalues_are_the_known_ones(name: str, expected: list[complex]) -> None:
    eigenvalues = np.linalg.eigvals(linear_model(load_vehicle(name)).state_matrix)
    found = sorted(eigenvalues[eigenvalues.imag > 0.0], key=lambda value: value.real)
    digits = 4 if name == "single_vehicle" else 5
    for part in (np.real, np.imag):
        np.testing.assert_allclose(part(found), part(expected), rtol=0.0, atol=0.5 * 10.0**-digits)
    assert len(eigenvalues) == 2 * len(expected)


def test_the_single_vehicle_has_the_known_steady_yaw_rate() -> None:
    model = linear_model(load_vehicle("single_vehicle"))
    steady = np.linalg.solve(model.state_matrix, -model.input_matrix)
    assert steady[1] == pytest.approx(4.4355, abs=5e-5)


def test_states_and_outputs_are_named_in_order() -> None:
    model = linear_model(load_vehicle("truck_trailer"))
    assert model.state_names == (
        "truck/lateral_velocity",
        "truck/yaw_rate",
        "trailer/yaw_rate",
        "articulation_1",
    )
    assert model.output_names == (
        "truck/lateral_velocity",
        "trailer/lateral_velocity",
        "truck/yaw_rate",
        "trailer/yaw_rate",
        "truck/lateral_acceleration",
        "trailer/lateral_acceleration",
        "articulation_1",
    )


@pytest.mark.parametrize("manoeuvre", ["step", "sine"])
def test_the_tractor_semitrailer_moves_as_openvd_says(manoeuvre: str) -> None:
    parameters, history = OPENVD["parameters"], OPENVD[manoeuvre]["history_dt_0p1"]
    tractor = Unit(
        "tractor",
        parameters["m1"],
        parameters["J1"],
        (
            Axle(parameters["a"], parameters["C1"], steered=True),
            Axle(-parameters["b"], parameters["C2"]),
        ),
        rear_hitch=-parameters["hitch_behind_tractor_cg"],
    )
    semitrailer = Unit(
        "semitrailer",
        parameters["m2"],
        parameters["J2"],
        (Axle(-parameters["semi_cg_to_axle"], parameters["C3"]),),
        front_hitch=parameters["hitch_to_semi_cg"],
    )
    vehicle = Vehicle("tractor_semitrailer", parameters["u"], (tractor, semitrailer))
    angle, step_size = np.radians(2.0), 0.001

    def steering(time: float) -> float:
        # The middle of a step stands for it to second order, as OpenVD's input is not held over steps.
        middle = time + 0.5 * step_size
        if manoeuvre == "step":
            return float(angle)
        return float(angle * np.sin(0.5 * np.pi * middle)) if middle < 4.0 else 0.0

    response = simulate(vehicle, steering, 10.0, step_size=step_size, sample_period=0.1)
    np.testing.assert_allclose(response.time, history["t"], atol=1e-12)
    np.testing.assert_allclose(response.yaw_rate[:, 0], history["dPSI"], atol=1e-6)
    np.testing.assert_allclose(response.yaw[:, 0], history["PSI"], atol=1e-6)
    np.testing.assert_allclose(response.articulation[:, 0], history["PHI"], atol=1e-6)
    articulation_rate = response.yaw_rate[:, 0] - response.yaw_rate[:, 1]
    np.testing.assert_allclose(articulation_rate, history["dPHI"], atol=1e-6)
