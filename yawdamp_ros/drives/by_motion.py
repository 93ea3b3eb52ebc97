"""Prediction of a drive by any model, step by step: slower than `predict`."""

from collections.abc import Mapping

from yawdamp_ros.drives.prediction import STEP_SIZE, Inputs
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.simulation import make_motion
from yawdamp_ros.stepping import AppliedInput, Response, TimeGrid
from yawdamp_ros.vehicle import Vehicle

STEPS = 5
"""Steps of the motion from one instant to the next."""


def predict_by_motion(vehicle: Vehicle, inputs: Inputs, model: str) -> Mapping[str, FloatArray]:
    """Outputs of a vehicle at the instants of its inputs, from straight ahead at the first.

    Parameters
    ----------
    vehicle : Vehicle
    inputs : Inputs
    model : str
        One of `yawdamp_ros.simulation.MODELS`.

    Returns
    -------
    mapping of str to ndarray, shape (k,)
        As `predict`.
    """
    step = float(inputs.times[1] - inputs.times[0]) if len(inputs.times) > 1 else STEP_SIZE
    grid = TimeGrid.of(step / STEPS, step)
    speeds, angles = inputs.speed.tolist(), inputs.mean_steering.tolist()
    motion = make_motion(vehicle, model, speeds[0], grid.step_size)
    motion.apply(AppliedInput(0, "steering", angles[0]))
    samples = [motion.sample()]
    now = speeds[0]
    for speed, angle in zip(speeds[1:], angles[1:], strict=True):
        motion.advance(STEPS)
        if speed != now:
            motion.apply(AppliedInput(motion.step, "speed", speed))
            now = speed
        motion.apply(AppliedInput(motion.step, "steering", angle))
        samples.append(motion.sample())
    run = Response.of(samples, vehicle.unit_names, grid)
    units = {
        f"{unit}/{quantity}": getattr(run, quantity)[:, index]
        for quantity in ("yaw_rate", "lateral_acceleration", "yaw")
        for index, unit in enumerate(vehicle.unit_names)
    }
    joints = {f"articulation_{joint}": values for joint, values in enumerate(run.articulation.T, 1)}
    return {**units, **joints}
