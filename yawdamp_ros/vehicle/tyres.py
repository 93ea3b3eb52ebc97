"""Cornering stiffness of truck tyres from the load that they carry.

Both formulas share one shape in the load. Fancher's generic truck tyre, as Frerichs (2012) cites it, is
``C = F (0.1 - F / 300000)`` with F in lbf and C in lbf/deg, which in SI units is `fancher_stiffness`. The
report's Table 5 holds `printed_stiffness` instead, pi times Fancher's for the front axle's two tyres and
pi/2 times for an axle of four.
"""

import math

POUNDS_FORCE_PER_NEWTON = 0.2248
"""Conversion [lbf/N], rounded as in the report: the exact 0.224809 would not give Table 5."""


def fancher_stiffness(load: float) -> float:
    """Return the cornering stiffness of one tyre by Fancher's generic truck tyre.

    Parameters
    ----------
    load : float
        Vertical load of the tyre [N]. The formula peaks at 15000 lbf, 66.7 kN.

    Returns
    -------
    float
        In N/rad.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import fancher_stiffness
    >>> round(fancher_stiffness(30000.0))
    133247
    """
    return math.degrees(1.0) * load * _per_degree(load)


def printed_stiffness(load: float) -> float:
    """Return the cornering stiffness of one **axle** as Table 5 of Frerichs (2012) prints it.

    Whatever the number of tyres on the axle, it is ``360 z (0.1 - z_lbf / 300000)`` of the load z per
    tyre; kept to show where that table comes from. It gives the printed numbers to 2e-5.

    Parameters
    ----------
    load : float
        Vertical load of each tyre [N].

    Returns
    -------
    float
        In N/rad.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import printed_stiffness
    >>> round(printed_stiffness(32864.0))
    891752
    """
    return 360.0 * load * _per_degree(load)


def _per_degree(load: float) -> float:
    """Cornering coefficient in 1/deg: side force per degree over load."""
    return 0.1 - load * POUNDS_FORCE_PER_NEWTON / 300000.0
