"""The road of the tracking ability: its index by the standard's quarter car, its tracks by isotropy."""

import math

import numpy as np
import pytest
from scipy.integrate import quad, trapezoid
from scipy.signal import cont2discrete, lfilter, ss2tf

from yawdamp_ros.analysis.roughness import (
    DAMPING,
    INDEX_SPEED,
    SPRING,
    TYRE,
    WHEEL,
    roughness_index,
    suspension_gain,
    track_spectra,
    unevenness_of,
)

STEP = 0.05
"""Interval of a sampled profile [m]."""


def profile(unevenness: float, length: int) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    """Gaussian profile of the spectrum, with random phases."""
    wavenumbers = math.tau * np.fft.rfftfreq(length, STEP)
    density = np.zeros(len(wavenumbers))
    density[1:] = unevenness / wavenumbers[1:] ** 2
    amplitudes = np.sqrt(2.0 * density * wavenumbers[1])
    phases = np.random.default_rng(17).uniform(0.0, math.tau, len(wavenumbers))
    return np.fft.irfft(0.5 * length * amplitudes * np.exp(1j * phases), length)


def test_the_quarter_car_answers_most_to_the_published_wavelengths() -> None:
    """About 15 m and 2.4 m: Sayers and Karamihas, The little book of profiling, UMTRI, 1998."""
    cycles = np.geomspace(0.01, 2.0, 4000)
    gain = suspension_gain(math.tau * cycles, average=0.0)
    inner = gain[1:-1]
    peaks = cycles[1:-1][(inner > gain[:-2]) & (inner > gain[2:])]
    assert peaks == pytest.approx([0.065, 0.42], rel=0.05)


def test_the_index_of_a_standard_road_is_the_published_one() -> None:
    """2.21 m/km for an unevenness of 1e-6 m^3 and a waviness of 2: Kropac and Mucka, IJVD 36, 2004."""
    assert 1000.0 * roughness_index(1e-6, average=0.0) == pytest.approx(2.21, abs=0.005)
    assert roughness_index(unevenness_of(0.0038)) == pytest.approx(0.0038)


def test_the_index_is_that_of_the_quarter_car_driven_over_a_profile() -> None:
    """The definition in time: moving average of 250 mm, 80 km/h, mean rate of the suspension."""
    heights = profile(unevenness_of(0.0038), 400_000)
    smooth = lfilter(np.ones(5) / 5.0, 1.0, heights)
    matrix = np.array(
        [
            [0.0, 1.0, 0.0, 0.0],
            [-SPRING, -DAMPING, SPRING, DAMPING],
            [0.0, 0.0, 0.0, 1.0],
            [SPRING / WHEEL, DAMPING / WHEEL, -(SPRING + TYRE) / WHEEL, -DAMPING / WHEEL],
        ]
    )
    inputs, seen = np.array([[0.0], [0.0], [0.0], [TYRE / WHEEL]]), np.array([[0.0, 1.0, 0.0, -1.0]])
    system = matrix, inputs, seen, np.zeros((1, 1))
    numerator, denominator = ss2tf(*cont2discrete(system, STEP / INDEX_SPEED, method="foh")[:4])
    rate = lfilter(numerator[0], denominator, smooth)
    index = np.abs(rate[2000:]).mean() / INDEX_SPEED
    assert index == pytest.approx(0.0038, rel=0.02)


def test_coherence_of_the_tracks_is_that_of_an_isotropic_surface() -> None:
    """The surface's spectrum is as (W^2 + V^2)^(-3/2); across it V counts from one track to the other."""
    track = 1.9
    for wavenumber in (0.1, 1.0, 3.0):

        def surface(across: float, along: float = wavenumber) -> float:
            return float((along**2 + across**2) ** -1.5)

        cross, _ = quad(surface, 0.0, np.inf, weight="cos", wvar=track)
        own, _ = quad(surface, 0.0, np.inf)
        height, crossfall = track_spectra(1.0, np.array([wavenumber]), track)
        assert height[0] == pytest.approx(0.5 * (1.0 + cross / own) / wavenumber**2, rel=1e-6)
        assert crossfall[0] == pytest.approx(2.0 * (1.0 - cross / own) / (wavenumber * track) ** 2, rel=1e-6)


def test_a_rougher_road_has_a_higher_index_by_the_root() -> None:
    assert roughness_index(4e-6) == pytest.approx(2.0 * roughness_index(1e-6))
    wavenumbers = np.geomspace(0.01, 10.0, 50)
    low, high = (trapezoid(track_spectra(c, wavenumbers, 2.0)[1], wavenumbers) for c in (1e-6, 2e-6))
    assert high == pytest.approx(2.0 * low)
