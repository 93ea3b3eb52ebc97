"""How often the intervals of a fit hold the truth."""

from collections.abc import Callable

import pytest

from made_drives import TRUTH, made_drive, source_of
from yawdamp_ros.drives import identify

SEEDS = 100


@pytest.mark.timeout(3600)
@pytest.mark.parametrize("name", ["truck_trailer", "interlink"])
def test_intervals_of_95_percent_hold_the_truth_in_93_of_100_drives_or_more(
    name: str, say: Callable[[str], None]
) -> None:
    inside = dict.fromkeys(TRUTH, 0)
    for seed in range(SEEDS):
        found = identify(made_drive(name, seed), source_of(name))
        for parameter, truth in TRUTH.items():
            inside[parameter] += found[parameter].low <= truth <= found[parameter].high
    say(f"{name}: of {SEEDS} intervals hold the truth " + ", ".join(f"{key} {inside[key]}" for key in inside))
    assert min(inside.values()) >= 93
