"""Largest magnitudes of a run, as it goes."""

import numpy as np

from yawdamp_ros.stepping import Sample


class Peaks:
    """Running maxima of n units.

    Attributes
    ----------
    yaw, yaw_rate, lateral_acceleration : ndarray, shape (n,)
        Largest magnitude so far, rad, rad/s and m/s^2.
    """

    def __init__(self, units: int) -> None:
        self.yaw, self.yaw_rate, self.lateral_acceleration = np.zeros((3, units))

    def write(self, sample: Sample) -> None:
        """Take a sample of one or more instants into account."""
        for peak, values in (
            (self.yaw, sample.yaw),
            (self.yaw_rate, sample.yaw_rate),
            (self.lateral_acceleration, sample.lateral_acceleration),
        ):
            np.maximum(peak, np.abs(values).reshape(-1, len(peak)).max(axis=0), out=peak)

    def close(self) -> None:
        """See `Sink`; they stay to be read."""
