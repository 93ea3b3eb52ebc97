"""Everything that acts on a run besides steering, in one table.

Topics, channels of logs, ranges, diagnostics and the table in the manual follow from it;
the `input_names` of a model say which inputs it takes.
"""

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

from yawdamp_ros.stepping import HeldInput, Motion
from yawdamp_ros.stepping.held_input import FASTEST_REVERSE, HIGHEST_SPEED, LOWEST_FOLLOWED

LONGITUDINAL = ("speed", "acceleration")
"""Inputs of which one is in force at a time, as `longitudinal_source` says."""


class Input(NamedTuple):
    """A number that can be commanded.

    Attributes
    ----------
    name : str
        Topic; it follows ``<unit>/`` if each unit has one.
    description : str
    unit : str
    low, high : float
        Range; a value outside is clamped.
    of_unit : bool
    repeated : bool
        Whether a controller repeats it, so that silence means that the controller is gone.
    """

    name: str
    description: str
    unit: str
    low: float
    high: float
    of_unit: bool = False
    repeated: bool = True

    @property
    def topic(self) -> str:
        """Relative topic, with ``<unit>`` for the unit's name."""
        return f"<unit>/{self.name}" if self.of_unit else self.name


INPUTS: tuple[Input, ...] = (
    Input(
        "speed",
        "with `longitudinal_source` speed; a linear model follows it quasi-statically, from 1 m/s up, the "
        "nonlinear one by a controller, from -5 m/s over 0 up",
        "m/s",
        -FASTEST_REVERSE,
        HIGHEST_SPEED,
    ),
    Input(
        "acceleration",
        "with `longitudinal_source` acceleration; of the combination, negative by all brakes",
        "m/s^2",
        -15.0,
        15.0,
    ),
    Input(
        "gear",
        "1, 0 or -1 (reverse), to which a positive acceleration drives",
        "1",
        -1.0,
        1.0,
        repeated=False,
    ),
    Input("friction", "of tyres on the road from now on", "1", 0.01, 2.0, repeated=False),
    Input("brake", "brake demand besides, over the unit's own mass", "m/s^2", 0.0, 15.0, of_unit=True),
    Input("yaw_moment", "by braking one side, left positive", "N m", -1e6, 1e6, of_unit=True),
    Input("steering", "of axles with `steered: commanded`, left positive", "rad", -0.8, 0.8, of_unit=True),
)
"""An input is added here, and to the `input_names` of the models that take it."""

_BY_TOPIC: Mapping[str, Input] = MappingProxyType({each.topic: each for each in INPUTS})


def input_of(name: str) -> Input | None:
    """Entry of a motion's input; None where it has none.

    Parameters
    ----------
    name : str
        One of a motion's `input_names`.

    Returns
    -------
    Input or None

    Examples
    --------
    >>> input_of("trailer_1/yaw_moment").unit
    'N m'
    """
    unit, _, last = name.rpartition("/")
    return _BY_TOPIC.get(f"<unit>/{last}" if unit else last)


def held_inputs(motion: Motion) -> dict[str, HeldInput]:
    """Make the inputs, besides steering, that a motion can be commanded by, each by its name.

    Parameters
    ----------
    motion : Motion

    Returns
    -------
    dict of str to HeldInput

    Examples
    --------
    >>> from yawdamp_ros.simulation import make_motion
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> list(held_inputs(make_motion(load_vehicle("interlink"), "consistent", None, 0.001)))
    ['speed']
    """
    made = {}
    for name in motion.input_names:
        kind = input_of(name)
        if kind is not None:
            made[name] = HeldInput(None, kind.low, kind.high)
    # A vehicle whose speed is a state can stand and reverse; else slip angles need forward motion.
    if "speed" in made:
        stands = "acceleration" in made
        low = -FASTEST_REVERSE if stands else LOWEST_FOLLOWED
        made["speed"] = HeldInput(motion.speed, low, HIGHEST_SPEED, backwards=stands)
    return made
