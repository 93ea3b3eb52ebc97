"""A tractor-semitrailer with full roll data against a multibody model."""

import pytest

from yawdamp_ros.nonlinear import NonlinearDynamics, steady_turn
from yawdamp_ros.vehicle import STANDARD_GRAVITY, Axle, Unit, Vehicle

# Chrono's Kraz (projectchrono/chrono at 7689fbc, src/chrono_models/vehicle/kraz, BSD-3-Clause): masses,
# places, springs; TMeasy tyres by its GuessTruck80Par. The response is Chrono's at 60 km/h on friction 0.8.
RATED = {"tractor": 0.5 * 3350.0 * STANDARD_GRAVITY, "trailer": 0.5 * 5000.0 * STANDARD_GRAVITY}
SPEED, STEERING = 16.4623, 0.0373291
YAW_RATE, ROLLS, ARTICULATION = 0.11455, (0.0461, 0.0456), 0.051715
RIGID = 1e8
"""Roll stiffness of the fifth wheel [N m/rad], which Chrono's universal joint does not let twist."""


def in_series(spring: float, tyre: float) -> float:
    return spring * tyre / (spring + tyre)


def axle(x: float, wheel_load: float, unit: str, roll_stiffness: float, track: float, tyres: int = 1) -> Axle:
    rating = 7.9521 - 0.5508 * wheel_load / tyres / RATED[unit]  # stiffness over load, TMeasy's truck tyre
    load = 2.0 * wheel_load
    return Axle(
        x, rating * load, steered=x > 0.0, static_load=load, track_width=track, roll_stiffness=roll_stiffness
    )


def kraz() -> Vehicle:
    tractor_cg, trailer_cg = -2.327, -6.160
    # Springs at their distance from the middle, in series with the tyres at theirs. The roll axis lies in the
    # axle, 0.53 m up, less the share by which the tyres turn the axle about the road.
    front = in_series(2 * 592176.0 * 0.529**2, 2 * 673.9e3 * 0.919**2)
    rear = in_series(2 * 1026439.0 * 0.429**2, 4 * 673.9e3 * 0.832**2)
    trailer = in_series(2 * 710612.0 * 0.729**2, 2 * 1225e3 * 1.0325**2)
    return Vehicle(
        "kraz",
        SPEED,
        (
            Unit(
                "tractor",
                13236.8,
                51500.0,
                (
                    axle(-tractor_cg, 32643.0, "tractor", front, 1.838),
                    axle(-4.08 - tractor_cg, 31515.0, "tractor", rear, 1.665, 2),
                    axle(-5.48 - tractor_cg, 22466.0, "tractor", rear, 1.665, 2),
                ),
                rear_hitch=-4.64 - tractor_cg,
                cg_height=1.134,
                roll_axis_height=0.53 * (1.0 - 0.19),
                hitch_height=1.35,
                hitch_roll_stiffness=RIGID,
            ),
            Unit(
                "trailer",
                22184.0,
                340e3,
                tuple(
                    axle(x - trailer_cg, load, "trailer", trailer, 2.065)
                    for x, load in ((-6.32, 26940.0), (-7.63, 29031.0), (-8.94, 31122.0))
                ),
                front_hitch=-0.04 - trailer_cg,
                cg_height=2.372,
                roll_axis_height=0.53 * (1.0 - 0.22),
            ),
        ),
        friction=0.8,
    )


def test_a_steady_turn_is_that_of_chronos_multibody_tractor_semitrailer() -> None:
    dynamics = NonlinearDynamics(kraz())
    found = steady_turn(dynamics, SPEED, dynamics.inputs(), steering=STEERING).outputs
    assert found.yaw_rate[0] == pytest.approx([YAW_RATE] * 2, rel=0.05)
    assert found.roll[0, 0] == pytest.approx(ROLLS[0], rel=0.05)
    assert found.roll[0, 1] == pytest.approx(ROLLS[1], rel=0.1)
    assert found.articulation[0, 0] == pytest.approx(ARTICULATION, rel=0.1)
