"""OpenPBS's A-double and Nordic combination, by a model of their own beside the library's.

Parameters are those of Adouble6x4.mo and NordicCombination.mo in OpenPBS
(github.com/performance-based-standards/OpenPBS at 86c5fe9), positions from the first axle of each unit; the
equations are written here after Newton and Euler with the coupling forces as unknowns, as its SingleTrack.mo
has them, for small angles. OpenPBS prints no results; what is compared is what its definitions give.
"""

import math
from typing import NamedTuple

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from yawdamp_ros.analysis import (
    SingleLaneChange,
    least_damping_ratio,
    rearward_amplification,
    run_lane_change,
)
from yawdamp_ros.dynamics import linear_model
from yawdamp_ros.vehicle import STANDARD_GRAVITY, load_vehicle, static_loads

COEFFICIENT, SPEED, FREQUENCY, WIDTH = 5.5, 80.0 / 3.6, 0.4, 4.5


class Parameters(NamedTuple):
    """As OpenPBS's records name them; axles that are not there are left out."""

    axles: list[list[float]]
    centre: list[float]
    front: list[float]
    rear: list[float]
    mass: list[float]
    inertia: list[float]
    first_group: list[int]


FILES = {
    "a_double": Parameters(
        [[0.0, -3.0, -4.37], [0.0, -1.3, -2.6], [0.0, -1.3], [0.0, -1.3, -2.6]],
        [-1.3647, 2.0656, 0.0609, 1.7499],
        [0.0, 6.4, 3.9, 6.4],
        [-3.4, -4.0, -0.65, -4.0],
        [9841.0, 33101.0, 3200.0, 33800.0],
        [29910.0, 573480.0, 7280.0, 551450.0],
        [1, 3, 2, 3],
    ),
    "nordic_combination": Parameters(
        [[0.0, -4.8, -6.2], [0.0, -1.3], [0.0, -1.3, -2.6]],
        [-1.3647, 0.0609, 1.7499],
        [0.0, 3.9, 6.4],
        [-8.0, -0.65, -4.0],
        [26000.0, 3200.0, 33800.0],
        [329910.0, 7280.0, 551450.0],
        [1, 2, 3],
    ),
}


def loads(p: Parameters) -> list[np.ndarray]:
    """Axle loads as VerticalForces.mo has them: two groups of the lead unit, one of each other [N]."""
    found: list[np.ndarray] = []
    behind = 0.0
    for unit in reversed(range(len(p.mass))):
        places = np.array(p.axles[unit]) - p.centre[unit]
        ahead, back = p.front[unit] - p.centre[unit], p.rear[unit] - p.centre[unit]
        weight = STANDARD_GRAVITY * p.mass[unit]
        group = p.first_group[unit]
        middle = places[:group].mean() if unit else places[group:].mean()
        support = ahead if unit else places[:group].mean()
        on_front = (behind * (back - middle) - weight * middle) / (support - middle)
        rest = weight + behind - on_front
        shared = np.full(len(places), rest / (len(places) if unit else len(places) - group))
        if not unit:
            shared[:group] = on_front / group
        found.insert(0, shared)
        behind = on_front if unit else 0.0
    return found


