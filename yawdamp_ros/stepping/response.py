"""Whole runs in memory, for notebooks, tables and files."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from yawdamp_ros.dynamics import LinearModel, linear_model
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.stepping.errors import SteppingError
from yawdamp_ros.stepping.propagation import Propagation, outputs_of, propagator
from yawdamp_ros.stepping.sample import Sample
from yawdamp_ros.stepping.stepper import Stepper
from yawdamp_ros.stepping.time_grid import TimeGrid
from yawdamp_ros.vehicle import Vehicle, load_vehicle

Steering = Callable[[float], float]
"""Road-wheel steer angle in rad at a time in s."""
SAMPLES_AT_ONCE = 1000
"""Instants that are computed before they are handed on."""


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
        """Put samples of one or more instants each, at least one, together."""
        taken = list(samples)

        def stacked(field: str) -> FloatArray:
            return np.vstack([getattr(sample, field) for sample in taken])

        return cls(
            unit_names=tuple(unit_names),
            time=grid.seconds(np.hstack([sample.step for sample in taken])),
            steering_angle=np.hstack([sample.steering_angle for sample in taken]),
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
        Of one instant, then of up to `SAMPLES_AT_ONCE` each.
    """
    last = grid.samples_in(duration)
    stepper.steer(steering(0.0))
    yield stepper.sample()
    for begin in range(0, last, SAMPLES_AT_ONCE):
        samples = min(SAMPLES_AT_ONCE, last - begin)
        steps = range(stepper.step + 1, stepper.step + 1 + samples * grid.steps_per_sample)
        yield stepper.run([steering(grid.seconds(step)) for step in steps], grid.steps_per_sample)


def respond(model: LinearModel, angles: FloatArray, grid: TimeGrid) -> Response:
    """Response from rest to steering given step by step.

    Parameters
    ----------
    model : LinearModel
    angles : ndarray, shape (k,)
        Road-wheel steer angle in rad from 0 s on, then from the instant after each step on; at least one.
    grid : TimeGrid
        Samples after the last whole sample period are left out.

    Returns
    -------
    Response
    """
    stepper = Stepper(model, grid.step_size)
    stepper.steer(float(angles[0]))
    samples = [stepper.sample()]
    if steps := (len(angles) - 1) // grid.steps_per_sample * grid.steps_per_sample:
        samples.append(stepper.run(angles[1 : steps + 1], grid.steps_per_sample, tell_inputs=False))
    return Response.of(samples, model.vehicle.unit_names, grid)


def linear_response(
    model: LinearModel, angles: FloatArray, step_size: float
) -> tuple[FloatArray, FloatArray]:
    """States and outputs from rest: what `scipy.signal.lsim` computes where the input is held over steps.

    Parameters
    ----------
    model : LinearModel
    angles : ndarray, shape (k,)
        Road-wheel steer angle in rad at each of k instants, held until the next.
    step_size : float
        From one instant to the next, s.

    Returns
    -------
    states : ndarray, shape (k, 2 n)
        As `LinearModel.state_names`.
    outputs : ndarray, shape (k, 4 n - 1)
        As `LinearModel.output_names`; the same bits as a `Stepper`'s samples.
    """
    motion = Propagation(propagator(model, step_size))
    motion.steering_angle = float(angles[0])
    states = np.zeros((len(angles), len(model.state_matrix) + 1))
    motion.advance(angles[1:], states[1:])
    states[:, -1] = angles
    return states[:, :-1], outputs_of(motion.propagator, states)


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
        Road-wheel steer angle in rad: at a time in s, as the manoeuvres are, or of every step of the
        duration, from 0 s on; one more value is that from the end on.
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
        If the times do not fit together, or the steering is neither a function nor an angle for every step.
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
    stepper = Stepper(linear_model(vehicle, speed, model), grid.step_size)
    return Response.of(sample_run(stepper, grid, held, duration), vehicle.unit_names, grid)


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
