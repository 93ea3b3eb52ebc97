"""The nonlinear model of one vehicle behind a small interface."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import numpy.typing as npt

from yawdamp_ros.dynamics.kinematics import FloatArray, IntArray
from yawdamp_ros.nonlinear.compiled import announce_compilation
from yawdamp_ros.nonlinear.errors import NonlinearError
from yawdamp_ros.nonlinear.events import NEVER, Event, event_count, named_events
from yawdamp_ros.nonlinear.layout import (
    FRICTION_LEFT,
    FRICTION_RIGHT,
    GEAR,
    SPEED,
    InputLayout,
    StateLayout,
)
from yawdamp_ros.nonlinear.motion import DIVERGED, ROLLED_OVER, all_outputs, rates, rk4_steps
from yawdamp_ros.nonlinear.outputs import Outputs, empty_outputs
from yawdamp_ros.nonlinear.parameters import parameters
from yawdamp_ros.nonlinear.records import (
    NOMINAL_FRICTION,
    RELAXATION_LENGTH,
    TOTAL_MASS,
    Parameters,
    Work,
    make_work,
)
from yawdamp_ros.nonlinear.settings import Settings
from yawdamp_ros.vehicle import STANDARD_GRAVITY, Vehicle, supports


@dataclass(frozen=True)
class Steps:
    """States and events of some steps.

    Attributes
    ----------
    states : ndarray, shape (k, m)
        State after every ``every`` steps.
    taken : int
        Steps taken.
    rolled_over : str
        Name of the unit that rolled over, at which the motion ends; empty otherwise.
    events : tuple of Event
        Events that began in these steps.
    diverged : str
        Name of the unit whose motion diverges in the next step; empty otherwise.

    Examples
    --------
    >>> from yawdamp_ros.nonlinear import NonlinearDynamics
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> dynamics = NonlinearDynamics(load_vehicle("truck_trailer"))
    >>> state, inputs = dynamics.initial_state(20.0), dynamics.inputs(steering=0.02, speed=20.0)
    >>> run = dynamics.steps(state, inputs, dt=0.001, count=1000, every=100)
    >>> run.taken, run.rolled_over
    (1000, '')
    """

    states: FloatArray
    taken: int
    rolled_over: str
    events: tuple[Event, ...]
    diverged: str = ""


@dataclass(frozen=True)
class NonlinearDynamics:
    """A vehicle's equations of motion; every method is a function of its arguments alone.

    Parameters
    ----------
    vehicle : Vehicle
        Vehicle; missing values are assumed (`yawdamp_ros.vehicle.assumed` lists them).
    settings : Settings

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> dynamics = NonlinearDynamics(load_vehicle("interlink"))
    >>> state, inputs = dynamics.initial_state(22.2), dynamics.inputs(steering=0.02, speed=22.2)
    >>> run = dynamics.steps(state, inputs, dt=0.001, count=1000, every=100)
    >>> run.states.shape
    (10, 47)
    >>> bool(dynamics.outputs(run.states, inputs).yaw_rate[-1, 0] > 0.05)  # to the left, rad/s
    True
    """

    vehicle: Vehicle
    settings: Settings = field(default_factory=Settings)

    def __post_init__(self) -> None:
        announce_compilation()

    @cached_property
    def parameters(self) -> Parameters:
        """The flat record of the vehicle and the settings."""
        return parameters(self.vehicle, self.settings)

    @cached_property
    def layout(self) -> StateLayout:
        """Slices of the state."""
        return StateLayout(len(self.vehicle.units), sum(len(unit.axles) for unit in self.vehicle.units))

    @cached_property
    def input_layout(self) -> InputLayout:
        """Slices of the input."""
        return InputLayout(self.layout.units, self.layout.axles)

    @property
    def vehicle_weight(self) -> float:
        """Weight of the combination [N]."""
        return float(STANDARD_GRAVITY * self.parameters.scalars[TOTAL_MASS])

    @property
    def lagging_wheels(self) -> npt.NDArray[np.bool_]:
        """True for each wheel whose force lags behind its slip."""
        return np.repeat(self.parameters.axles[:, RELAXATION_LENGTH] > 0.0, 2)

    def inputs(
        self,
        steering: float = 0.0,
        *,
        acceleration: float = 0.0,
        speed: float | None = None,
        friction: float | tuple[float, float] | None = None,
        grade: float = 0.0,
        crossfall: float = 0.0,
    ) -> FloatArray:
        """Make an input vector.

        Parameters
        ----------
        steering : float
            Road-wheel steer angle [rad].
        acceleration : float
            Acceleration demanded of the combination [m/s^2]: the driven axles drive, or all brakes brake.
        speed : float, optional
            Speed that the controller holds [m/s]; without it there is no speed control.
        friction : float or (float, float), optional
            Friction of the road, or under the left and the right wheels; the vehicle's own unless given.
        grade, crossfall : float
            Rise of the road along X and along Y.

        Returns
        -------
        ndarray
            Inputs by `input_layout`, in forward gear; demands on single axles and units are 0.
        """
        made = np.zeros(self.input_layout.size)
        own = self.parameters.scalars[NOMINAL_FRICTION] if friction is None else friction
        left, right = own if isinstance(own, tuple) else (own, own)
        made[: SPEED + 1] = steering, acceleration, np.nan if speed is None else speed
        made[FRICTION_LEFT], made[FRICTION_RIGHT] = left, right
        made[FRICTION_RIGHT + 1 : FRICTION_RIGHT + 3] = grade, crossfall
        made[GEAR] = 1.0
        return made

    def initial_state(
        self,
        speed: float,
        pose: tuple[float, float, float] = (0.0, 0.0, 0.0),
        articulation: Sequence[float] = (),
    ) -> FloatArray:
        """Make a state in which the lead unit moves straight ahead and every trailer rolls behind it.

        Parameters
        ----------
        speed : float
            Speed [m/s]; negative is backwards.
        pose : (float, float, float)
            Position [m] and yaw [rad] of the lead unit.
        articulation : sequence of float
            Angle of every joint [rad]; empty for a straight combination.

        Returns
        -------
        ndarray

        Raises
        ------
        NonlinearError
            If there are not as many angles as joints.
        """
        state = np.zeros(self.layout.size)
        state[:3] = pose
        state[self.layout.velocity.start] = speed
        state[self.layout.carcass] = -np.sign(speed)
        if len(articulation):
            joints = self.layout.units - 1
            if len(articulation) != joints:
                message = f"articulation: {list(articulation)}: expected an angle for each of {joints} joints"
                raise NonlinearError(message)
            state[self.layout.articulation] = articulation
            state[self.layout.yaw_rate] = self._rolling(speed, articulation)
        return state

    def _rolling(self, speed: float, articulation: Sequence[float]) -> FloatArray:
        """Yaw rates at which the axles of every trailer, taken at their centre, do not slide [rad/s]."""
        rates = np.zeros(self.layout.units)
        velocity = complex(speed)  # of the hitch, in the frame of the unit ahead of it
        for joint, angle in enumerate(articulation):
            ahead, unit = self.vehicle.units[joint], self.vehicle.units[joint + 1]
            assert ahead.rear_hitch is not None  # noqa: S101 - of a vehicle that was loaded
            assert unit.front_hitch is not None  # noqa: S101
            velocity += 1j * rates[joint] * ahead.rear_hitch
            velocity *= np.exp(1j * angle)
            arm = unit.front_hitch - supports(unit).rear
            rates[joint + 1] = velocity.imag / arm if arm > 0.0 else 0.0
            velocity -= 1j * rates[joint + 1] * unit.front_hitch  # of the centre of gravity
        return rates

    def derivatives(self, state: FloatArray, inputs: FloatArray) -> FloatArray:
        """Time derivative of a state.

        Parameters
        ----------
        state, inputs : ndarray
            State by `layout` and inputs by `input_layout`.

        Returns
        -------
        ndarray
        """
        out = np.zeros(self.layout.size)
        with np.errstate(all="ignore"):
            rates(np.array(state, float), np.array(inputs, float), self.parameters, self._work(), out)
        return out

    def no_events(self) -> IntArray:
        """Make the record of events of a run in which none has happened."""
        return np.full(event_count(self.layout.units, self.layout.axles), NEVER)

    def steps(
        self,
        state: FloatArray,
        inputs: FloatArray,
        dt: float,
        count: int | None = None,
        every: int = 1,
        first: int = 0,
        event_steps: IntArray | None = None,
    ) -> Steps:
        """Take Runge-Kutta steps of fourth order; see `try_steps`.

        Raises
        ------
        NonlinearError
            If the motion diverges: it names the step and the unit.
        """
        found = self.try_steps(state, inputs, dt, count, every, first, event_steps)
        if found.diverged:
            step = first + found.taken
            message = (
                f"{self.vehicle.name}: the motion of {found.diverged} diverges at step {step} "
                f"({step * dt:.6g} s): expected a step shorter than {dt:g} s, or softer numbers in the "
                "vehicle file"
            )
            raise NonlinearError(message)
        return found

    def try_steps(
        self,
        state: FloatArray,
        inputs: FloatArray,
        dt: float,
        count: int | None = None,
        every: int = 1,
        first: int = 0,
        event_steps: IntArray | None = None,
    ) -> Steps:
        """Take Runge-Kutta steps of fourth order, up to where the motion ends.

        The motion does not depend on how the steps are divided among calls.

        Parameters
        ----------
        state : ndarray
            Initial state; it is not changed.
        inputs : ndarray, shape (k,) or (count, k)
            Inputs held over all steps, or one row for each step.
        dt : float
            Time step [s].
        count : int, optional
            Number of steps, a multiple of ``every``; the rows of the inputs unless given.
        every : int
            Steps between the states that are kept.
        first : int
            Number of the first step in the run, for the events.
        event_steps : ndarray of int, optional
            The run's record of events (`no_events`), brought up to date; new unless given.

        Returns
        -------
        Steps

        Raises
        ------
        NonlinearError
            If the counts do not fit together.
        """
        rows = np.ascontiguousarray(np.atleast_2d(inputs), float)
        count = len(rows) if count is None else count
        if count % every or len(rows) not in {1, count}:
            message = (
                f"{count} steps: expected a multiple of {every} and a row of inputs for each or one for all"
            )
            raise NonlinearError(message)
        noted = self.no_events() if event_steps is None else event_steps
        before = noted.copy()
        current = np.array(state, float)
        samples = np.zeros((count // every, self.layout.size))
        stages = np.zeros((3, self.layout.size))
        with np.errstate(all="ignore"):
            taken, status, place = rk4_steps(
                current, rows, dt, self.parameters, self._work(), stages, samples, every, first, noted
            )
        names = self.vehicle.unit_names
        begun = np.where(before == NEVER, noted, NEVER)
        axles = tuple(len(unit.axles) for unit in self.vehicle.units)
        return Steps(
            samples[: taken // every],
            taken,
            names[place] if status == ROLLED_OVER else "",
            tuple(named_events(begun, names, axles)),
            names[self._unit_of(place)] if status == DIVERGED else "",
        )

    def outputs(self, states: FloatArray, inputs: FloatArray) -> Outputs:
        """Return the outputs of some states.

        Parameters
        ----------
        states : ndarray, shape (k, m)
        inputs : ndarray, shape (j,) or (k, j)
            Inputs of all states, or one row for each.

        Returns
        -------
        Outputs

        Raises
        ------
        NonlinearError
            If the inputs do not fit the states.
        """
        # Copies: broadcast arrays of NumPy are read-only, which is another type to Numba.
        every, rows = np.array(states, float, order="C"), np.array(np.atleast_2d(inputs), float, order="C")
        if len(rows) not in {1, len(every)}:
            message = f"{len(every)} states: expected a row of inputs for each or one for all"
            raise NonlinearError(message)
        made = empty_outputs(len(every), self.layout.units, self.layout.axles)
        with np.errstate(all="ignore"):
            all_outputs(made, every, rows, self.parameters, self._work(), np.zeros(self.layout.size))
        return made

    def _work(self) -> Work:
        return make_work(self.layout.units, self.layout.axles)

    def _unit_of(self, place: int) -> int:
        """Unit of an element of the state."""
        if place < len(self.layout.unit_of):
            return self.layout.unit_of[place]
        axle = (place - len(self.layout.unit_of)) // 2 % self.layout.axles
        return int(np.searchsorted(self.parameters.first_axle, axle, side="right")) - 1
