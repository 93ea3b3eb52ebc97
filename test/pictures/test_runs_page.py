"""The page of runs, as a browser shows it."""

import re
import subprocess
from importlib.util import find_spec
from pathlib import Path

import pytest

from browser import CHROMIUM, QUIET, needs_browser
from yawdamp_ros.manoeuvres import LaneChange, Step
from yawdamp_ros.pictures.run_panels import run_panels
from yawdamp_ros.simulation import simulate
from yawdamp_ros.stepping import Response
from yawdamp_ros.vehicle import load_vehicle

INTERLINK, CAR = (
    simulate(load_vehicle(name), LaneChange(), 3.0, sample_period=0.05)
    for name in ("interlink", "single_vehicle")
)

pytestmark = pytest.mark.skipif(
    find_spec("plotly") is None, reason="needs plotly, which rosdep does not know"
)

BUTTONS = {"zoom in", "zoom out", "autoscale", "reset axes", "zoom", "pan", "download plot as a png"}


def shown(text: str, directory: Path) -> str:
    """What a browser, which reaches nothing, makes of a page."""
    page = directory / "page.html"
    page.write_text(text, encoding="utf-8")
    flags = ["--host-resolver-rules=MAP * ~NOTFOUND", f"--user-data-dir={directory / 'profile'}"]
    command = [str(CHROMIUM), *QUIET, *flags, "--virtual-time-budget=5000", "--dump-dom", page.as_uri()]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=True)
    assert "CONSOLE" not in done.stderr, done.stderr
    return done.stdout


@needs_browser
@pytest.mark.parametrize("runs", [[("run", INTERLINK)], [("a", INTERLINK), ("b", CAR)]])
def test_page_shows_every_curve_with_nothing_from_elsewhere(
    runs: list[tuple[str, Response]], tmp_path: Path
) -> None:
    from yawdamp_ros.pictures import runs_page  # noqa: PLC0415 - plotly is optional

    page = shown(runs_page.runs_page(runs), tmp_path)
    panels = run_panels(runs)
    assert len(re.findall(r'class="trace scatter', page)) == sum(len(panel.curves) for panel in panels)
    # None of them sends the run anywhere.
    assert set(re.findall(r'class="modebar-btn[^>]* data-title="([^"]*)"', page.lower())) == BUTTONS
    for panel in panels:
        assert f">{panel.y_label}</text>" in page
    assert ">trailer_2<" in page or ">trailer_2, a<" in page


def test_names_are_no_markup() -> None:
    from yawdamp_ros.pictures import runs_page  # noqa: PLC0415 - plotly is optional

    text = runs_page.runs_page([("<b>a</b>", CAR), ("</script>", CAR)])
    assert "<title>&lt;b&gt;a&lt;/b&gt;, &lt;/script&gt;</title>" in text
    assert "<b>a</b>" not in text


def test_the_same_runs_give_the_same_page() -> None:
    from yawdamp_ros.pictures import runs_page  # noqa: PLC0415 - plotly is optional

    assert runs_page.runs_page([("run", INTERLINK)]) == runs_page.runs_page([("run", INTERLINK)])


def test_a_long_run_is_thinned_and_that_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    from yawdamp_ros.pictures import runs_page  # noqa: PLC0415 - plotly is optional

    assert "one sample in" not in runs_page.runs_page([("run", CAR)])
    monkeypatch.setattr(runs_page, "MOST_SAMPLES", len(CAR.time) // 2)
    assert "run: one sample in 3 is shown" in runs_page.runs_page([("run", CAR)])


def test_what_happened_is_marked_and_no_range_of_a_linear_model_is_shaded() -> None:
    from yawdamp_ros.pictures import runs_page  # noqa: PLC0415 - plotly is optional

    rolled = simulate(
        load_vehicle("a_double"), Step(amplitude=0.12), 4.0, sample_period=0.05, model="nonlinear"
    )
    assert rolled.events[-1].final
    text = runs_page.runs_page([("run", rolled)])
    assert "rollover of semitrailer_1" in text
    assert runs_page.BEYOND not in text
