"""Events of a run are in its recording at their simulated time, and marks in its picture."""

from pathlib import Path

import pytest

from yawdamp_ros.cli.simulate import main
from yawdamp_ros.pictures.runs import runs_figure
from yawdamp_ros.runs.resimulation import Resimulation
from yawdamp_ros.runs.response_recording import read_response_recording


def test_events_are_recorded_read_drawn_and_do_not_disturb_the_repetition(tmp_path: Path) -> None:
    arguments = "--vehicle a_double --model nonlinear --manoeuvre step --amplitude 0.1 --duration 15"
    output = tmp_path / "run"
    main([*arguments.split(), "--output", str(output)])
    run = read_response_recording(output)
    names = [event.name for event in run.events]
    assert names[0] == "wheel_lift"
    assert names[-1] == "rollover"
    assert run.events[-1].final
    assert not any(event.final for event in run.events[:-1])
    assert run.event_times == pytest.approx([event.step / 1000 for event in run.events])
    assert 0.5 < run.event_times[0] < run.event_times[-1] <= run.time[-1] + 0.011
    figure = runs_figure([("roll", run)])
    noted = [text.get_text() for text in figure.axes[0].texts]
    assert any(text.startswith("rollover of") for text in noted)
    again = Resimulation(output)
    list(again.compare())
    assert (again.bit_identical, again.agrees) == (True, True)
