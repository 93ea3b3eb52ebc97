"""From a vehicle to the flat record of the compiled functions."""

import math
from collections.abc import Sequence

import numpy as np

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.nonlinear.errors import NonlinearError
from yawdamp_ros.nonlinear.records import (
    AXLE_COLUMNS,
    BRAKE_LIMIT,
    BRAKE_SHARE,
    BRUSH,
    CG_ARM,
    CG_HEIGHT,
    DRAG,
    DRAG_HEIGHT,
    DRIVE_SHARE,
    FRONT_ARM,
    FRONT_HEIGHT,
    FRONT_HITCH,
    FRONT_SHARE,
    HALF_TRACK,
    HIGHEST_DEMAND,
    HITCH_DAMPING,
    HITCH_FRICTION,
    HITCH_LOAD,
    HITCH_ROLL_DAMPING,
    HITCH_ROLL_STIFFNESS,
    LINEAR,
    LOAD_SHIFT_TIME,
    LOWEST_DEMAND,
    MAGIC_FORMULA,
    MASS,
    MAX_ARTICULATION,
    NOMINAL_FRICTION,
    POSITION,
    REAR_ARM,
    REAR_HEIGHT,
    REAR_HITCH,
    REAR_SHARE,
    RELAXATION_LENGTH,
    ROLL_AXIS_HEIGHT,
    ROLL_DAMPING,
    ROLL_INERTIA,
    ROLL_STIFFNESS,
    ROLLING_RESISTANCE,
    ROLLOVER_ANGLE,
    SCALARS,
    SPEED_GAIN,
    STATIC_LOAD,
    STEERED,
    STIFFNESS_RATE,
    STIFFNESS_SLOPE,
    SUPPORT_FRONT,
    SUPPORT_REAR,
    SWING_SLIP,
    TOTAL_MASS,
    TYRE_MODEL,
    TYRES,
    UNIT_BRAKE_SHARE,
    UNIT_COLUMNS,
    WITH_LOAD_SHIFT,
    WITH_ROLL,
    YAW_INERTIA,
    Parameters,
)
from yawdamp_ros.nonlinear.settings import Settings
from yawdamp_ros.vehicle import (
    STANDARD_GRAVITY,
    Axle,
    MagicFormula,
    Vehicle,
    complete,
    static_loads,
    supports,
)
from yawdamp_ros.vehicle.tyres import POUNDS_FORCE_PER_NEWTON

AIR_DENSITY = 1.2
"""In kg/m^3, at 20 degrees and sea level."""
ABS_SHARE = 0.8
"""Share of the friction that brakes with ABS use; UN R13, annex 13, demands 0.75.

It leaves 0.6 of the lateral force.
"""
NO_ABS = 2.0
"""Without ABS: beyond twice the friction more demand makes no difference."""
COEFFICIENTS = 23
LOAD_MISMATCH = 0.02
"""Share of the weight by which the axles' static loads may miss it; printed ones do by 0.0004."""


def parameters(vehicle: Vehicle, settings: Settings) -> Parameters:
    """Build the flat record of a vehicle.

    Parameters
    ----------
    vehicle : Vehicle
        Vehicle; missing values are assumed (`vehicle.complete`).
    settings : Settings

    Returns
    -------
    records.Parameters

    Raises
    ------
    NonlinearError
        If the static loads do not carry the weight.
    """
    full = complete(vehicle)
    loads = static_loads(vehicle)
    _check_carried(vehicle, sum(load for each in loads for load in each.axles))
    with_roll = settings.roll and settings.track
    first = np.cumsum([0, *(len(unit.axles) for unit in full.units)])
    return Parameters(
        units=_unit_table(full, [each.front_hitch for each in loads], with_roll=with_roll),
        axles=_axle_table(full, [load for each in loads for load in each.axles], settings),
        magic=np.array([_coefficients(axle) for unit in full.units for axle in unit.axles]),
        scalars=_scalars(full, settings, with_roll=with_roll),
        first_axle=first.astype(np.int64),
    )


def _check_carried(vehicle: Vehicle, carried: float) -> None:
    """Refuse given loads that leave weight in the air."""
    if any(axle.static_load is None for unit in vehicle.units for axle in unit.axles):
        return
    weight = STANDARD_GRAVITY * sum(unit.mass for unit in vehicle.units)
    if abs(carried - weight) > LOAD_MISMATCH * weight:
        tonnes, mass = (force / STANDARD_GRAVITY / 1000.0 for force in (carried, weight))
        message = (
            f"{vehicle.name}: the axles carry {tonnes:.4g} t at rest, the units' masses sum to {mass:.4g} t: "
            "expected the same; leave static_load out for what statics gives"
        )
        raise NonlinearError(message)


