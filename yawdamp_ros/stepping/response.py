"""Whole runs in memory, for notebooks, tables and files."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from yawdamp_ros.dynamics import LinearModel
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.stepping.errors import SteppingError
from yawdamp_ros.stepping.motion import Motion
from yawdamp_ros.stepping.propagation import Propagation, outputs_of
from yawdamp_ros.stepping.propagators import propagator
from yawdamp_ros.stepping.sample import AppliedInput, Event, Sample
from yawdamp_ros.stepping.stepper import Stepper
from yawdamp_ros.stepping.time_grid import TimeGrid
from yawdamp_ros.stepping.yaw import LARGEST_YAW

Steering = Callable[[float], float]
"""Road-wheel steer angle [rad] at a time [s]."""
SAMPLES_AT_ONCE = 1000
"""Instants that are computed at once."""


@dataclass(frozen=True)
class Response:
    """Motion of n units over m samples.

    Attributes
    ----------
    unit_names : tuple of str
    time : ndarray, shape (m,)
        Time [s].
    steering_angle : ndarray, shape (m,)
        Road-wheel steer angle, in force from that instant on [rad].
    yaw, yaw_rate, lateral_acceleration : ndarray, shape (m, n)
        Yaw [rad], yaw rate [rad/s] and lateral acceleration [m/s^2].
    articulation : ndarray, shape (m, n - 1)
        Articulation angles [rad].
    x, y : ndarray, shape (m, n)
        Centres of gravity in the ground frame [m].
    extra : mapping of str to ndarray, shape (m, n), (m, n - 1), (m, 1) or (m, 2 a) of a axles
        Quantities that not every motion has, as `Sample.extra`.
    events : tuple of Event
        Events in order of time; a final event ends the run.
    event_times : tuple of float
        Times of the events [s].

    Examples
    --------
    >>> from yawdamp_ros import simulate
    >>> from yawdamp_ros.manoeuvres import Step
    >>> response = simulate("truck_trailer", Step(amplitude=0.02), 2.0, sample_period=0.01)
    >>> response.yaw_rate.shape
    (201, 2)
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
    extra: Mapping[str, FloatArray] = field(default_factory=dict)
    events: tuple[Event, ...] = ()
    event_times: tuple[float, ...] = ()

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
            extra={
                name: np.concatenate(
                    [np.reshape(sample.extra[name], (np.size(sample.step), -1)) for sample in taken]
                )
                for name in taken[0].extra
            },
            events=tuple(event for sample in taken for event in sample.events),
            event_times=tuple(grid.seconds(event.step) for sample in taken for event in sample.events),
        )


def sample_run(motion: Motion, grid: TimeGrid, steering: Steering, duration: float) -> Iterator[Sample]:
    """Samples of a run from its first instant to its last, as they come.

    Parameters
    ----------
    motion : Motion
        Motion at step 0.
    grid : TimeGrid
    steering : callable
        Steer angle [rad] at a time [s].
    duration : float
        Duration [s]; the last sample is at the last sample period that fits.

    Yields
    ------
    Sample
        One instant, then up to `SAMPLES_AT_ONCE` instants each; the last sample ends before a final event.

    Raises
    ------
    SteppingError
        If the motion overflows.
    """
    last = grid.samples_in(duration)
    motion.apply(AppliedInput(motion.step, "steering", steering(0.0)))
    yield motion.sample()
    for begin in range(0, last, SAMPLES_AT_ONCE):
        samples = min(SAMPLES_AT_ONCE, last - begin)
        steps = range(motion.step + 1, motion.step + 1 + samples * grid.steps_per_sample)
        sample = motion.run([steering(grid.seconds(step)) for step in steps], grid.steps_per_sample)
        if any(event.final for event in sample.events):
            known = ~np.isnan(sample.yaw_rate).any(axis=-1)
            yield sample.before(int(known.sum()))._replace(events=sample.events)
            return
        yield _finite(sample, motion, grid)


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

    Raises
    ------
    SteppingError
        If the motion overflows.
    """
    stepper = Stepper(model, grid.step_size)
    stepper.steer(float(angles[0]))
    samples = [stepper.sample()]
    if steps := (len(angles) - 1) // grid.steps_per_sample * grid.steps_per_sample:
        run = stepper.run(angles[1 : steps + 1], grid.steps_per_sample, tell_inputs=False)
        samples.append(_finite(run, stepper, grid))
    return Response.of(samples, model.vehicle.unit_names, grid)


def linear_response(
    model: LinearModel, angles: FloatArray, step_size: float
) -> tuple[FloatArray, FloatArray]:
    """Return states and outputs from rest, as `scipy.signal.lsim` computes them for a held input.

    Parameters
    ----------
    model : LinearModel
    angles : ndarray, shape (k,)
        Road-wheel steer angle in rad at each of k instants, held until the next.
    step_size : float
        Time from one instant to the next [s].

    Returns
    -------
    states : ndarray, shape (k, 2 n)
        States in the order of `LinearModel.state_names`.
    outputs : ndarray, shape (k, 4 n - 1)
        Outputs in the order of `LinearModel.output_names`; the same bits as a `Stepper`'s samples.

    Examples
    --------
    >>> import numpy as np
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> from yawdamp_ros.stepping import linear_response
    >>> model = linear_model(load_vehicle("truck_trailer"))
    >>> states, outputs = linear_response(model, np.full(1001, 0.02), 0.001)
    >>> states.shape, outputs.shape
    ((1001, 4), (1001, 7))
    """
    motion = Propagation(propagator(model, step_size))
    motion.steering_angle = float(angles[0])
    states = np.empty((len(angles), len(model.state_matrix) + 1))
    states[0] = 0.0
    motion.advance(angles[1:], states[1:])
    states[:, -1] = angles
    return states[:, :-1], outputs_of(motion.propagator, states)


def _finite(sample: Sample, motion: Motion, grid: TimeGrid) -> Sample:
    """Return a sample of several instants; raise if its values overflow."""
    # Of NaN neither comparison is true.
    if not (sample.yaw.max() <= LARGEST_YAW and sample.yaw.min() >= -LARGEST_YAW):
        known = (np.abs(sample.yaw) <= LARGEST_YAW).all(axis=-1)
        time = grid.seconds(int(sample.step[np.argmin(known)]))
        message = f"{motion.vehicle.name}: unstable, beyond all numbers at {time:g} s"
        raise SteppingError(message)
    return sample
