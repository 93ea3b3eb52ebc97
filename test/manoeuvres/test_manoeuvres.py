import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from yawdamp_ros.manoeuvres import (
    MANOEUVRES,
    SETTINGS,
    Chirp,
    LaneChange,
    ManoeuvreError,
    Pulse,
    Ramp,
    Sine,
    Step,
    make_manoeuvre,
)


@pytest.mark.parametrize("name", MANOEUVRES)
@given(time=st.floats(-10.0, 1e4))
def test_no_manoeuvre_exceeds_its_amplitude_or_begins_before_its_start(name: str, time: float) -> None:
    manoeuvre = make_manoeuvre(name, {"amplitude": 0.2, "start": 3.0})
    assert abs(manoeuvre(time)) <= 0.2
    if time < 3.0:
        assert manoeuvre(time) == 0.0


def test_a_sine_goes_left_first_and_repeats() -> None:
    sine = Sine(amplitude=0.1, frequency=0.5, start=1.0)
    assert sine(1.5) == pytest.approx(0.1)
    assert sine(2.5) == pytest.approx(-0.1)
    assert sine(101.5) == pytest.approx(0.1)


def test_the_reports_sine_is_one_and_a_half_radians_a_second() -> None:
    assert Sine()(math.pi / 3.0) == pytest.approx(0.1)


def test_a_lane_change_is_one_cycle() -> None:
    lane_change = LaneChange(frequency=0.25)
    assert lane_change(2.0) == pytest.approx(0.1)
    assert lane_change(4.0) == pytest.approx(-0.1)
    assert lane_change(5.0001) == 0.0


def test_cycles_end_a_sine() -> None:
    assert Sine(frequency=1.0, cycles=2.0)(1.75) == pytest.approx(-0.1)
    assert Sine(frequency=1.0, cycles=2.0)(2.25) == 0.0


def test_a_step_begins_at_its_start() -> None:
    assert [Step()(time) for time in (0.999, 1.0, 50.0)] == [0.0, 0.1, 0.1]


def test_a_ramp_rises_and_is_held() -> None:
    ramp = Ramp(start=1.0, rise_time=2.0)
    assert [ramp(time) for time in (1.0, 2.0, 3.0, 9.0)] == pytest.approx([0.0, 0.05, 0.1, 0.1])


def test_a_pulse_ends() -> None:
    assert [Pulse()(time) for time in (0.9, 1.0, 1.49, 1.5)] == [0.0, 0.1, 0.1, 0.0]


def test_a_chirp_passes_through_its_frequencies_in_time() -> None:
    chirp = Chirp(amplitude=1.0, frequency=0.5, final_frequency=4.5, sweep_time=10.0)
    for time, frequency in ((0.0, 0.5), (5.0, 2.5), (10.0, 4.5)):
        # The phase's slope, from two instants that keep within the sweep.
        early, late = max(time - 1e-4, 0.0), min(time + 1e-4, 10.0)
        phase = [math.tau * t * (0.5 + 0.2 * t) for t in (early, late)]
        assert chirp(early) == pytest.approx(math.sin(phase[0]))
        assert (phase[1] - phase[0]) / (late - early) / math.tau == pytest.approx(frequency, abs=1e-4)
    assert chirp(10.001) == 0.0


@pytest.mark.parametrize(
    "name, settings, message",
    [
        ("slalom", {}, "manoeuvre: 'slalom': expected one of lane_change, sine"),
        ("step", {"frequency": 1.0}, "frequency: manoeuvre step does not use it; it takes amplitude, start"),
        ("sine", {"frequency": 0.0}, "frequency: 0.0: expected a number above 0"),
        ("sine", {"frequency": math.inf}, "frequency: inf: expected a number above 0"),
        ("pulse", {"width": -1.0}, "width: -1.0: expected a number above 0"),
        ("sine", {"cycles": -1.0}, "cycles: -1.0: expected a number, 0 or more"),
        ("step", {"start": math.nan}, "start: nan: expected a number, 0 or more"),
        ("step", {"amplitude": 5.7}, "amplitude: 5.7: expected an angle in rad of at most pi/2"),
    ],
)
def test_what_a_manoeuvre_cannot_take_is_refused(name: str, settings: dict[str, float], message: str) -> None:
    with pytest.raises(ManoeuvreError) as caught:
        make_manoeuvre(name, settings)
    assert message in str(caught.value)


def test_settings_are_those_that_some_manoeuvre_takes() -> None:
    assert set(SETTINGS) == {
        "amplitude",
        "frequency",
        "start",
        "cycles",
        "rise_time",
        "width",
        "final_frequency",
        "sweep_time",
    }
