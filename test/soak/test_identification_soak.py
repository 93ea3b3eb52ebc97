"""How often the intervals of a fit hold the truth."""

from collections.abc import Callable

import pytest

from made_drives import TRUTH, made_drive, source_of
from yawdamp_ros.drives import identify
from yawdamp_ros.drives.identification import predictor_of

SEEDS = 100


@pytest.mark.timeout(14400)
@pytest.mark.parametrize(
    "name, model",
    [("truck_trailer", "consistent"), ("interlink", "consistent"), ("interlink", "nonlinear")],
)
def test_intervals_of_95_percent_hold_the_truth_in_93_of_100_drives_or_more(
    name: str, model: str, say: Callable[[str], None]
) -> None:
    inside = dict.fromkeys(TRUTH, 0)
    predictor = predictor_of(model)
    for seed in range(SEEDS):
        drive = made_drive(name, seed, predictor=predictor)
        found = identify(drive, source_of(name), predictor=predictor)
        for parameter, truth in TRUTH.items():
            inside[parameter] += found[parameter].low <= truth <= found[parameter].high
    say(
        f"{name}, {model}: of {SEEDS} intervals hold the truth "
        + ", ".join(f"{key} {inside[key]}" for key in inside)
    )
    assert min(inside.values()) >= 93
