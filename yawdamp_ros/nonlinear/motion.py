"""The right-hand side of the nonlinear model, and its fixed step."""

import math

from yawdamp_ros.dynamics.kinematics import FloatArray, IntArray
from yawdamp_ros.nonlinear.chain import chain_kinematics, equations_of_motion, unit_accelerations
from yawdamp_ros.nonlinear.compiled import compiled
from yawdamp_ros.nonlinear.events import note_events
from yawdamp_ros.nonlinear.hitches import hitch_moments
from yawdamp_ros.nonlinear.layout import CROSSFALL, GRADE, YAW, roll_index, speed_index
from yawdamp_ros.nonlinear.loads import vertical_loads
from yawdamp_ros.nonlinear.outputs import Outputs, write_outputs
from yawdamp_ros.nonlinear.records import (
    ACCELERATION_X,
    ACCELERATION_Y,
    CG_HEIGHT,
    COSINE,
    DRAG,
    DRAG_HEIGHT,
    FORCE_X,
    FORCE_Y,
    FRONT_HEIGHT,
    HITCH_FORCE_X,
    HITCH_FORCE_Y,
    LOAD_SHIFT_TIME,
    MASS,
    REAR_HEIGHT,
    SINE,
    VELOCITY_X,
    WITH_LOAD_SHIFT,
    WITH_ROLL,
    Parameters,
    Work,
)
from yawdamp_ros.nonlinear.wheels import wheel_forces
from yawdamp_ros.vehicle.model import STANDARD_GRAVITY

LARGEST = 1e9
"""Magnitude of a state or a rate that no vehicle reaches, in SI units."""

DONE, DIVERGED, ROLLED_OVER = range(3)
"""Why `rk4_steps` returned."""


@compiled
def rates(state: FloatArray, inputs: FloatArray, p: Parameters, w: Work, out: FloatArray) -> None:
    """Time derivative of the state, a function of the state and the input alone.

    Parameters
    ----------
    state : ndarray
        State by `StateLayout`.
    inputs : ndarray
        Inputs by `InputLayout`.
    p : Parameters
    w : Work
        Overwritten; holds forces, loads and accelerations afterwards.
    out : ndarray
        Output: rates of the state.
    """
    unit_table, scalars, unit_work = p.units, p.scalars, w.units
    units = unit_table.shape[0]
    rolls, speed = roll_index(units), speed_index(units)
    rise_x, rise_y = inputs[GRADE], inputs[CROSSFALL]
    fall = STANDARD_GRAVITY / math.sqrt(1.0 + rise_x * rise_x + rise_y * rise_y)
    c, s = math.cos(state[YAW]), math.sin(state[YAW])
    pull_x, pull_y = -fall * (c * rise_x + s * rise_y), -fall * (c * rise_y - s * rise_x)
    chain_kinematics(state, p, w)
    vertical_loads(state, fall / STANDARD_GRAVITY, p, w)
    wheel_forces(state, inputs, p, w, out)
    hitch_moments(state, p, w)
    drag = -scalars[DRAG] * unit_work[0, VELOCITY_X] * abs(unit_work[0, VELOCITY_X])
    unit_work[0, FORCE_X] += drag
    for unit in range(units):
        forward, left = unit_work[unit, FORCE_X], unit_work[unit, FORCE_Y]
        unit_work[unit, FORCE_X] = unit_work[unit, COSINE] * forward - unit_work[unit, SINE] * left
        unit_work[unit, FORCE_Y] = unit_work[unit, SINE] * forward + unit_work[unit, COSINE] * left
    equations_of_motion(state, pull_x, pull_y, fall, p, w)
    unit_accelerations(pull_x, pull_y, p, w)
    q, u, v, yaw_rate = w.solution, state[speed], state[speed + 1], state[4 + units]
    out[0], out[1], out[YAW] = c * u - s * v, s * u + c * v, yaw_rate
    out[speed], out[speed + 1] = q[0] + yaw_rate * v, q[1] - yaw_rate * u
    for unit in range(units):
        out[4 + units + unit] = q[2 + unit]
        if unit > 0:
            out[2 + unit] = state[3 + units + unit] - state[4 + units + unit]
        roll_rate = rolls + units + unit
        out[rolls + unit] = state[roll_rate] if scalars[WITH_ROLL] else 0.0
        out[roll_rate] = q[2 + units + unit] if scalars[WITH_ROLL] else 0.0
        out[roll_rate + units] = 0.0
        if scalars[WITH_LOAD_SHIFT]:
            moment = _pitching_moment(unit, pull_x, pull_y, p, w)
            if unit == 0:
                moment += scalars[DRAG_HEIGHT] * drag
            out[roll_rate + units] = (moment - state[roll_rate + units]) / scalars[LOAD_SHIFT_TIME]


