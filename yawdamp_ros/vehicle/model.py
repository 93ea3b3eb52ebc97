"""A combination as plain records: SI units, positions from the unit's own centre of gravity.

Fields that may be None serve the nonlinear model alone; the linear ones do not read them.

A `Vehicle` some of whose numbers are arrays of one length is a stack of vehicles, alike but for these:
`load_stack` makes one, and the equations of motion of all are assembled at once.
"""

from dataclasses import dataclass, fields, replace
from itertools import pairwise
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

if TYPE_CHECKING:
    from yawdamp_ros.vehicle.tir import MagicFormula

STANDARD_GRAVITY = 9.80665
"""Standard acceleration of gravity [m/s^2]."""


Record = TypeVar("Record", "Axle", "Unit", "Vehicle")


@dataclass(frozen=True)
class Axle:
    """One axle, or a group of wheels at one position, of the one-track model.

    Attributes
    ----------
    position : float
        Distance from the unit's centre of gravity, forward positive [m].
    cornering_stiffness : float
        Cornering stiffness of the whole axle, positive [N/rad].
    steered : bool
        Whether the road-wheel steer angle acts on it.
    self_steering : bool
        Whether its wheels caster at walking speed; at speed they are locked, as such axles are.
    commanded : bool
        Whether it is steered by a command of its unit's own; only the nonlinear model steers it.
    low_speed_steering : float
        Steer angle at walking speed over the articulation of the unit's front hitch, against it; at speed
        such an axle is locked.
    tyres : int or None
        Number of tyres where the stiffness comes from the load on each (`fancher_stiffness`).
    static_load : float or None
        Load of the axle at rest [N].
    track_width : float or None
        Distance between the middles of the left and the right tyres [m].
    tyre : str, MagicFormula or None
        ``brush``, ``linear`` or the coefficients of a .tir file.
    tyre_width : float or None
        Width over the tyres of one side, both of duals [m].
    relaxation_length : float or None
        Relaxation length [m].
    roll_stiffness, roll_damping : float or None
        Roll stiffness and damping of suspension and tyres [N m/rad, N m s/rad].
    rolling_resistance : float or None
        Force over load.
    driven : bool or None
    brake_share : float or None
        Share of the combination's braking force, relative to the other axles'.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import Axle
    >>> Axle(position=-4.4, cornering_stiffness=1.2e6).steered
    False
    """

    position: float
    cornering_stiffness: float
    steered: bool = False
    commanded: bool = False
    tyres: int | None = None
    static_load: float | None = None
    track_width: float | None = None
    tyre_width: float | None = None
    tyre: "str | MagicFormula | None" = None
    relaxation_length: float | None = None
    roll_stiffness: float | None = None
    roll_damping: float | None = None
    rolling_resistance: float | None = None
    driven: bool | None = None
    brake_share: float | None = None
    self_steering: bool = False
    low_speed_steering: float = 0.0


@dataclass(frozen=True)
class Unit:
    """One rigid unit of a combination: a truck, a trailer or a dolly.

    Attributes
    ----------
    name : str
        Name in topics, columns and tables.
    mass : float
        Mass [kg].
    yaw_inertia : float
        Inertia about the vertical axis through the centre of gravity [kg m^2].
    axles : tuple of Axle
    front_hitch, rear_hitch : float or None
        Distance from the centre of gravity [m], forward positive; None where there is none.
    cg_height, roll_axis_height : float or None
        Above the road [m].
    roll_inertia : float or None
        About the longitudinal axis through the centre of gravity [kg m^2].
    abs : bool or None
        Whether an anti-lock system keeps the wheels turning.
    hitch_height : float or None
        Height of the rear hitch above the road [m].
    hitch_roll_stiffness, hitch_roll_damping : float or None
        Roll stiffness and damping of the rear hitch [N m/rad, N m s/rad]; 0 if it does not couple roll.
    hitch_friction, hitch_damping : float or None
        Coulomb [N m] and viscous [N m s/rad] yaw friction of the rear hitch.
    max_articulation : float or None
        Articulation of the rear hitch at which the units touch [rad].
    front_overhang, rear_overhang : float or None
        Body before the foremost and behind the rearmost axle or hitch [m], for drawings and swept paths.
    width, height : float or None
        Size of the body [m], for drawings and swept paths.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import Axle, Unit
    >>> axles = (Axle(position=0.0, cornering_stiffness=6e5),)
    >>> Unit("dolly", mass=2500.0, yaw_inertia=2000.0, axles=axles, front_hitch=3.5, rear_hitch=0.1).name
    'dolly'
    """

    name: str
    mass: float
    yaw_inertia: float
    axles: tuple[Axle, ...]
    front_hitch: float | None = None
    rear_hitch: float | None = None
    cg_height: float | None = None
    roll_inertia: float | None = None
    roll_axis_height: float | None = None
    abs: bool | None = None
    hitch_height: float | None = None
    hitch_roll_stiffness: float | None = None
    hitch_roll_damping: float | None = None
    hitch_friction: float | None = None
    hitch_damping: float | None = None
    max_articulation: float | None = None
    front_overhang: float | None = None
    rear_overhang: float | None = None
    width: float | None = None
    height: float | None = None


