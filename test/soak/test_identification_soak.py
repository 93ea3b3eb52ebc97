"""How often the intervals of a fit hold the truth."""

from collections.abc import Callable

import numpy as np
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
    errors: dict[str, list[float]] = {key: [] for key in TRUTH}
    predictor = predictor_of(model)
    for seed in range(SEEDS):
        drive = made_drive(name, seed, predictor=predictor)
        found = identify(drive, source_of(name), predictor=predictor)
        for parameter, truth in TRUTH.items():
            estimate = found[parameter]
            inside[parameter] += estimate.low <= truth <= estimate.high
            errors[parameter].append((estimate.value - truth) / (estimate.high - estimate.low))
    # In standard errors, of which an interval has 3.92: 0 and 1, or a little less, if all is well.
    means = {key: 3.92 * np.mean(errors[key]) for key in TRUTH}
    deviations = {key: 3.92 * np.std(errors[key]) for key in TRUTH}
    say(
        f"{name}, {model}: of {SEEDS} intervals hold the truth "
        + ", ".join(f"{key} {inside[key]} ({means[key]:+.2f}, {deviations[key]:.2f})" for key in inside)
    )
    assert min(inside.values()) >= 93
