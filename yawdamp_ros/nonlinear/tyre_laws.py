"""Lateral force of one wheel by slip, load and friction."""

import math

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.nonlinear.compiled import compiled
from yawdamp_ros.nonlinear.records import LINEAR, MAGIC_FORMULA

(
    FNOMIN, PCY1, PDY1, PDY2, PEY1, PEY2, PEY3, PKY1, PKY2, PHY1, PHY2, PVY1, PVY2,
    LFZO, LCY, LMUY, LEY, LKY, LHY, LVY, PDX1, PDX2, LMUX,
) = range(23)  # fmt: skip
"""Columns of `Parameters.magic`, by the names of the standard."""

LIFTED = 1e-3
"""Load below which a wheel carries nothing [N]."""


@compiled
def brush_force(slip: float, stiffness: float, limit: float) -> float:
    """Lateral force of the brush tyre with parabolic pressure.

    Fiala's formula: Pacejka, Tire and Vehicle Dynamics, 3rd ed. 2012, section 3.2.1.

    Parameters
    ----------
    slip : float
        Lateral slip, the tangent of the slip angle, positive where the wheel slides to the right.
    stiffness : float
        Cornering stiffness [N/rad].
    limit : float
        Friction times load [N]; may be infinite.

    Returns
    -------
    float
        Force to the left [N].

    Examples
    --------
    >>> round(brush_force(1e-9, 1e5, 2e4) / 1e-9)  # for small slip the stiffness
    100000
    >>> brush_force(1.0, 1e5, 2e4)
    20000.0
    """
    linear = stiffness * slip
    used = abs(linear) / (3.0 * limit) if limit > 0.0 else 1.0
    if used >= 1.0:
        return math.copysign(limit, slip)
    return linear * (1.0 - used + used * used / 3.0)


@compiled
def magic_formula_force(slip: float, load: float, scale: float, row: FloatArray) -> float:
    """Lateral force of one tyre by the magic formula, PAC2002 and MF-Tyre 5.2 without camber.

    Pacejka, Tyre and Vehicle Dynamics, 2nd ed. 2006, equations 4.E19 to 4.E30.

    Parameters
    ----------
    slip : float
        Tangent of the slip angle, positive where the tyre slides to the right.
    load : float
        Load [N], positive.
    scale : float
        Friction over that of the tyre's own road.
    row : ndarray, shape (23,)
        Row of `Parameters.magic`.

    Returns
    -------
    float
        Force to the left [N].
    """
    nominal = row[LFZO] * row[FNOMIN]
    change = (load - nominal) / nominal
    friction = (row[PDY1] + row[PDY2] * change) * row[LMUY] * scale
    peak = friction * load
    shift = (row[PHY1] + row[PHY2] * change) * row[LHY]
    angle = shift - math.atan(slip)
    cornering = row[PKY1] * nominal * math.sin(2.0 * math.atan(load / (row[PKY2] * nominal))) * row[LKY]
    shape = row[PCY1] * row[LCY]
    sign = 1.0 if angle > 0.0 else -1.0
    curvature = min((row[PEY1] + row[PEY2] * change) * (1.0 - row[PEY3] * sign) * row[LEY], 1.0)
    product = shape * peak
    stretched = (cornering / product if product != 0.0 else 0.0) * angle
    offset = load * (row[PVY1] + row[PVY2] * change) * row[LVY] * row[LMUY] * scale
    inner = stretched - curvature * (stretched - math.atan(stretched))
    return float(peak * math.sin(shape * math.atan(inner)) + offset)


@compiled
def lateral_force(
    model: int, slip: float, load: float, friction: float, stiffness: float, tyres: float, scale: float,
    side: float, magic: FloatArray, axle: int,
) -> float:  # fmt: skip
    """Lateral force of a wheel without longitudinal force [N].

    ``side`` is 1 on the left and -1 on the right; ``magic`` is `Parameters.magic`, whose row is looked up
    where it is needed alone: a view costs as much as the rest.
    """
    if model == LINEAR:
        return stiffness * slip
    if model == MAGIC_FORMULA:
        # A tyre's asymmetry is mirrored on the other side.
        return side * tyres * magic_formula_force(side * slip, load / tyres, scale, magic[axle])
    return brush_force(slip, stiffness, friction * load)


@compiled
def longitudinal_limit(
    model: int, load: float, friction: float, tyres: float, scale: float, magic: FloatArray, axle: int
) -> float:
    """Largest longitudinal force of a wheel [N]."""
    if model == MAGIC_FORMULA and magic[axle, PDX1] > 0.0:
        row = magic[axle]
        nominal = row[LFZO] * row[FNOMIN]
        change = (load / tyres - nominal) / nominal
        return float(max((row[PDX1] + row[PDX2] * change) * row[LMUX] * scale, 0.0) * load)
    return friction * load
