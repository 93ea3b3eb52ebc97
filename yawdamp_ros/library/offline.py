"""A run in memory from any kind of steering."""

from pathlib import Path

import numpy.typing as npt

from yawdamp_ros import simulation
from yawdamp_ros.drives import Drive, DriveError
from yawdamp_ros.library.curves import Curves
from yawdamp_ros.simulation import Commands, Run, SimParameters, make_motion
from yawdamp_ros.stepping import Response, Sample, TimeGrid
from yawdamp_ros.stepping.response import Steering
from yawdamp_ros.vehicle import Vehicle, load_vehicle


def simulate(  # noqa: PLR0913 - each is one setting of a run
    vehicle: Vehicle | str | Path,
    steering: Steering | npt.ArrayLike | Drive,
    duration: float | None = None,
    *,
    step_size: float = 0.001,
    sample_period: float | None = None,
    speed: float | None = None,
    model: str = "consistent",
) -> Curves:
    """Response of a vehicle from rest to a function, an array, a manoeuvre or a recorded drive.

    Parameters
    ----------
    vehicle : Vehicle, str or Path
        A name or a path is loaded as `load_vehicle` does.
    steering : callable, array_like, shape (k,), or Drive
        Road-wheel steer angle [rad]: at a time [s], as the manoeuvres are, or of every step of the
        duration; or a drive, whose speed is followed, too, unless one is given.
    duration : float, optional
        Duration [s]; for a drive, its own unless given.
    step_size : float
        Fixed step [s]; the steering is held over each.
    sample_period : float, optional
        Time between samples [s]; the step unless given.
    speed : float, optional
        Longitudinal speed [m/s]; the drive's or the vehicle's own unless given.
    model : str
        One of `yawdamp_ros.simulation.MODELS`.

    Returns
    -------
    Curves

    Raises
    ------
    DriveError
        If there is no duration.
    SteppingError
        If the times do not fit together, or the motion overflows.
    VehicleError
        If there is no such vehicle.
    YawdampError
        If there is no such model of it at that speed.

    Examples
    --------
    >>> import numpy as np
    >>> simulate("interlink", np.full(2000, 0.01), 2.0)["trailer_1"].yaw_rate.shape
    (2001,)
    """
    if isinstance(steering, Drive):
        drive = steering if duration is None else steering.window(0.0, duration)
        grid = TimeGrid.of(step_size, step_size if sample_period is None else sample_period)
        found = vehicle if isinstance(vehicle, Vehicle) else load_vehicle(vehicle)
        end = drive.duration if duration is None else duration
        return Curves.of_response(_follow(found, drive, grid, end, speed, model))
    if duration is None:
        message = "duration: expected a time in s, which only a drive has of its own"
        raise DriveError(message)
    return Curves.of_response(
        simulation.simulate(
            vehicle,
            steering,
            duration,
            step_size=step_size,
            sample_period=sample_period,
            speed=speed,
            model=model,
        )
    )


class _Kept:
    """Keeps every sample of a run."""

    def __init__(self) -> None:
        self.samples: list[Sample] = []

    def write(self, sample: Sample) -> None:
        self.samples.append(sample)

    def close(self) -> None:
        """Do nothing: there is nothing to close."""


def _follow(  # noqa: PLR0913, PLR0917 - what `simulate` was told
    vehicle: Vehicle, drive: Drive, grid: TimeGrid, duration: float, speed: float | None, model: str
) -> Response:
    motion = make_motion(vehicle, model, speed, grid.step_size)
    followed = drive.speed(motion.speed) if speed is None else None
    log = drive["steering"].times.tolist(), drive["steering"].values.tolist()
    inputs = {} if followed is None else {"speed": (followed.times.tolist(), followed.values.tolist())}
    kept = _Kept()
    run = Run(motion, grid, Commands(SimParameters(), grid, motion, log, inputs), [kept])
    run.start()
    run.advance(grid.samples_in(duration))
    return Response.of(kept.samples, vehicle.unit_names, grid)
