"""Offline runs in memory: a vehicle and its steering in, arrays out."""

from pathlib import Path

import numpy as np
import numpy.typing as npt

from yawdamp_ros.simulation.models import make_motion
from yawdamp_ros.stepping import Response, SteppingError, TimeGrid
from yawdamp_ros.stepping.response import Steering, sample_run
from yawdamp_ros.vehicle import Vehicle, load_vehicle


def simulate(  # noqa: PLR0913 - each is one setting of a run
    vehicle: Vehicle | str | Path,
    steering: Steering | npt.ArrayLike,
    duration: float,
    *,
    step_size: float = 0.001,
    sample_period: float | None = None,
    speed: float | None = None,
    model: str = "consistent",
) -> Response:
    """Response of a vehicle from rest to steering.

    Parameters
    ----------
    vehicle : Vehicle, str or Path
        A name or a path is loaded as `load_vehicle` does.
    steering : callable or array_like, shape (k,)
        Road-wheel steer angle [rad]: at a time [s], as the manoeuvres are, or of every step of the
        duration, from 0 s on; one more value is that from the end on.
    duration : float
        Duration [s].
    step_size : float
        Fixed step [s]; the steering is held over each.
    sample_period : float, optional
        Time between samples [s]; the step unless given.
    speed : float, optional
        Longitudinal speed [m/s]; the vehicle's own unless given.
    model : str
        One of `yawdamp_ros.simulation.MODELS`.

    Returns
    -------
    Response

    Raises
    ------
    SteppingError
        If the times do not fit together, or the steering is neither a function nor an angle for every step,
        or the motion overflows.
    VehicleError
        If there is no such vehicle.
    DynamicsError
        If there is no such model at that speed.

    Examples
    --------
    >>> import numpy as np
    >>> simulate("interlink", np.full(2000, 0.01), 2.0).yaw_rate.shape
    (2001, 3)
    """
    if not isinstance(vehicle, Vehicle):
        vehicle = load_vehicle(vehicle)
    grid = TimeGrid.of(step_size, step_size if sample_period is None else sample_period)
    held = steering if callable(steering) else _held(steering, grid, duration)
    motion = make_motion(vehicle, model, speed, grid.step_size)
    return Response.of(sample_run(motion, grid, held, duration), vehicle.unit_names, grid)


def _held(steering: npt.ArrayLike, grid: TimeGrid, duration: float) -> Steering:
    """Steering function of angles given step by step."""
    steps = grid.samples_in(duration) * grid.steps_per_sample
    expected = (
        f"expected a function of time in s, or {steps} finite angles, one for every step of "
        f"{grid.step_size:g} s over {duration:g} s"
    )
    try:
        angles = np.asarray(steering, dtype=np.float64)
    except (TypeError, ValueError) as error:
        message = f"steering: {type(steering).__name__}: {expected}"
        raise SteppingError(message) from error
    if angles.ndim != 1 or len(angles) not in {steps, steps + 1} or not np.isfinite(angles).all():
        message = f"steering: an array of shape {angles.shape}: {expected}"
        raise SteppingError(message)
    last = len(angles) - 1
    return lambda time: float(angles[min(round(time / grid.step_size), last)])