@compiled
def _pitching_moment(unit: int, pull_x: float, pull_y: float, p: Parameters, w: Work) -> float:
    """Moment of the longitudinal forces on a unit above the road, forward positive [N m]."""
    unit_table, unit_work = p.units, w.units
    c, s = unit_work[unit, COSINE], unit_work[unit, SINE]
    forward = c * (unit_work[unit, ACCELERATION_X] - pull_x) + s * (unit_work[unit, ACCELERATION_Y] - pull_y)
    moment = -unit_table[unit, MASS] * unit_table[unit, CG_HEIGHT] * forward
    if unit > 0:
        moment += unit_table[unit, FRONT_HEIGHT] * (
            c * unit_work[unit, HITCH_FORCE_X] + s * unit_work[unit, HITCH_FORCE_Y]
        )
    if unit + 1 < unit_table.shape[0]:
        moment -= unit_table[unit, REAR_HEIGHT] * (
            c * unit_work[unit + 1, HITCH_FORCE_X] + s * unit_work[unit + 1, HITCH_FORCE_Y]
        )
    return float(moment)


@compiled
def rk4_steps(
    state: FloatArray, inputs: FloatArray, dt: float, p: Parameters, w: Work, stages: FloatArray,
    samples: FloatArray, every: int, first: int, event_steps: IntArray,
) -> tuple[int, int, int]:  # fmt: skip
    """Take steps of the classical Runge-Kutta method (Kutta 1901), the input held over each.

    Parameters
    ----------
    state : ndarray, shape (m,)
        Advanced in place; on divergence it is that before the step.
    inputs : ndarray, shape (steps, k) or (1, k)
        A row for each step, or one for all.
    dt : float
        Time step [s].
    p, w
    stages : ndarray, shape (3, m)
        Scratch.
    samples : ndarray, shape (steps // every, m)
        Output: the state after every ``every`` steps.
    every : int
    first : int
        Number of the first step, for the events.
    event_steps : ndarray of int
        See `note_events`.

    Returns
    -------
    steps : int
        Taken.
    status : int
        `DONE`, `DIVERGED` or `ROLLED_OVER`.
    place : int
        Element of the state, or unit, that this is about; -1 where there is none.
    """
    steps = samples.shape[0] * every
    total, slope, trial = stages
    for step in range(steps):
        row = inputs[step] if inputs.shape[0] > 1 else inputs[0]
        place = -1
        trial[:] = state
        total[:] = state
        for stage in range(4):
            rates(trial, row, p, w, slope)
            if stage == 0:
                unit = note_events(state, p, w, first + step, event_steps)
                if unit >= 0:
                    return step, ROLLED_OVER, unit
            place = _unusual(slope)
            if place >= 0:
                break
            share = dt / 6.0 if stage in (0, 3) else dt / 3.0
            reach = dt if stage == 2 else 0.5 * dt  # noqa: PLR2004
            for i in range(state.size):
                total[i] += share * slope[i]
                trial[i] = state[i] + reach * slope[i]
        if place < 0:
            place = _unusual(total)
        if place >= 0:
            return step, DIVERGED, place
        state[:] = total
        if (step + 1) % every == 0:
            samples[(step + 1) // every - 1] = state
    return steps, DONE, -1


@compiled
def all_outputs(
    outputs: Outputs, states: FloatArray, inputs: FloatArray, p: Parameters, w: Work, out: FloatArray
) -> None:
    """Write the outputs of some states.

    Parameters
    ----------
    outputs : Outputs
        Outputs of as many instants as there are states; they are overwritten.
    states : ndarray, shape (k, m)
    inputs : ndarray, shape (k, j) or (1, j)
        A row for each state, or one for all.
    p, w
    out : ndarray, shape (m,)
        Scratch.
    """
    for place in range(states.shape[0]):
        row = inputs[place] if inputs.shape[0] > 1 else inputs[0]
        rates(states[place], row, p, w, out)
        write_outputs(outputs, place, states[place], p, w)


@compiled
def _unusual(values: FloatArray) -> int:
    """Index of a non-finite element, else of the largest beyond a vehicle's range; -1 if all are valid."""
    place, largest = -1, LARGEST
    for i in range(values.size):
        if math.isnan(values[i]):
            return i
        if abs(values[i]) >= largest:
            place, largest = i, abs(values[i])
    return place
