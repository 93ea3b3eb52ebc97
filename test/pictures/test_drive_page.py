"""The page of a comparison: curves over each other, and nothing that a name could break."""

import json
import re

import numpy as np
import pytest

from yawdamp_ros.drives import Channel, Match
from yawdamp_ros.drives.comparison import compare_channel
from yawdamp_ros.pictures.drive_page import MOST_POINTS, DriveReport, PageTable, drive_page
from yawdamp_ros.vehicle import load_vehicle

TIMES = 0.01 * np.arange(12_001)


def data_of(page: str) -> dict[str, object]:
    return json.loads(re.search(r'id="data">(.*?)</script>', page, re.DOTALL)[1])


@pytest.fixture(scope="module")
def page() -> str:
    signal = np.sin(TIMES)
    channel = Channel("truck/yaw_rate", "made", TIMES, signal + 0.1)
    found = compare_channel(Match("truck/yaw_rate", channel), TIMES, signal)
    table = PageTable("Agreement", ("channel", "R2"), [("</script><b>", "0.9")])
    report = DriveReport(
        title="drive",
        subtitle="sub",
        verdict="the verdict",
        passed=True,
        vehicle=load_vehicle("truck_trailer"),
        tables=[table],
        notes=["a note"],
        taken=["steering: made"],
        comparisons=[("Curves", [found]), ("None", [])],
    )
    return drive_page(report)


def test_measured_and_simulated_are_in_one_chart(page: str) -> None:
    (section,) = data_of(page)["sections"]
    curves, error, coherence = section["charts"]
    assert [each["name"] for each in curves["series"]] == ["measured", "simulated"]
    measured, simulated = (np.array(each["ys"]) for each in curves["series"])
    np.testing.assert_allclose(measured - simulated, 0.1, atol=1e-3)
    assert len(measured) <= MOST_POINTS
    assert "One sample in 4 is drawn." in curves["caption"]
    assert error["caption"].startswith("RMS 0.1 rad/s")
    assert max(coherence["series"][0]["xs"]) <= 5.0


def test_the_verdict_comes_first_then_the_vehicle_and_definitions_last(page: str) -> None:
    places = [
        page.index(f'id="{name}"') for name in ("verdict", "results", "vehicle", "charts", "definitions")
    ]
    assert places == sorted(places)
    data = data_of(page)
    assert (data["verdict"], data["passed"], data["taken"]) == ("the verdict", True, ["steering: made"])
    assert [unit["name"] for unit in data["vehicle"]["units"]] == ["truck", "trailer"]


def test_a_name_cannot_end_the_script_that_holds_it(page: str) -> None:
    assert page.count("</script>") == 2
    assert data_of(page)["tables"][0]["rows"] == [["</script><b>", "0.9"]]


def test_the_page_needs_nothing_else(page: str) -> None:
    assert not re.search(r"(src|href)=\"(?!data:,)", page)
    assert "$" not in re.sub(r"\$\{", "", page)
