"""A vehicle is drawn to scale, each part where the vehicle has it."""

import pytest
from matplotlib.patches import Circle, Rectangle

from yawdamp_ros.pictures.vehicle import vehicle_figure
from yawdamp_ros.vehicle import builtin_vehicles, load_vehicle

A_DOUBLE = load_vehicle("a_double")


@pytest.mark.parametrize("name", builtin_vehicles())
def test_every_axle_stands_once_in_the_side_view_with_its_load(name: str) -> None:
    side, above = vehicle_figure(load_vehicle(name)).axes
    axles = sum(len(unit.axles) for unit in load_vehicle(name).units)
    tyres = [patch for patch in side.patches if isinstance(patch, Circle)]
    assert len({patch.center[0] for patch in tyres}) == axles
    assert all(patch.center[1] == max(each.radius for each in tyres) for patch in tyres)
    loads = [text for text in side.texts if text.get_position()[1] < 0.0]
    assert {text.get_position()[0] for text in loads} == {patch.center[0] for patch in tyres}
    assert side.get_aspect() == above.get_aspect() == 1.0


def test_units_stand_behind_one_another_at_their_hitches() -> None:
    side, _ = vehicle_figure(A_DOUBLE).axes
    hitches = [line.get_xydata()[0] for line in side.lines if line.get_marker() == "v"]
    centres = [line.get_xydata()[0] for line in side.lines if line.get_marker() == "o"]
    for hitch, ahead, behind, (rear, front) in zip(
        hitches, centres, centres[1:], A_DOUBLE.hitches, strict=False
    ):
        assert hitch[0] - ahead[0] == pytest.approx(rear)
        assert hitch[0] - behind[0] == pytest.approx(front)
    assert [height for _, height in hitches] == [1.25, 0.8, 1.25]
    assert [height for _, height in centres] == [1.1, 2.0, 0.9, 2.0]


def test_wheels_lie_at_their_track_and_the_body_has_its_width() -> None:
    _, above = vehicle_figure(load_vehicle("tractor_semitrailer")).axes
    boxes = [patch for patch in above.patches if isinstance(patch, Rectangle)]
    middles = {round(patch.get_y() + 0.5 * patch.get_height(), 4) for patch in boxes}
    assert middles == {0.0, 0.919, -0.919, 0.8325, -0.8325, 1.0325, -1.0325}
    assert max(patch.get_height() for patch in boxes) == 2.55


def test_a_height_that_is_assumed_is_hollow_and_said() -> None:
    side, _ = vehicle_figure(load_vehicle("truck_trailer", ["units.0.cg_height=1.3"])).axes
    truck, trailer = (line for line in side.lines if line.get_marker() == "o")
    assert (truck.get_markerfacecolor(), trailer.get_markerfacecolor()) == ("black", "white")
    assert {"1.30 m", "2.00 m assumed"} <= {text.get_text() for text in side.texts}
