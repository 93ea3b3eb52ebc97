"""The planar chain with brush tyres against numbers computed elsewhere."""

import math

import numpy as np
import pytest

from nonlinear_cases import PLANAR, UNLIMITED, motion, numbers
from yawdamp_ros.nonlinear import NonlinearDynamics
from yawdamp_ros.vehicle import load_vehicle

REFERENCE = numbers("interlink_brush.json")
LOADS = [2 * 32843.88, *[4 * 19239.86] * 2, *[4 * 20386.41] * 2, *[4 * 20832.76] * 2]
AXLES = [(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (2, 0), (2, 1)]
PERIOD = 2.0 * math.pi / 1.5


@pytest.mark.parametrize("case", REFERENCE["cases"])
def test_the_lane_change_of_the_interlink_is_the_one_computed_elsewhere(case: str) -> None:
    amplitude, friction = (float(part) for part in case[1:].replace("None", str(UNLIMITED)).split("_mu"))
    overrides = [
        f"units.{unit}.axles.{axle}.static_load={load}"
        for (unit, axle), load in zip(AXLES, LOADS, strict=True)
    ]
    if friction == UNLIMITED:
        overrides += [f"units.{unit}.axles.{axle}.tyre=linear" for unit, axle in AXLES]
    dynamics = NonlinearDynamics(
        load_vehicle("interlink", [*overrides, "units.0.axles.2.driven=false"]), PLANAR
    )

    def inputs(t: float) -> np.ndarray:
        steering = amplitude * math.sin(1.5 * (t - 1.0)) if 1.0 < t < 1.0 + PERIOD else 0.0
        return dynamics.inputs(steering, speed=80 / 3.6, friction=friction)

    times = np.arange(241) * 0.05
    states = motion(dynamics, dynamics.initial_state(80 / 3.6), times, inputs, (1.0, 1.0 + PERIOD), 1e-10)
    found = dynamics.outputs(states, np.array([inputs(t) for t in times]))
    expected = REFERENCE["cases"][case]
    rounding = 1e-5  # and half a unit of the last printed digit
    for values, key in (
        (found.yaw_rate, "peak_yaw_rate"),
        (found.acceleration[..., 1], "peak_lateral_acceleration"),
        (found.articulation, "peak_articulation"),
    ):
        assert np.abs(values).max(axis=0) == pytest.approx(expected[key], rel=rounding, abs=6e-7)
    end = expected["end"]
    assert found.position[-1, 0] == pytest.approx([end["x"], end["y"]], rel=rounding, abs=6e-5)
    assert found.yaw[-1] == pytest.approx(end["yaw"], rel=rounding, abs=6e-7)
    assert found.velocity[-1, 0, 0] == pytest.approx(end["speed"], abs=6e-6)
