"""Response of the nonlinear model's rates to small forces on its units."""

import math

import numpy as np

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.nonlinear.chain import equations_of_motion
from yawdamp_ros.nonlinear.dynamics import NonlinearDynamics
from yawdamp_ros.nonlinear.layout import CROSSFALL, GRADE
from yawdamp_ros.nonlinear.motion import rates
from yawdamp_ros.nonlinear.records import FORCE_Y, ROLL_MOMENT, YAW_MOMENT, make_work
from yawdamp_ros.vehicle import STANDARD_GRAVITY

PUSHES = (FORCE_Y, YAW_MOMENT, ROLL_MOMENT)


def push_response(dynamics: NonlinearDynamics, state: FloatArray, inputs: FloatArray) -> FloatArray:
    """Change of the state's rates by a force of 1 N or a moment of 1 N m on each unit.

    The accelerations are linear in the forces, so that nothing is neglected.

    Parameters
    ----------
    dynamics : NonlinearDynamics
    state, inputs : ndarray
        State of a straight motion along X on a road of some crossfall, and its inputs.

    Returns
    -------
    ndarray, shape (m, n, 3)
        For each element of the state and each unit: by a lateral force at the road below the centre of
        gravity, by a yaw moment, and by a roll moment about the roll axis.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> car = NonlinearDynamics(load_vehicle("single_vehicle"))
    >>> response = push_response(car, car.initial_state(20.0), car.inputs())
    >>> bool(np.isclose(response[car.layout.yaw_rate, 0, 1], 1.0 / car.vehicle.units[0].yaw_inertia)[0])
    True
    """
    p, layout = dynamics.parameters, dynamics.layout
    work, row = make_work(layout.units, layout.axles), np.array(inputs, float)
    at = np.array(state, float)
    fall = STANDARD_GRAVITY / math.hypot(1.0, row[GRADE], row[CROSSFALL])
    pull = -fall * row[GRADE], -fall * row[CROSSFALL]
    moving = [*range(layout.velocity.start, layout.velocity.stop)]
    moving += [*range(layout.yaw_rate.start, layout.yaw_rate.stop)]
    moving += [*range(layout.roll_rate.start, layout.roll_rate.stop)]
    rates(at, row, p, work, np.zeros(layout.size))

    def accelerations() -> FloatArray:
        equations_of_motion(at, *pull, fall, p, work)
        return work.solution.copy()

    found = np.zeros((layout.size, layout.units, len(PUSHES)))
    still = accelerations()
    for unit in range(layout.units):
        for place, column in enumerate(PUSHES):
            work.units[unit, column] += 1.0
            found[moving, unit, place] = accelerations() - still
            work.units[unit, column] -= 1.0
    return found
