"""Roughness of a road: the spectra of its two wheel tracks, scaled by the International Roughness Index.

The surface is a stationary, isotropic random one whose profile has the spectrum ``G(W) = C / W^2`` over the
wavenumber W [rad/m], which ISO 8608 standardises. Isotropy gives the coherence of two parallel tracks (Dodds
and Robson, J. Sound Vib. 31, 1973); for this spectrum, at a distance d, it is ``W d K1(W d)`` with the
modified Bessel function K1. Sum and difference of the tracks are uncorrelated.

The index is the mean rate of a quarter car's suspension over its speed, 80 km/h (Sayers, Transp. Res. Rec.
1501, 1995), for a stationary profile ``sqrt(2 / pi)`` times the standard deviation.
"""

import math

import numpy as np
from scipy.integrate import trapezoid
from scipy.special import k1

from yawdamp_ros.dynamics.kinematics import FloatArray

DAMPING, TYRE, SPRING, WHEEL = 6.0, 653.0, 63.3, 0.15
"""The index's quarter car, over its sprung mass: 1/s, 1/s^2, 1/s^2 and 1."""
INDEX_SPEED = 80.0 / 3.6
"""In m/s."""
AVERAGE = 0.25
"""Length of the moving average that the index takes of a profile first [m]."""
_WAVENUMBERS = np.geomspace(0.01, 100.0, 4000)


def suspension_gain(wavenumber: FloatArray, average: float = AVERAGE) -> FloatArray:
    """Amplitude of the quarter car's rate of deflection over its speed, for one of the profile's slope.

    Parameters
    ----------
    wavenumber : ndarray, shape (m,)
        Wavenumbers [rad/m].
    average : float
        Length of the moving average [m]; 0 for none.

    Returns
    -------
    ndarray, shape (m,)

    Examples
    --------
    >>> float(suspension_gain(np.array([2.0 * math.pi * 0.065]))[0].round(1))
    1.5
    """
    s = 1j * INDEX_SPEED * wavenumber
    link = DAMPING * s + SPRING
    body, wheel = s**2 + link, WHEEL * s**2 + link + TYRE
    lifted = TYRE * body / (body * wheel - link**2)
    deflection = lifted * (link / body - 1.0)
    return np.asarray(np.abs(deflection * np.sinc(average * wavenumber / math.tau)))


def roughness_index(unevenness: float, average: float = AVERAGE) -> float:
    """International Roughness Index of a road.

    Parameters
    ----------
    unevenness : float
        Spectral density at 1 rad/m [m^3].
    average : float
        Length of the moving average [m]; 0 for none.

    Returns
    -------
    float
        In m/m: 0.001 is 1 m/km.

    Examples
    --------
    >>> round(1000.0 * roughness_index(1e-6), 2)  # class A of ISO 8608, m/km
    2.17
    """
    variance = unevenness * trapezoid(suspension_gain(_WAVENUMBERS, average) ** 2, _WAVENUMBERS)
    return math.sqrt(2.0 / math.pi * variance)


def unevenness_of(index: float) -> float:
    """Unevenness of the road that has an International Roughness Index.

    Parameters
    ----------
    index : float
        In m/m.

    Returns
    -------
    float
        Spectral density at 1 rad/m [m^3].

    Examples
    --------
    >>> round(1e6 * unevenness_of(0.0038), 2)
    3.08
    """
    return float((index / roughness_index(1.0)) ** 2)


def track_spectra(unevenness: float, wavenumber: FloatArray, track: float) -> tuple[FloatArray, FloatArray]:
    """Spectral densities of the mean height of both wheel tracks and of the crossfall between them.

    Parameters
    ----------
    unevenness : float
        Spectral density of the profile at 1 rad/m [m^3].
    wavenumber : ndarray, shape (m,)
        Wavenumbers [rad/m].
    track : float
        Distance of the tracks [m].

    Returns
    -------
    height, crossfall : ndarray, shape (m,)
        In m^3 and in m.

    Examples
    --------
    >>> height, crossfall = track_spectra(1e-6, np.array([20.0]), 2.0)  # short waves are independent
    >>> bool(np.isclose(height[0], 0.5e-6 / 20.0**2)), bool(np.isclose(crossfall[0], 2e-6 / 20.0**2 / 4.0))
    (True, True)
    """
    profile = unevenness / wavenumber**2
    coherence = wavenumber * track * k1(wavenumber * track)
    return 0.5 * profile * (1.0 + coherence), 2.0 * profile * (1.0 - coherence) / track**2
