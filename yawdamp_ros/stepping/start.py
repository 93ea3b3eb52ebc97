"""Start of a run, to which a reset returns."""

from typing import NamedTuple


class Start(NamedTuple):
    """Pose of a combination at the start.

    Attributes
    ----------
    x, y : float
        Centre of gravity of the lead unit in the ground frame [m].
    yaw : float
        Yaw of the lead unit [rad].
    articulation : tuple of float
        Articulation of every joint [rad]; empty for a straight combination.

    Examples
    --------
    >>> from yawdamp_ros.stepping import Start
    >>> Start(x=10.0, yaw=0.5).articulation
    ()
    """

    x: float = 0.0
    y: float = 0.0
    yaw: float = 0.0
    articulation: tuple[float, ...] = ()
