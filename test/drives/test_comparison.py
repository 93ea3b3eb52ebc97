"""What a comparison says of signals that are known."""

import numpy as np
import pytest

from yawdamp_ros.drives import Channel, Drive, DriveError, Match, compare, excitation, matches
from yawdamp_ros.drives.comparison import compare_channel

TIMES = 0.01 * np.arange(6001)
SIGNAL = 0.1 * np.sin(TIMES) + 0.05 * np.sin(3.0 * TIMES)


def channel(values: np.ndarray, name: str = "truck/yaw_rate", times: np.ndarray = TIMES) -> Channel:
    return Channel(name, "made", times, values)


def compared(values: np.ndarray, times: np.ndarray = TIMES):  # noqa: ANN201
    return compare_channel(Match("truck/yaw_rate", channel(values, times=times)), TIMES, SIGNAL)


def test_a_signal_agrees_with_itself() -> None:
    found = compared(SIGNAL)
    assert (found.bias, found.rms_error, found.r_squared) == (0.0, 0.0, 1.0)
    assert found.gain == pytest.approx(1.0)
    assert found.lag == pytest.approx(0.0, abs=1e-6)
    assert found.attainable > 0.999
    assert found.in_band(0.1, 0.6) == pytest.approx(1.0)


def test_bias_gain_and_lag_are_told_apart() -> None:
    found = compared(0.02 + 1.25 * np.interp(TIMES - 0.13, TIMES, SIGNAL))
    assert found.bias == pytest.approx(0.02, abs=2e-3)
    assert found.gain == pytest.approx(1.25, rel=5e-3)
    assert found.lag == pytest.approx(0.13, abs=2e-3)
    assert found.r_squared < 0.95


def test_a_measurement_of_a_tenth_of_the_rate_is_compared_at_its_own_times() -> None:
    times = 0.003 + 0.1 * np.arange(590)
    found = compared(np.interp(times, TIMES, SIGNAL), times)
    assert len(found.times) == 590
    assert found.r_squared == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize("size", [0.002, 0.05])
def test_white_noise_is_the_noise_floor_and_what_it_leaves_is_attainable(size: float) -> None:
    noise = size * np.random.default_rng(1).normal(size=len(TIMES))
    found = compared(SIGNAL + noise)
    assert found.noise == pytest.approx(size, rel=0.03)
    assert found.r_squared == pytest.approx(found.attainable, abs=0.01)


def test_noise_alone_is_not_coherent() -> None:
    found = compared(np.random.default_rng(2).normal(size=len(TIMES)))
    assert found.in_band(0.5, 5.0) < 0.4
    assert found.r_squared < 0.01


def test_a_few_samples_are_no_comparison() -> None:
    with pytest.raises(DriveError, match="truck/yaw_rate: 3 samples while it was steered"):
        compared(np.zeros(3), np.array([1.0, 2.0, 3.0]))


def test_nothing_measured_is_refused_with_what_could_be() -> None:
    with pytest.raises(DriveError, match="nothing measured to compare with; expected one of truck/yaw_rate"):
        compare([], TIMES, {"truck/yaw_rate": SIGNAL})


def test_channels_of_no_unit_are_the_lead_units() -> None:
    held = {
        name: channel(SIGNAL, name) for name in ("steering", "yaw_rate", "trailer/yaw_rate", "articulation_1")
    }
    matched, notes = matches(Drive("made", held), ("truck", "trailer"))
    assert [match.output for match in matched] == ["trailer/yaw_rate", "truck/yaw_rate", "articulation_1"]
    assert not notes


def test_of_two_strangers_none_is_taken() -> None:
    held = {name: channel(SIGNAL, name) for name in ("front/yaw_rate", "rear/yaw_rate", "articulation_3")}
    matched, notes = matches(Drive("made", held), ("truck", "trailer"))
    assert not matched
    assert notes == [
        "articulation_3: the vehicle has no such joint",
        (
            "front/yaw_rate, rear/yaw_rate: of no unit of the vehicle; "
            "say --channel truck/yaw_rate=PLACE to take one"
        ),
    ]


def test_excitation_is_of_the_steering_about_its_mean() -> None:
    steering = channel(0.01 + 0.02 * np.sin(2.0 * np.pi * 0.5 * TIMES), "steering")
    excited = excitation(Drive("made", {"steering": steering}), 20.0)
    assert excited.steering_rms == pytest.approx(0.02 / np.sqrt(2.0), rel=1e-3)
    assert excited.steering_bandwidth == pytest.approx(0.5, abs=0.1)
    assert (excited.lowest_speed, excited.highest_speed, excited.duration) == (20.0, 20.0, 60.0)
