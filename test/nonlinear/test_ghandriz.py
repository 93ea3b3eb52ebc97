"""Four units against the equations that other authors generated."""

import math
from dataclasses import replace

import numpy as np
import pytest

from nonlinear_cases import PLANAR, deviation, magic_formula, motion, numbers, table
from yawdamp_ros.nonlinear import NonlinearDynamics
from yawdamp_ros.nonlinear.parameters import AIR_DENSITY
from yawdamp_ros.vehicle import Axle, MagicFormula, Unit, Vehicle

CASE = numbers("ghandriz_2020.json")
LANE_CHANGE = (1.0, 5.0)
TURN = (1.0, 3.0, 5.663323, 7.663323)


def tyre(axle: dict[str, float]) -> MagicFormula:
    """Their law at the axle's load: a magic formula whose stiffness is theirs."""
    law = CASE["nonlinear_tyre"]["steered" if axle["steered_tyre"] else "others"]
    load = axle["static_load"] / axle["wheels"]
    stiffness = law["c0"] * (1.0 - 0.1 * (load - 25000.0) / 25000.0) * load
    return magic_formula(
        FNOMIN=25000.0,
        PCY1=2.0 * (1.0 + math.asin(0.8) / math.pi),
        PDY1=0.8,
        PDY2=0.8 * law["u"],
        PKY1=-stiffness / (25000.0 * math.sin(2.0 * math.atan(load / 25000.0))),
        PKY2=1.0,
    )


def combination(*, linear: bool) -> Vehicle:
    def axle(data: dict[str, float]) -> Axle:
        place = (data["unit"], data["axle"])
        return Axle(
            data["position"],
            data["cornering_stiffness_per_wheel"] * data["wheels"],
            steered=place == (1, 1),
            driven=place == (1, 2),
            static_load=data["static_load"],
            tyre="linear" if linear else tyre(data),
            tyres=None if linear else int(data["wheels"]),
        )

    units = tuple(
        Unit(
            f"unit_{number}",
            unit["mass"],
            unit["yaw_inertia"],
            tuple(axle(each) for each in CASE["axles"] if each["unit"] == number),
            unit["front_hitch"],
            unit["rear_hitch"],
        )
        for number, unit in enumerate(CASE["units"], 1)
    )
    return Vehicle("ghandriz", 80 / 3.6, units, friction=1.0, drag_area=9.984 / AIR_DENSITY)


def lane_change(t: float) -> float:
    return 0.025382 * math.sin(2.0 * math.pi * (t - 1.0) / 4.0) if 1.0 < t < 5.0 else 0.0


def turn(t: float) -> float:
    begin, full, back, end = TURN
    if begin < t < full:
        return 0.15 * (1.0 - math.cos(math.pi * (t - begin) / 2.0))
    if back < t < end:
        return 0.15 * (1.0 + math.cos(math.pi * (t - back) / 2.0))
    return 0.3 if full <= t <= back else 0.0


@pytest.mark.parametrize("run", ["lane_change_linear", "lane_change_nonlinear", "turn90_linear"])
def test_four_units_move_as_by_the_equations_of_others(run: str) -> None:
    speed, steering, corners = (5.0, turn, TURN) if "turn" in run else (80 / 3.6, lane_change, LANE_CHANGE)
    settings = replace(PLANAR, drag=True, speed_gain=1.0)
    dynamics = NonlinearDynamics(combination(linear=not run.endswith("nonlinear")), settings)
    expected = table(f"ghandriz_2020_{run}.csv")
    times = expected["t"]

    def inputs(t: float) -> np.ndarray:
        return dynamics.inputs(steering(t), speed=speed)

    states = motion(dynamics, dynamics.initial_state(speed), times, inputs, corners)
    found = dynamics.outputs(states, np.array([inputs(t) for t in times]))
    for unit in range(4):
        for name, values in (
            ("psi", found.yaw),
            ("r", found.yaw_rate),
            ("vx", found.velocity[..., 0]),
            ("vy", found.velocity[..., 1]),
        ):
            assert deviation(values[:, unit], expected[f"{name}{unit + 1}"]) < 1e-6, (name, unit)
    assert deviation(found.position[:, 0, 0], expected["X1"]) < 1e-8
    assert deviation(found.position[:, 0, 1], expected["Y1"]) < 1e-8
    forces = found.lateral_force.reshape(len(times), -1, 2).sum(axis=2)
    for axle, place in enumerate(("1_1", "1_2", "2_1", "3_1", "3_2", "4_1")):
        assert deviation(forces[:, axle], expected[f"Fy_{place}"]) < 1e-6, place
