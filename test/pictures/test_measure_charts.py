"""Charts of an assessment's page show where each value comes from."""

from pathlib import Path
from typing import Any

import pytest

from yawdamp_ros.analysis import Assessment, assess, load_scheme
from yawdamp_ros.pictures.measure_charts import measure_charts
from yawdamp_ros.vehicle import load_vehicle

PAYLOAD = Path(__file__).parents[2] / "docs" / "interlink_payload.yaml"


def charts(scheme: str, only: str) -> tuple[dict[str, Any], dict[str, float]]:
    """Charts by their first measure, and the values of the measures."""
    vehicle, chosen = load_vehicle(PAYLOAD), load_scheme(scheme, only)
    findings = assess(vehicle, scheme=chosen, level=None)
    found = measure_charts(Assessment(vehicle, "consistent", chosen, None, findings))
    return {each["measures"][0]: each for each in found}, {
        each.measure.name: each.value for each in findings if each.value is not None
    }


def test_the_highest_point_of_a_line_is_the_value_of_its_measure() -> None:
    names = "frontal_swing,tail_swing,steer_tyre_friction_demand"
    found, values = charts("pbs", names)
    assert list(found) == names.split(",")
    for name, chart in found.items():
        highest = max(max(line["ys"]) for line in chart["lines"] if not line["dash"])
        assert highest == pytest.approx(values[name], rel=1e-3), name
        (limit,) = (line for line in chart["lines"] if line["dash"])
        assert len(set(limit["ys"])) == 1


def test_the_load_transfer_of_the_chart_is_that_of_the_measure() -> None:
    found, values = charts("rtac", "load_transfer_ratio")
    (chart,) = found.values()
    assert [line["name"] for line in chart["lines"]] == ["truck + trailer_1 + trailer_2", "limit, 0.6"]
    assert max(chart["lines"][0]["ys"]) == pytest.approx(values["load_transfer_ratio"], abs=1e-4)


def test_the_width_of_the_stop_lies_between_its_lines() -> None:
    found, values = charts("pbs", "directional_stability_under_braking")
    left, right = found["directional_stability_under_braking"]["lines"]
    assert max(left["ys"]) - min(right["ys"]) == pytest.approx(
        values["directional_stability_under_braking"], abs=0.01
    )


def test_force_meets_resistance_at_the_speed_of_the_measure() -> None:
    found, values = charts("pbs", "startability,gradeability,gradeability_speed,acceleration_capability")
    force, level, slight, steep = found["startability"]["lines"]
    above = [a > b for a, b in zip(force["ys"], slight["ys"], strict=True)]
    assert force["xs"][above.index(False)] == pytest.approx(values["gradeability_speed"], abs=0.6)
    assert steep["ys"][0] <= force["ys"][0]
    assert steep["name"] == "resistance on 21.8 %"
    assert level["ys"][0] < slight["ys"][0]
    (way,) = found["acceleration_capability"]["lines"]
    assert (way["xs"][-1], way["ys"][-1]) == pytest.approx(
        (values["acceleration_capability"], 100.0), rel=1e-4
    )


def test_a_measure_without_a_value_has_no_chart() -> None:
    vehicle, scheme = load_vehicle("a_double"), load_scheme("pbs", "startability")
    findings = assess(vehicle, scheme=scheme)
    assert measure_charts(Assessment(vehicle, "consistent", scheme, None, findings)) == []
