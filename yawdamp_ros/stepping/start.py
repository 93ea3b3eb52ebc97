"""Where a run begins, and returns to when it is reset."""

from typing import NamedTuple


class Start(NamedTuple):
    """Pose of a combination at the start.

    Attributes
    ----------
    x, y : float
        Centre of gravity of the lead unit in the ground frame [m].
    yaw : float
        Of the lead unit [rad].
    articulation : tuple of float
        Of every joint [rad]; empty: straight.
    """

    x: float = 0.0
    y: float = 0.0
    yaw: float = 0.0
    articulation: tuple[float, ...] = ()
