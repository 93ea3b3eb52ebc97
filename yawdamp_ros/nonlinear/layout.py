"""Places of the quantities in the state and in the input of the nonlinear model."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from yawdamp_ros.nonlinear.compiled import compiled

X, Y, YAW = 0, 1, 2
"""State: position of the lead unit's ground point [m] and yaw [rad]; articulations follow."""

STEERING, ACCELERATION, SPEED, FRICTION_LEFT, FRICTION_RIGHT, GRADE, CROSSFALL, GEAR = range(8)
"""Input: see `InputLayout`."""
AXLE_STEERING = 8


@compiled
def speed_index(units: int) -> int:
    """Index of the lead unit's longitudinal velocity in the state; lateral velocity and yaw rates follow."""
    return 2 + units


@compiled
def roll_index(units: int) -> int:
    """Index of the first roll angle; roll rates, pitching moments and slips follow."""
    return 4 + 2 * units


@dataclass(frozen=True)
class StateLayout:
    """Slices of the state vector.

    Parameters
    ----------
    units, axles : int

    Examples
    --------
    >>> StateLayout(3, 7).size
    47
    >>> StateLayout(3, 7).articulation
    slice(3, 5, None)
    """

    units: int
    axles: int

    @property
    def articulation(self) -> slice:
        """Articulation angles, yaw of the unit ahead less yaw of the unit behind [rad]."""
        return slice(3, 2 + self.units)

    @property
    def velocity(self) -> slice:
        """Longitudinal and lateral velocity of the lead unit in its own frame [m/s]."""
        return slice(2 + self.units, 4 + self.units)

    @property
    def yaw_rate(self) -> slice:
        """Yaw rates [rad/s]."""
        return slice(4 + self.units, 4 + 2 * self.units)

    @property
    def roll(self) -> slice:
        """Roll angles [rad], positive where the unit leans to the right."""
        return self._of_units(0)

    @property
    def roll_rate(self) -> slice:
        """Roll rates [rad/s]."""
        return self._of_units(1)

    @property
    def pitching_moment(self) -> slice:
        """Moments that shift load forward [N m]."""
        return self._of_units(2)

    @property
    def lateral_slip(self) -> slice:
        """Lateral slip of every wheel; kept at 0 where there is no relaxation length."""
        start = 4 + 5 * self.units
        return slice(start, start + 2 * self.axles)

    @property
    def carcass(self) -> slice:
        """Longitudinal deflection of every braked wheel over its largest, -1 to 1."""
        start = 4 + 5 * self.units + 2 * self.axles
        return slice(start, start + 2 * self.axles)

    @property
    def size(self) -> int:
        """Length of the state."""
        return 4 + 5 * self.units + 4 * self.axles

    @property
    def moving(self) -> slice:
        """Slice without position and yaw of the lead unit, on which nothing depends on a flat road."""
        return slice(3, self.size)

    def names(self, unit_names: Sequence[str]) -> tuple[str, ...]:
        """Return the name of every element.

        Parameters
        ----------
        unit_names : sequence of str
        """
        wheels = [f"wheel_{wheel}" for wheel in range(1, 2 * self.axles + 1)]
        return (
            *("x", "y", "yaw"),
            *(f"articulation_{joint}" for joint in range(1, self.units)),
            *("longitudinal_velocity", "lateral_velocity"),
            *(
                f"{unit}/{name}"
                for name in ("yaw_rate", "roll", "roll_rate", "pitching_moment")
                for unit in unit_names
            ),
            *(f"{wheel}/{name}" for name in ("lateral_slip", "carcass") for wheel in wheels),
        )

    @cached_property
    def unit_of(self) -> tuple[int, ...]:
        """Unit of every element up to the pitching moments; wheels belong to the unit of their axle."""
        every = range(self.units)
        return (0, 0, 0, *every[1:], 0, 0, *every, *every, *every, *every)

    def _of_units(self, place: int) -> slice:
        start = 4 + (2 + place) * self.units
        return slice(start, start + self.units)


@dataclass(frozen=True)
class InputLayout:
    """Slices of the input vector.

    0 steering, the road-wheel angle [rad]; 1 acceleration of the combination [m/s^2], negative by all brakes;
    2 speed that the controller holds [m/s], NaN for none; 3, 4 friction of the left and the right wheels; 5
    grade, the road's rise along X; 6 crossfall, its rise along Y; 7 gear, to which a positive acceleration
    drives: 1 forwards, 0 nowhere, -1 backwards; and then the slices below.

    Parameters
    ----------
    units, axles : int
        Numbers of the whole combination.

    Examples
    --------
    >>> from yawdamp_ros.nonlinear import InputLayout
    >>> InputLayout(units=2, axles=3).brake
    slice(11, 13, None)
    """

    units: int
    axles: int

    @property
    def axle_steering(self) -> slice:
        """Steer angle of every axle besides the steering [rad]."""
        return slice(AXLE_STEERING, AXLE_STEERING + self.axles)

    @property
    def brake(self) -> slice:
        """Brake force demanded of every unit besides the acceleration [N]."""
        return slice(self.axle_steering.stop, self.axle_steering.stop + self.units)

    @property
    def yaw_moment(self) -> slice:
        """Yaw moment demanded of every unit, by braking one side [N m]."""
        return slice(self.brake.stop, self.brake.stop + self.units)

    @property
    def size(self) -> int:
        """Length of the input."""
        return AXLE_STEERING + self.axles + 2 * self.units