@dataclass(frozen=True)
class Vehicle:
    """A combination of units, foremost first.

    Attributes
    ----------
    name : str
    speed : float
        Default longitudinal speed of its analysis [m/s].
    units : tuple of Unit
        Units from front to rear, each towed by the one before it.
    friction : float or None
        Coefficient of friction between tyres and road.
    drag_area : float or None
        Drag coefficient times frontal area [m^2].
    drag_height : float or None
        Height of the air drag above the road [m].
    start_force, drive_force : float or None
        Largest force at the driven wheels when starting and when moving slowly [N].
    drive_power : float or None
        Largest power at the driven wheels [W].

    Fields that are None are not given in the vehicle's file; `complete` fills them with documented defaults,
    but for those of the powertrain, which have none.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> vehicle = load_vehicle("truck_trailer")
    >>> vehicle.unit_names
    ('truck', 'trailer')
    >>> vehicle.hitches
    ((-2.539, 7.483),)
    """

    name: str
    speed: float
    units: tuple[Unit, ...]
    friction: float | None = None
    drag_area: float | None = None
    drag_height: float | None = None
    start_force: float | None = None
    drive_force: float | None = None
    drive_power: float | None = None

    @property
    def unit_names(self) -> tuple[str, ...]:
        """Names of the units, foremost first."""
        return tuple(unit.name for unit in self.units)

    @property
    def hitches(self) -> tuple[tuple[float, float], ...]:
        """Each coupling as (rear hitch of the towing unit, front hitch of the towed unit) [m].

        Raises
        ------
        ValueError
            If a unit lacks a hitch it needs, which `load_vehicle` does not let through.
        """
        pairs = []
        for towing, towed in pairwise(self.units):
            if towing.rear_hitch is None or towed.front_hitch is None:
                message = f"no hitch between {towing.name} and {towed.name}"
                raise ValueError(message)
            pairs.append((towing.rear_hitch, towed.front_hitch))
        return tuple(pairs)


def unstacked(stack: Vehicle, index: int) -> Vehicle:
    """Return one vehicle of a stack, with numbers that are floats.

    Parameters
    ----------
    stack : Vehicle
        Vehicle whose numbers may be arrays, shape (k,).
    index : int
        Place in these arrays.

    Returns
    -------
    Vehicle

    Examples
    --------
    >>> import numpy as np
    >>> from yawdamp_ros.vehicle import load_stack, unstacked, vehicle_text
    >>> masses = {"units.1.mass": np.array([1e4, 2e4])}
    >>> stack = load_stack(vehicle_text("truck_trailer"), "truck_trailer", [], masses)
    >>> unstacked(stack, 1).units[1].mass
    20000.0
    """

    def pick(value: Any) -> Any:  # noqa: ANN401 - of a record's field
        return float(value[index]) if isinstance(value, np.ndarray) else value

    def picked(record: Record) -> Record:
        numbers = {each.name: pick(getattr(record, each.name)) for each in fields(record)}
        return replace(record, **numbers)

    units = tuple(
        replace(picked(unit), axles=tuple(picked(axle) for axle in unit.axles)) for unit in stack.units
    )
    return replace(picked(stack), units=units)
