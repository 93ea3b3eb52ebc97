"""Prediction of a drive by the nonlinear model, step by step."""

from collections.abc import Mapping

import numpy as np

from yawdamp_ros.drives.prediction import STEP_SIZE, Inputs
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.nonlinear import NonlinearDynamics
from yawdamp_ros.nonlinear.layout import SPEED, STEERING
from yawdamp_ros.vehicle import Vehicle

STEPS = 5
"""Steps of the motion from one instant to the next."""
INSTANTS_AT_ONCE = 10_000


def predict_nonlinear(vehicle: Vehicle, inputs: Inputs) -> Mapping[str, FloatArray]:
    """Outputs of a vehicle at the instants of its inputs, from straight ahead at the first.

    The speed is what its controller holds. Threads predict side by side, for the steps run without Python's
    lock.

    Parameters
    ----------
    vehicle : Vehicle
    inputs : Inputs

    Returns
    -------
    mapping of str to ndarray, shape (k,)
        As `predict`; NaN after a motion that has ended, as by a rollover.

    Examples
    --------
    >>> import numpy as np
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> times, angles = 0.01 * np.arange(200), np.full(200, 0.02)
    >>> inputs = Inputs(times, angles, angles, np.full(200, 20.0))
    >>> outputs = predict_nonlinear(load_vehicle("truck_trailer"), inputs)
    >>> bool(outputs["truck/yaw_rate"][-1] > 0.05)  # to the left, rad/s
    True
    """
    count, units = len(inputs.times), len(vehicle.units)
    step = float(inputs.times[1] - inputs.times[0]) if count > 1 else STEP_SIZE
    dynamics = NonlinearDynamics(vehicle)
    held = np.tile(dynamics.inputs(), (count, 1))
    held[:, STEERING], held[:, SPEED] = inputs.mean_steering, inputs.speed
    states = np.full((count, dynamics.layout.size), np.nan)
    states[0] = dynamics.initial_state(float(inputs.speed[0]))
    for begin in range(0, count - 1, INSTANTS_AT_ONCE):
        rows = held[begin : min(begin + INSTANTS_AT_ONCE, count - 1)]
        run = dynamics.try_steps(states[begin], np.repeat(rows, STEPS, axis=0), step / STEPS, every=STEPS)
        states[begin + 1 : begin + 1 + len(run.states)] = run.states
        if len(run.states) < len(rows):
            break
    outputs = dynamics.outputs(states, held)
    named = {
        f"{unit}/{quantity}": values[:, index]
        for quantity, values in (
            ("yaw_rate", outputs.yaw_rate),
            ("lateral_acceleration", outputs.acceleration[..., 1]),
            ("yaw", outputs.yaw),
        )
        for index, unit in enumerate(vehicle.unit_names)
    }
    return named | {f"articulation_{joint + 1}": outputs.articulation[:, joint] for joint in range(units - 1)}
