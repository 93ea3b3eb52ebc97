"""Whole runs in memory, for notebooks, tables and files."""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from yawdamp_ros.dynamics import linear_model
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.stepping.errors import SteppingError
from yawdamp_ros.stepping.sample import Sample
from yawdamp_ros.stepping.stepper import Stepper
from yawdamp_ros.stepping.time_grid import TimeGrid
from yawdamp_ros.vehicle import Vehicle

Steering = Callable[[float], float]
"""Road-wheel steer angle in rad at a time in s."""


@dataclass(frozen=True)
class Response:
    """What n units do over m samples.

    Attributes
    ----------
    unit_names : tuple of str
    time : ndarray, shape (m,)
        In s.
    steering_angle : ndarray, shape (m,)
        Road-wheel steer angle in rad, in force from that instant on.
    yaw, yaw_rate, lateral_acceleration : ndarray, shape (m, n)
        rad, rad/s, m/s^2.
    articulation : ndarray, shape (m, n - 1)
        rad.
    x, y : ndarray, shape (m, n)
        Centres of gravity in the ground frame, m.
    """

    unit_names: tuple[str, ...]
    time: FloatArray
    steering_angle: FloatArray
    yaw: FloatArray
    yaw_rate: FloatArray
    lateral_acceleration: FloatArray
    articulation: FloatArray
    x: FloatArray
    y: FloatArray

    @classmethod
    def of(cls, samples: Iterable[Sample], unit_names: Sequence[str], grid: TimeGrid) -> "Response":
        """Gather samples, at least one, into arrays."""
        taken = list(samples)

        def stacked(field: str) -> FloatArray:
            return np.array([getattr(sample, field) for sample in taken])

        return cls(
            unit_names=tuple(unit_names),
            time=np.array([grid.seconds(sample.step) for sample in taken]),
            steering_angle=stacked("steering_angle"),
            yaw=stacked("yaw"),
            yaw_rate=stacked("yaw_rate"),
            lateral_acceleration=stacked("lateral_acceleration"),
            articulation=stacked("articulation"),
            x=stacked("x"),
            y=stacked("y"),
        )


def sample_run(stepper: Stepper, grid: TimeGrid, steering: Steering, duration: float) -> Iterator[Sample]:
    """Samples of a run from its first instant to its last, as they come.

    Parameters
    ----------
    stepper : Stepper
        At step 0.
    grid : TimeGrid
    steering : callable
        Steer angle in rad at a time in s.
    duration : float
        In s; the last sample is at the last sample period that fits.

    Yields
    ------
    Sample
    """

    def drive(stepper: Stepper) -> None:
        stepper.steer(steering(grid.seconds(stepper.step)))

    yield stepper.run(0, drive)
    for _ in range(grid.samples_in(duration)):
        yield stepper.run(grid.steps_per_sample, drive)


def simulate(  # noqa: PLR0913 - each is one setting of a run
    vehicle: Vehicle,
    steering: Steering,
    duration: float,
    *,
    step_size: float = 0.001,
    sample_period: float | None = None,
    speed: float | None = None,
    model: str = "consistent",
) -> Response:
    """Response of a vehicle from rest to a steering function.

    Parameters
    ----------
    vehicle : Vehicle
    steering : callable
        Road-wheel steer angle in rad at a time in s, as the manoeuvres are.
    duration : float
        In s.
    step_size : float
        Fixed step in s; the steering is held over each.
    sample_period : float, optional
        Time between samples in s; the step unless given.
    speed : float, optional
        Longitudinal speed in m/s; the vehicle's own unless given.
    model : str
        One of `yawdamp_ros.dynamics.MODELS`.

    Returns
    -------
    Response

    Raises
    ------
    SteppingError
        If the times do not fit together.
    DynamicsError
        If there is no such model at that speed.
    """
    if not (math.isfinite(duration) and duration >= 0.0):
        message = f"duration: {duration}: expected a time in s, 0 or more"
        raise SteppingError(message)
    grid = TimeGrid.of(step_size, step_size if sample_period is None else sample_period)
    stepper = Stepper(linear_model(vehicle, speed, model), grid.step_size)
    return Response.of(sample_run(stepper, grid, steering, duration), vehicle.unit_names, grid)
