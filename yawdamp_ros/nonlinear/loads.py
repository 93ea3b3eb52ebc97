"""Vertical loads of axles and hitches, with what pitching shifts."""

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.nonlinear.compiled import compiled
from yawdamp_ros.nonlinear.layout import roll_index
from yawdamp_ros.nonlinear.records import (
    CARRIED,
    FRONT_SHARE,
    HITCH_LOAD,
    REAR_HITCH,
    REAR_SHARE,
    STATIC_LOAD,
    SUPPORT_FRONT,
    SUPPORT_REAR,
    Parameters,
    Work,
)


@compiled
def vertical_loads(state: FloatArray, weight: float, p: Parameters, w: Work) -> None:
    """Loads by statics, from the rearmost unit forwards.

    A unit rests on two supports. With the load Z on its rear hitch and the moment G of the longitudinal
    forces about the road, forward positive, moments balance as ``sum x_i N_i = rear_hitch Z + G``.

    Parameters
    ----------
    state : ndarray
    weight : float
        Normal gravity over standard gravity.
    p, w
        `Work.axle_load` and `Work.hitch_load` are written [N].
    """
    unit_table, axle_table, unit_work, axle_loads = p.units, p.axles, w.units, w.axle_loads
    units = unit_table.shape[0]
    moments = roll_index(units) + 2 * units
    behind = 0.0  # change of the load on the rear hitch
    for back in range(units):
        unit = units - 1 - back
        front, rear = unit_table[unit, SUPPORT_FRONT], unit_table[unit, SUPPORT_REAR]
        change = 0.0
        if front != rear:
            change = ((unit_table[unit, REAR_HITCH] - rear) * behind + state[moments + unit]) / (front - rear)
        on_rear = behind - change
        for axle in range(p.first_axle[unit], p.first_axle[unit + 1]):
            shifted = axle_table[axle, FRONT_SHARE] * change + axle_table[axle, REAR_SHARE] * on_rear
            axle_loads[axle] = max(weight * axle_table[axle, STATIC_LOAD] + shifted, 0.0)
        unit_work[unit, CARRIED] = weight * unit_table[unit, HITCH_LOAD] + change
        behind = change