def lane_change(p: Parameters) -> tuple[np.ndarray, list[np.ndarray]]:
    """Yaw rates and the lateral positions of all axles of each unit in OpenPBS's lane change, sampled."""
    count, u = len(p.mass), SPEED
    stiffness = [COEFFICIENT * each for each in loads(p)]
    arms = [np.array(axles) - centre for axles, centre in zip(p.axles, p.centre, strict=True)]
    amplitude = 2.0 * math.pi * WIDTH * FREQUENCY**2
    # Unknown: rates of v and r of every unit, coupling forces, steering of the first axle.
    size = 3 * count
    matrix = np.zeros((size, size))
    for i in range(count):
        ahead, back = p.front[i] - p.centre[i], p.rear[i] - p.centre[i]
        matrix[i, i], matrix[count + i, count + i] = p.mass[i], p.inertia[i]
        if i < count - 1:
            matrix[i, 2 * count + i], matrix[count + i, 2 * count + i] = 1.0, back
            matrix[2 * count + i, [i, i + 1]] = 1.0, -1.0
            matrix[2 * count + i, [count + i, count + i + 1]] = back, -(p.front[i + 1] - p.centre[i + 1])
        if i:
            matrix[i, 2 * count + i - 1], matrix[count + i, 2 * count + i - 1] = -1.0, -ahead
    matrix[0, -1], matrix[count, -1] = -stiffness[0][0], -stiffness[0][0] * arms[0][0]
    matrix[-1, 0], matrix[-1, count] = 1.0, arms[0][0]
    inverse = np.linalg.inv(matrix)

    def rates(time: float, state: np.ndarray) -> np.ndarray:
        v, r, yaw = state[:count], state[count : 2 * count], state[2 * count : 3 * count]
        known = np.zeros(size)
        for i in range(count):
            force = -stiffness[i] * (v[i] + arms[i] * r[i]) / u
            known[i] = force.sum() - p.mass[i] * u * r[i]
            known[count + i] = (arms[i] * force).sum()
        known[2 * count : -1] = -u * (r[:-1] - r[1:])
        sine = amplitude * math.sin(2.0 * math.pi * FREQUENCY * time) if time < 1.0 / FREQUENCY else 0.0
        known[-1] = sine - u * r[0]
        solved = inverse @ known
        return np.concatenate([solved[: 2 * count], r, v + u * yaw])

    times = np.linspace(0.0, 12.0, 2401)
    kink = 1.0 / FREQUENCY
    first = solve_ivp(
        rates, (0.0, kink), np.zeros(4 * count), t_eval=times[times <= kink], rtol=1e-9, atol=1e-12
    )
    then = solve_ivp(rates, (kink, 12.0), first.y[:, -1], t_eval=times[times > kink], rtol=1e-9, atol=1e-12)
    y = np.hstack([first.y, then.y])
    places = [y[3 * count + i] + np.outer(arms[i], y[2 * count + i]) for i in range(count)]
    # Every unit integrates its own y from 0: hitches stay together as their velocities do.
    return y[count : 2 * count].T, places


@pytest.fixture(scope="module", params=list(FILES))
def name(request: pytest.FixtureRequest) -> str:
    found: str = request.param
    return found


def test_axle_loads_are_those_of_its_vertical_forces(name: str) -> None:
    for ours, theirs in zip(static_loads(load_vehicle(name)), loads(FILES[name]), strict=True):
        assert ours.axles == pytest.approx(theirs, rel=1e-6)


def test_stiffness_is_its_coefficient_times_the_load(name: str) -> None:
    changed = load_vehicle(name, [f"units.*.axles.*.cornering_coefficient={COEFFICIENT}"])
    for unit, theirs in zip(changed.units, loads(FILES[name]), strict=True):
        assert [axle.cornering_stiffness for axle in unit.axles] == pytest.approx(
            COEFFICIENT * theirs, rel=1e-6
        )


def test_amplification_and_overshoot_in_its_lane_change(name: str) -> None:
    yaw_rates, places = lane_change(FILES[name])
    vehicle = load_vehicle(name, [f"units.*.axles.*.cornering_coefficient={COEFFICIENT}"])
    change = SingleLaneChange(2.0 * math.pi * WIDTH * FREQUENCY**2, FREQUENCY)
    ours = run_lane_change(linear_model(vehicle, SPEED), change)
    assert rearward_amplification(ours.yaw_rate) == pytest.approx(
        np.abs(yaw_rates[:, -1]).max() / np.abs(yaw_rates[:, 0]).max(), rel=1e-4
    )
    overshoot = max(float(each.max()) for each in places) - WIDTH
    last = vehicle.units[-1].axles[-1].position
    # Its angles are small; ours turn the axle's arm by the true yaw.
    assert float((ours.y[:, -1] + last * np.sin(ours.yaw[:, -1])).max()) - WIDTH == pytest.approx(
        overshoot, abs=0.05
    )


def test_damping_of_the_a_double_is_that_of_an_independent_model() -> None:
    model = linear_model(load_vehicle("a_double", ["units.*.axles.*.cornering_coefficient=5.5"]), SPEED)
    assert least_damping_ratio(model) == pytest.approx(0.3721, abs=1e-4)
