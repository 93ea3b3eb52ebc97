"""Record that passes from the numerics to messages and files."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from yawdamp_ros.dynamics.kinematics import ComplexArray, FloatArray

NOTHING: Mapping[str, FloatArray] = MappingProxyType({})


class AppliedInput(NamedTuple):
    """An input of the model from a step on; a run is repeated from these alone.

    Attributes
    ----------
    step : int
    name : str
        One of the motion's `input_names`, such as ``steering``.
    value : float
        Road-wheel steer angle [rad], speed [m/s], or 0 for a reset.

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> from yawdamp_ros.stepping import AppliedInput, Stepper
    >>> motion = Stepper(linear_model(load_vehicle("truck_trailer")), step_size=0.001)
    >>> motion.apply(AppliedInput(0, "speed", 15.0))
    >>> motion.speed
    15.0
    """

    step: int
    name: str
    value: float


class Command(NamedTuple):
    """A steering command that was accepted, as it was received.

    Attributes
    ----------
    step : int
        Newest step at the time of receipt; the command acts from the next step on.
    angle : float
        Commanded angle [rad].
    message : object
        Message that held it; None for a command without one.

    Examples
    --------
    >>> from yawdamp_ros.stepping import Command
    >>> Command(step=120, angle=0.02).angle
    0.02
    """

    step: int
    angle: float
    message: Any = None


class Event(NamedTuple):
    """Event of the vehicle, such as a wheel that lifts.

    Attributes
    ----------
    step : int
        Step at which it begins.
    name : str
        Kind of event, such as ``wheel_lift``.
    where : str
        Unit, joint or wheel.
    final : bool
        Whether the motion has no meaning from here on.

    Examples
    --------
    >>> from yawdamp_ros.stepping import Event
    >>> Event(step=4880, name="jackknife", where="truck").final
    False
    """

    step: int
    name: str
    where: str
    final: bool = False


class Sample(NamedTuple):
    """State and outputs of an n-unit combination at one instant, or at m instants.

    Arrays of one instant are of the shapes below; those of m instants have an axis of m before.

    Attributes
    ----------
    step : ndarray, shape ()
        Steps since the start; with the step size, the time.
    steering_angle : ndarray, shape ()
        Road-wheel steer angle in force from this instant on [rad].
    x, y : ndarray, shape (n,)
        Centres of gravity in the ground frame [m].
    yaw, yaw_rate : ndarray, shape (n,)
        rad and rad/s; yaw is not wrapped.
    heading : ndarray of complex, shape (n,)
        ``cos(yaw) + i sin(yaw)``, exact after any number of turns, unlike the yaw as one number.
    velocity : ndarray of complex, shape (n,)
        Velocity of each centre of gravity in its unit's own frame [m/s], the rate of the pose; the real part
        points forward, the imaginary part to the left.
    lateral_velocity, lateral_acceleration : ndarray, shape (n,)
        Velocity and acceleration of each centre of gravity in its unit's own frame, by the linear model for
        small angles, gravity excluded [m/s, m/s^2].
    articulation, articulation_rate : ndarray, shape (n - 1,)
        ``psi_k - psi_(k+1)`` and its rate, rad and rad/s.
    inputs : tuple of AppliedInput
        Inputs that took effect since the previous sample, up to the last instant, in order.
    extra : mapping of str to ndarray, shape (n,), (n - 1,), () or (2 a,) of a axles
        Quantities that not every motion has, by the motion's `quantity_names`.
    events : tuple of Event
        Events since the previous sample.
    commands : tuple of Command
        Commands received since the previous sample.

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> from yawdamp_ros.stepping import Stepper
    >>> motion = Stepper(linear_model(load_vehicle("truck_trailer")), step_size=0.001)
    >>> sample = motion.run([0.02] * 1000)
    >>> int(sample.step), sample.yaw.shape
    (1000, (2,))
    """

    step: npt.NDArray[np.int64]
    steering_angle: FloatArray
    x: FloatArray
    y: FloatArray
    yaw: FloatArray
    yaw_rate: FloatArray
    heading: ComplexArray
    velocity: ComplexArray
    lateral_velocity: FloatArray
    lateral_acceleration: FloatArray
    articulation: FloatArray
    articulation_rate: FloatArray
    inputs: tuple[AppliedInput, ...]
    extra: Mapping[str, FloatArray] = NOTHING
    events: tuple[Event, ...] = ()
    commands: tuple[Command, ...] = ()

    def before(self, instant: int) -> "Sample":
        """Return the sample of the instants before a given one, with the inputs and events until then."""
        last = int(self.step[instant - 1]) if instant else int(self.step[0]) - 1
        cut = {
            name: value[:instant]
            for name, value in self._asdict().items()
            if isinstance(value, np.ndarray) and value.shape[:1] == self.step.shape
        }
        return self._replace(
            **cut,
            extra={name: value[:instant] for name, value in self.extra.items()},
            inputs=tuple(applied for applied in self.inputs if applied.step <= last),
            events=tuple(event for event in self.events if event.step <= last),
            commands=tuple(command for command in self.commands if command.step <= last),
        )
