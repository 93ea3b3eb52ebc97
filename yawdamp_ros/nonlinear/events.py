"""Events of a combination at its limits: detection and names."""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum

from yawdamp_ros.dynamics.kinematics import FloatArray, IntArray
from yawdamp_ros.nonlinear.compiled import compiled
from yawdamp_ros.nonlinear.layout import roll_index
from yawdamp_ros.nonlinear.records import (
    LOAD,
    MAX_ARTICULATION,
    ROLLOVER_ANGLE,
    SLIDE,
    SUPPORT_REAR,
    SWING_SLIP,
    VELOCITY_X,
    VELOCITY_Y,
    WITH_ROLL,
    Parameters,
    Work,
)
from yawdamp_ros.nonlinear.tyre_laws import LIFTED

LOCKING_SPEED = 0.5
"""Speed below which a wheel does not count as locked [m/s]."""
SWINGING_SPEED = 1.0
"""Speed below which a trailer does not count as swinging [m/s]."""
NEVER = -1


class EventKind(StrEnum):
    """Kinds of events.

    A wheel lifts when it carries no load; it locks when its brake force passes friction while it moves. A
    joint jackknifes when it reaches its `max_articulation`. A trailer swings when the centre of its axles
    slides sideways at more than `Settings.swing_angle`. A unit rolls over past `Settings.rollover_angle`.

    Examples
    --------
    >>> from yawdamp_ros.nonlinear import EventKind
    >>> sorted(kind.name for kind in EventKind)[:2]
    ['JACKKNIFE', 'ROLLOVER']
    """

    WHEEL_LIFT = "wheel_lift"
    WHEEL_LOCK = "wheel_lock"
    JACKKNIFE = "jackknife"
    TRAILER_SWING = "trailer_swing"
    ROLLOVER = "rollover"


@dataclass(frozen=True)
class Event:
    """An event and the step at which it began.

    Attributes
    ----------
    kind : EventKind
    step : int
        Number of steps taken before.
    unit : str
        Name of the unit; of a joint the towing one.
    axle : int or None
        Number of the axle on its unit, from 0.
    side : str
        ``left`` or ``right`` of a wheel, else empty.

    Examples
    --------
    >>> from yawdamp_ros.nonlinear import Event, EventKind
    >>> Event(list(EventKind)[0], step=120, unit="truck", axle=1, side="left").unit
    'truck'
    """

    kind: EventKind
    step: int
    unit: str
    axle: int | None = None
    side: str = ""


def event_count(units: int, axles: int) -> int:
    """Return the length of the array that `note_events` writes: 4 for each axle, 3 for each unit."""
    return 4 * axles + 3 * units


@compiled
def note_events(state: FloatArray, p: Parameters, w: Work, step: int, steps: IntArray) -> int:
    """Note the step at which each event begins, by the state and the work arrays of its evaluation.

    Parameters
    ----------
    state, p, w
    step : int
    steps : ndarray of int
        Lifts and locks by wheel, then jackknives, swings and rollovers by unit; `NEVER` until then.

    Returns
    -------
    int
        Unit that has rolled over, or -1.
    """
    unit_table, axle_table, scalars, unit_work, wheel_work = p.units, p.axles, p.scalars, w.units, w.wheels
    units, axles = unit_table.shape[0], axle_table.shape[0]
    wheels = 2 * axles
    rolls = roll_index(units)
    gone = -1
    for unit in range(units):
        vx, vy, yaw_rate = unit_work[unit, VELOCITY_X], unit_work[unit, VELOCITY_Y], state[4 + units + unit]
        for axle in range(p.first_axle[unit], p.first_axle[unit + 1]):
            for wheel in (2 * axle, 2 * axle + 1):
                if scalars[WITH_ROLL] and wheel_work[wheel, LOAD] <= LIFTED:
                    _note(steps, wheel, step)
                if wheel_work[wheel, SLIDE] > 0.0 and vx * vx + vy * vy > LOCKING_SPEED**2:
                    _note(steps, wheels + wheel, step)
        if unit + 1 < units and abs(state[3 + unit]) >= unit_table[unit, MAX_ARTICULATION]:
            _note(steps, 2 * wheels + unit, step)
        if unit > 0:
            sideways = abs(vy + unit_table[unit, SUPPORT_REAR] * yaw_rate)
            if sideways > scalars[SWING_SLIP] * abs(vx) and vx * vx + vy * vy > SWINGING_SPEED**2:
                _note(steps, 2 * wheels + units + unit, step)
        if scalars[WITH_ROLL] and abs(state[rolls + unit]) > scalars[ROLLOVER_ANGLE]:
            _note(steps, 2 * wheels + 2 * units + unit, step)
            gone = unit
    return gone


@compiled
def _note(steps: IntArray, place: int, step: int) -> None:
    if steps[place] < 0:
        steps[place] = step


def named_events(steps: IntArray, names: tuple[str, ...], axles: tuple[int, ...]) -> Iterator[Event]:
    """Give the noted events their names, in order of time.

    Parameters
    ----------
    steps : ndarray of int
        First step of each event, as `note_events` writes it.
    names : tuple of str
        Names of the units.
    axles : tuple of int
        Number of axles of each unit.
    """
    if (steps == NEVER).all():  # as nearly always
        return
    places = [(name, axle, side) for name, count in zip(names, axles, strict=True) for axle in range(count)
              for side in ("left", "right")]  # fmt: skip
    labels = [
        *((EventKind.WHEEL_LIFT, *place) for place in places),
        *((EventKind.WHEEL_LOCK, *place) for place in places),
        *((kind, name, None, "") for kind in list(EventKind)[2:] for name in names),
    ]
    noted = sorted((int(step), place) for place, step in enumerate(steps) if step != NEVER)
    for step, place in noted:
        kind, unit, axle, side = labels[place]
        yield Event(kind, step, unit, axle, side)
