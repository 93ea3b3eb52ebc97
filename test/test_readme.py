"""The README is one page that says what the project does."""

import re
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from yawdamp_ros import load_vehicle, simulate
from yawdamp_ros.manoeuvres import LaneChange

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def test_it_is_one_page() -> None:
    assert README.count("\n") < 100


def test_everything_linked_is_there() -> None:
    for target in re.findall(r"\]\((?!https?:)([^)#]+)", README):
        assert (ROOT / target).is_file(), target


def test_its_picture_moves_and_is_small() -> None:
    (name,) = re.findall(r"\]\(([^)]+\.gif)\)", README)
    assert (ROOT / name).stat().st_size < 2_000_000
    with Image.open(ROOT / name) as picture:
        assert picture.n_frames > 50


def test_make_sim_drives_one_lane_within_the_linear_range() -> None:
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    (amplitude,) = re.findall(r"--manoeuvre lane_change --amplitude ([\d.]+) --duration 15", makefile)
    response = simulate(load_vehicle("interlink"), LaneChange(amplitude=float(amplitude)), 15.0)
    assert response.y[-1] == pytest.approx([3.5] * 3, abs=0.05)
    assert np.abs(response.lateral_acceleration).max() < 2.0
