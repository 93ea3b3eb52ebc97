"""Pose of a unit, the same for all displays."""

import cmath

import numpy as np

from yawdamp_ros.dynamics.kinematics import ComplexArray
from yawdamp_ros.stepping.sample import Sample


def half_turns(heading: ComplexArray) -> ComplexArray:
    """``cos(yaw / 2) + i sin(yaw / 2)`` by ``cos(yaw) + i sin(yaw)``: w and z of a quaternion."""
    half: ComplexArray = np.sqrt(heading)
    return half


def half_turn(angle: float) -> complex:
    """Half turn of one angle [rad]."""
    return cmath.exp(0.5j * angle)


def pose(sample: Sample, unit: int, ahead: float = 0.0) -> tuple[complex, complex]:
    """Pose of a unit at the one instant of a sample.

    Parameters
    ----------
    sample : Sample
    unit : int
    ahead : float
        Distance of the point ahead of the centre of gravity [m].

    Returns
    -------
    place : complex
        ``x + i y`` of the point in the ground frame, m.
    half : complex
        Half turn, as from `half_turns`.
    """
    heading = sample.heading[unit]
    place = complex(sample.x[unit], sample.y[unit]) + ahead * heading
    return complex(place), complex(half_turns(heading))
