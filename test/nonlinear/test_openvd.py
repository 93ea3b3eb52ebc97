"""A tractor and semitrailer against OpenVD's nonlinear articulated vehicle."""

import math
from collections.abc import Callable

import pytest

from nonlinear_cases import PLANAR, deviation, magic_formula, motion, numbers, table
from yawdamp_ros.nonlinear import NonlinearDynamics
from yawdamp_ros.vehicle import Axle, MagicFormula, Unit, Vehicle

CASE = numbers("openvd_nonlinear.json")
TYRES = (2, 4, 8)


def pacejka(load: float) -> MagicFormula:
    """OpenVD's TirePacejka with its own coefficients, at one load [N] and its friction of 0.3."""
    c = CASE["tyres"]["defaults"]
    kilonewtons = load / 1000.0
    per_degree = c["a3"] * math.sin(2.0 * math.atan(kilonewtons / c["a4"]))
    return magic_formula(
        FNOMIN=load,
        PCY1=c["a0"],
        PDY1=0.3,
        PEY1=c["a6"] * kilonewtons + c["a7"],
        PKY1=-math.degrees(per_degree) / load,
        PKY2=1.0,
    )


def linear_in_the_angle(load: float) -> MagicFormula:
    """OpenVD's TireLinear, 40000 N/rad times the slip angle: a magic formula far below its peak."""
    return magic_formula(FNOMIN=load, PCY1=1.0, PDY1=1e6, PEY1=1.0, PKY1=-40000.0 / load, PKY2=1.0)


@pytest.mark.parametrize(
    "run, law, steering, speed, side_slip, rates",
    [
        ("step_linear", linear_in_the_angle, math.radians(4.0), 10.0, 0.0, (0.0, 0.0)),
        ("template_pacejka", pacejka, 0.0, 20.0, 0.3, (0.25, 0.0)),
    ],
)
def test_a_tractor_and_semitrailer_move_as_those_of_openvd(
    run: str,
    law: Callable[[float], MagicFormula],
    steering: float,
    speed: float,
    side_slip: float,
    rates: tuple[float, float],
) -> None:
    given = CASE["derived_SI"]
    tractor, semitrailer = given["tractor"], given["semitrailer"]
    positions = (tractor["front_axle_x"], tractor["rear_axle_x"], semitrailer["axle_x"])
    axles = tuple(
        Axle(x, 40000.0 * tyres, steered=place == 0, static_load=tyres * load, tyre=law(load), tyres=tyres)
        for place, (x, tyres, load) in enumerate(zip(positions, TYRES, given["load_per_tyre_N"], strict=True))
    )
    units = (
        Unit("tractor", tractor["m"], tractor["J"], axles[:2], None, tractor["fifth_wheel_x"]),
        Unit("semitrailer", semitrailer["m"], semitrailer["J"], axles[2:], semitrailer["kingpin_x"]),
    )
    dynamics = NonlinearDynamics(Vehicle("openvd", speed, units, friction=1.0), PLANAR)
    start = dynamics.initial_state(speed)
    start[dynamics.layout.velocity] = speed * math.cos(side_slip), speed * math.sin(side_slip)
    start[dynamics.layout.yaw_rate] = rates
    expected, inputs = table(f"openvd_{run}.csv"), dynamics.inputs(steering)
    states = motion(dynamics, start, expected["t"], lambda _: inputs)
    found = dynamics.outputs(states, inputs)
    forces = found.lateral_force.reshape(len(states), -1, 2).sum(axis=2)
    for name, values in {
        "X": found.position[:, 0, 0],
        "Y": found.position[:, 0, 1],
        "psi": found.yaw[:, 0],
        "phi": found.articulation[:, 0],
        "dpsi": found.yaw_rate[:, 0],
        "rS": found.yaw_rate[:, 1],
        "vxT": found.velocity[:, 0, 0],
        "vyT": found.velocity[:, 0, 1],
        "vxS": found.velocity[:, 1, 0],
        "vyS": found.velocity[:, 1, 1],
        "FyF": forces[:, 0],
        "FyR": forces[:, 1],
        "FyM": forces[:, 2],
    }.items():
        assert deviation(values, expected[name]) < 1e-6, name