def _unit_table(full: Vehicle, hitch_loads: Sequence[float], *, with_roll: bool) -> FloatArray:
    table = np.zeros((len(full.units), UNIT_COLUMNS))
    ahead = None
    for row, unit, load in zip(table, full.units, hitch_loads, strict=True):
        held = supports(unit)
        for column, value in {
            MASS: unit.mass,
            YAW_INERTIA: unit.yaw_inertia,
            ROLL_INERTIA: unit.roll_inertia,
            CG_HEIGHT: unit.cg_height,
            ROLL_AXIS_HEIGHT: unit.roll_axis_height,
            BRAKE_LIMIT: ABS_SHARE if unit.abs else NO_ABS,
            SUPPORT_FRONT: held.front,
            SUPPORT_REAR: held.rear,
            HITCH_LOAD: load,
            HITCH_ROLL_STIFFNESS: unit.hitch_roll_stiffness,
            HITCH_ROLL_DAMPING: unit.hitch_roll_damping,
            HITCH_FRICTION: unit.hitch_friction,
            HITCH_DAMPING: unit.hitch_damping,
            MAX_ARTICULATION: unit.max_articulation,
        }.items():
            row[column] = value
        if unit.rear_hitch is not None:
            row[REAR_HITCH], row[REAR_HEIGHT] = unit.rear_hitch, unit.hitch_height
        if ahead is not None and unit.front_hitch is not None:
            row[FRONT_HITCH], row[FRONT_HEIGHT] = unit.front_hitch, ahead.hitch_height
        if with_roll:
            row[CG_ARM] = row[CG_HEIGHT] - row[ROLL_AXIS_HEIGHT]
            row[FRONT_ARM] = row[FRONT_HEIGHT] - row[ROLL_AXIS_HEIGHT] if ahead is not None else 0.0
            row[REAR_ARM] = row[REAR_HEIGHT] - row[ROLL_AXIS_HEIGHT] if unit.rear_hitch is not None else 0.0
        ahead = unit
    return table


def _axle_table(full: Vehicle, loads: Sequence[float], settings: Settings) -> FloatArray:
    axles = [axle for unit in full.units for axle in unit.axles]
    table = np.zeros((len(axles), AXLE_COLUMNS))
    table[:, STATIC_LOAD] = loads
    for row, axle in zip(table, axles, strict=True):
        row[POSITION], row[STEERED] = axle.position, axle.steered
        row[HALF_TRACK] = 0.5 * (axle.track_width or 0.0) if settings.track else 0.0
        row[RELAXATION_LENGTH] = axle.relaxation_length if settings.relaxation else 0.0
        row[ROLL_STIFFNESS], row[ROLL_DAMPING] = axle.roll_stiffness, axle.roll_damping
        row[ROLLING_RESISTANCE] = axle.rolling_resistance if settings.rolling_resistance else 0.0
        row[DRIVE_SHARE] = row[STATIC_LOAD] if axle.driven else 0.0
        row[BRAKE_SHARE] = axle.brake_share
        row[TYRE_MODEL] = _tyre_model(axle)
        row[STIFFNESS_RATE], row[STIFFNESS_SLOPE] = _stiffness(axle)
        row[TYRES] = 0.5 * (axle.tyres or 2)
    start = 0
    for unit in full.units:
        own = slice(start, start + len(unit.axles))
        held = supports(unit)
        table[own, FRONT_SHARE] = _share(table[own, STATIC_LOAD], held.front_axles)
        table[own, REAR_SHARE] = _share(table[own, STATIC_LOAD], held.rear_axles)
        table[own, UNIT_BRAKE_SHARE] = _normalised(table[own, BRAKE_SHARE])
        start = own.stop
    for column in (DRIVE_SHARE, BRAKE_SHARE):
        table[:, column] = _normalised(table[:, column])
    return table


def _scalars(full: Vehicle, settings: Settings, *, with_roll: bool) -> FloatArray:
    made = np.zeros(SCALARS)
    assert full.drag_area is not None  # noqa: S101 - of a complete vehicle
    for place, value in {
        TOTAL_MASS: math.fsum(unit.mass for unit in full.units),
        DRAG: 0.5 * AIR_DENSITY * full.drag_area if settings.drag else 0.0,
        DRAG_HEIGHT: full.drag_height,
        NOMINAL_FRICTION: full.friction,
        SPEED_GAIN: settings.speed_gain,
        LOWEST_DEMAND: settings.lowest_demand,
        HIGHEST_DEMAND: settings.highest_demand,
        LOAD_SHIFT_TIME: settings.load_shift_time,
        WITH_ROLL: with_roll,
        WITH_LOAD_SHIFT: settings.load_shift,
        ROLLOVER_ANGLE: settings.rollover_angle,
        SWING_SLIP: math.tan(settings.swing_angle),
    }.items():
        made[place] = value
    return made


def _share(loads: FloatArray, group: Sequence[int]) -> FloatArray:
    """Shares by static load of the axles of a support."""
    share = np.zeros(len(loads))
    if group:
        share[list(group)] = _normalised(loads[list(group)])
    return share


def _normalised(values: FloatArray) -> FloatArray:
    """Shares that sum to one; equal if all values are zero, but zero if nothing is driven."""
    total = values.sum()
    return values / total if total > 0.0 else np.zeros(len(values))


def _stiffness(axle: Axle) -> tuple[float, float]:
    """Rate and slope of the cornering stiffness of one wheel by its load."""
    assert axle.static_load is not None  # noqa: S101 - of a complete vehicle
    if axle.tyres is not None:  # `fancher_stiffness` of each tyre
        per_newton = math.degrees(1.0)
        slope = per_newton * POUNDS_FORCE_PER_NEWTON / 300000.0
        return 0.1 * per_newton, slope / (0.5 * axle.tyres)
    return (axle.cornering_stiffness / axle.static_load if axle.static_load > 0.0 else 0.0), 0.0


def _tyre_model(axle: Axle) -> int:
    if isinstance(axle.tyre, MagicFormula):
        return MAGIC_FORMULA
    return LINEAR if axle.tyre == "linear" else BRUSH


def _coefficients(axle: Axle) -> FloatArray:
    if isinstance(axle.tyre, MagicFormula):
        return np.array(axle.tyre.coefficients)
    return np.zeros(COEFFICIENTS)
