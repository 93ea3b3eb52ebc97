"""The models that a run can follow, by name."""

from collections.abc import Callable, Mapping
from functools import partial
from types import MappingProxyType

from yawdamp_ros.dynamics import MODELS as LINEAR_MODELS
from yawdamp_ros.dynamics import linear_model
from yawdamp_ros.simulation.errors import SimulationError
from yawdamp_ros.stepping import Motion, Start, Stepper
from yawdamp_ros.vehicle import Vehicle

Factory = Callable[[Vehicle, float | None, float], Motion]
"""Function from vehicle, speed [m/s] (None for its own) and step size [s] to a motion at step 0."""


def _linear(name: str, vehicle: Vehicle, speed: float | None, step_size: float) -> Motion:
    return Stepper(linear_model(vehicle, speed, name), step_size)


def _nonlinear(vehicle: Vehicle, speed: float | None, step_size: float) -> Motion:
    # Numba takes long to import, which no other model waits for.
    from yawdamp_ros.simulation.nonlinear_motion import NonlinearMotion  # noqa: PLC0415

    return NonlinearMotion(vehicle, speed, step_size)


MODELS: Mapping[str, Factory] = MappingProxyType(
    {name: partial(_linear, name) for name in LINEAR_MODELS} | {"nonlinear": _nonlinear}
)
"""A model is added here, and nowhere else; what it needs is best imported in its factory."""


def make_motion(
    vehicle: Vehicle, model: str, speed: float | None, step_size: float, start: Start | None = None
) -> Motion:
    """Return the motion of a vehicle by a named model, at rest at the origin.

    Parameters
    ----------
    vehicle : Vehicle
    model : str
        One of `MODELS`.
    speed : float or None
        Longitudinal speed [m/s]; None for the vehicle's own.
    step_size : float
        Step size [s].
    start : Start, optional

    Returns
    -------
    Motion

    Raises
    ------
    SimulationError
        If there is no such model.
    YawdampError
        If the model cannot be of this vehicle at that speed.

    Examples
    --------
    >>> from yawdamp_ros.simulation import make_motion
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> motion = make_motion(load_vehicle("interlink"), "consistent", speed=20.0, step_size=0.001)
    >>> motion.run([0.01] * 1000).yaw_rate.round(4).tolist()
    [0.0305, 0.0306, 0.0214]
    """
    if model not in MODELS:
        message = f"model: {model!r}: expected one of {', '.join(MODELS)}"
        raise SimulationError(message)
    motion = MODELS[model](vehicle, speed, step_size)
    if start not in {None, Start()}:
        motion.begin(start)
    return motion
