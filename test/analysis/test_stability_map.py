"""The boundary of stability over two parameters lies where an eigenvalue crosses."""

import numpy as np
import pytest

from yawdamp_ros import linear_model, load_vehicle
from yawdamp_ros.analysis import speed_boundaries, stability_map
from yawdamp_ros.analysis.stability_map import boundary_segments
from yawdamp_ros.analysis.study import Study
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.vehicle import vehicle_text

KEYS = (("speed",), ("units.0.axles.1.cornering_stiffness",))


def car() -> Study:
    return Study(vehicle_text("single_vehicle"), "single_vehicle", (), "consistent", KEYS)


def test_every_end_of_a_segment_is_on_the_boundary() -> None:
    segments = boundary_segments(car(), np.linspace(10.0, 60.0, 9), np.linspace(2e4, 6e4, 7))
    assert len(segments) > 8
    for speed, stiffness in segments.reshape(-1, 2).tolist():
        vehicle = load_vehicle("single_vehicle", [f"{KEYS[1][0]}={stiffness!r}"])
        largest = np.linalg.eigvals(linear_model(vehicle, speed).state_matrix).real.max()
        assert largest == pytest.approx(0.0, abs=1e-6)


def test_boundary_passes_through_the_critical_speed() -> None:
    # A row of the grid at 40 kN/rad: there the boundary is the critical speed of that car.
    segments = boundary_segments(car(), np.linspace(10.0, 60.0, 9), np.array([3e4, 4e4, 5e4]))
    (speed,) = {round(s, 6) for s, stiffness in segments.reshape(-1, 2).tolist() if stiffness == 4e4}
    (boundary,) = speed_boundaries(load_vehicle("single_vehicle", [f"{KEYS[1][0]}=4e4"]))
    assert speed == pytest.approx(boundary.value, abs=1e-6)


def test_segments_join_into_one_line() -> None:
    segments = boundary_segments(car(), np.linspace(10.0, 60.0, 9), np.linspace(2e4, 6e4, 7))
    ends, counts = np.unique(segments.reshape(-1, 2).round(6), axis=0, return_counts=True)
    assert sorted(counts.tolist())[:2] == [1, 1]
    assert set(counts.tolist()) == {1, 2}
    assert (counts == 1).sum() == 2
    assert len(ends) == len(segments) + 1


def test_no_boundary_is_no_segment() -> None:
    assert boundary_segments(car(), np.array([10.0, 12.0]), np.array([9e4, 1e5])).shape == (0, 2, 2)


@pytest.mark.parametrize("middle", [True, False])
def test_saddle_is_joined_as_its_middle_is(middle: bool, monkeypatch: pytest.MonkeyPatch) -> None:  # noqa: FBT001
    def unstable(_: Study, points: FloatArray) -> FloatArray:
        x, y = points[..., 0], points[..., 1]
        # Unstable at two opposite corners, and in the middle or not.
        near = (np.hypot(x, y) < 0.4) | (np.hypot(x - 1.0, y - 1.0) < 0.4)
        return np.asarray(near | (middle & (abs(x - y) < 0.2)))

    monkeypatch.setattr(stability_map, "_unstable", unstable)
    segments = boundary_segments(car(), np.array([0.0, 1.0]), np.array([0.0, 1.0]))
    assert segments.shape == (2, 2, 2)
    middles = segments.mean(axis=1)
    # Joined through the middle, segments cut the other two corners off; else these two.
    cut = {(round(x), round(y)) for x, y in middles}
    assert cut == ({(1, 0), (0, 1)} if middle else {(0, 0), (1, 1)})
