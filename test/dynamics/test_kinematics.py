"""Units stay coupled, and move as their couplings make them."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from strategies import vehicles
from yawdamp_ros.dynamics.kinematics import coupled_positions, coupled_velocities
from yawdamp_ros.vehicle import Vehicle

ANGLES = st.floats(-3.0, 3.0)


@given(vehicles(1, 5), st.lists(ANGLES, min_size=15, max_size=15))
def test_velocities_are_the_rates_of_the_positions(vehicle: Vehicle, drawn: list[float]) -> None:
    units = len(vehicle.units)
    yaw, yaw_rate = np.array(drawn[:units]), np.array(drawn[5 : 5 + units])
    forward, sideways = 10.0 + drawn[10], drawn[11]
    velocities = coupled_velocities(
        vehicle.hitches, (np.array(forward), np.array(sideways)), yaw_rate, np.exp(1j * yaw)
    )
    lead, time = (forward + 1j * sideways) * np.exp(1j * yaw[0]), 1e-5
    ahead, behind = (
        coupled_positions(vehicle.hitches, lead * moment, np.exp(1j * (yaw + yaw_rate * moment)))
        for moment in (time, -time)
    )
    np.testing.assert_allclose(velocities * np.exp(1j * yaw), (ahead - behind) / (2.0 * time), atol=1e-6)
