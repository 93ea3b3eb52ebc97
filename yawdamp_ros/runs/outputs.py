"""All outputs of a run in one table.

Topics, channels of recordings, columns of CSV files, curves of pictures and the table in the manual follow
from it. No ROS is needed to read it.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from enum import Enum
from types import MappingProxyType
from typing import NamedTuple

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.stepping import Response, Sample

FLOAT64 = "std_msgs/msg/Float64"
EVENTS = "events"
"""Topic of the vehicle's events."""


class Of(Enum):
    """Number of instances of an output: one for the run, or one for each unit, joint or wheel.

    Examples
    --------
    >>> from yawdamp_ros.runs import OUTPUTS, Of
    >>> [output.name for output in OUTPUTS if output.of is Of.JOINT]
    ['articulation', 'hitch_force_x', 'hitch_force_y', 'hitch_force_z']
    """

    RUN = "run"
    UNIT = "unit"
    JOINT = "joint"
    WHEEL = "wheel"


class Output(NamedTuple):
    """Quantity or message that a run puts out.

    Attributes
    ----------
    name : str
        Topic and column; it follows ``<unit>/`` or ``<unit>/axle_<axle>_<side>/`` or precedes ``_<joint>`` if
        there are several.
    of : Of
    description : str
    unit : str
        Unit of measure; empty for several quantities, which are no column.
    type_name : str
        Message type; empty if the output is no topic.
    fields : mapping of str to str
        Quantity by the path of its double in the message; ``{joint}`` is every joint; ``{x}``, ``{y}`` and
        ``{z}`` are the three entries of every joint's hitch or every wheel of the unit.
    some_fields : mapping of str to str
        Further fields, where the motion has their quantities.
    held : bool
        Whether a value holds until the next; else it changes towards it.
    value : callable, optional
        Function from a sample to the quantity, if it is neither a field of `Sample` nor in `Sample.extra`.

    Examples
    --------
    >>> from yawdamp_ros.runs import OUTPUTS
    >>> next(output for output in OUTPUTS if output.name == "yaw_rate").names(["truck", "trailer"])
    ['truck/yaw_rate', 'trailer/yaw_rate']
    """

    name: str
    of: Of
    description: str
    unit: str = ""
    type_name: str = ""
    fields: Mapping[str, str] = MappingProxyType({})
    some_fields: Mapping[str, str] = MappingProxyType({})
    held: bool = False
    value: Callable[[Sample], FloatArray] | None = None

    def names(self, unit_names: Sequence[str], axles: Sequence[int] = ()) -> list[str]:
        """Topics, or columns, for these units; those of wheels for their numbers of axles."""
        if self.of is Of.UNIT:
            return [f"{unit}/{self.name}" for unit in unit_names]
        if self.of is Of.JOINT:
            return [f"{self.name}_{joint}" for joint in range(1, len(unit_names))]
        if self.of is Of.WHEEL:
            return [
                f"{unit}/{wheel}/{self.name}"
                for unit, count in zip(unit_names, axles, strict=False)
                for wheel in wheel_names(count)
            ]
        return [self.name]

    def values(self, sample: Sample) -> FloatArray:
        """Quantity of this output, in the shapes of `Sample`."""
        return quantity(sample, self.name) if self.value is None else self.value(sample)


def wheel_names(axles: int) -> list[str]:
    """Names of the wheels of a unit, from the front, left before right."""
    return [f"axle_{axle}_{side}" for axle in range(1, axles + 1) for side in ("left", "right")]


def scalar(name: str, of: Of, description: str, unit: str) -> Output:
    """An output that is one number, as a topic and as a column."""
    return Output(name, of, description, unit, FLOAT64, {"data": name})


OUTPUTS: tuple[Output, ...] = (
    Output("steering_angle", Of.RUN, "steer angle", "rad", held=True),
    Output(
        "imu",
        Of.UNIT,
        "yaw, yaw rate and lateral acceleration, with noise where asked for; z shows gravity",
        type_name="sensor_msgs/msg/Imu",
        fields={
            "orientation.z": "imu_z",
            "orientation.w": "imu_w",
            "angular_velocity.z": "imu_yaw_rate",
            "linear_acceleration.x": "imu_longitudinal_acceleration",
            "linear_acceleration.y": "imu_lateral_acceleration",
        },
    ),
    Output(
        "odom",
        Of.UNIT,
        "pose of the centre of gravity in `odom`, velocity in the unit's own frame",
        type_name="nav_msgs/msg/Odometry",
        fields={
            "pose.pose.position.x": "x",
            "pose.pose.position.y": "y",
            "pose.pose.orientation.z": "z",
            "pose.pose.orientation.w": "w",
            "twist.twist.linear.x": "forward",
            "twist.twist.linear.y": "sideways",
            "twist.twist.angular.z": "yaw_rate",
        },
    ),
    Output(
        "joint_states",
        Of.RUN,
        "steer angle and articulation angles, with their rates; nonlinear model: also `hitch_<joint>_x`, "
        "`_y` and `_z`, whose effort is the force on the towed unit in the towing unit's frame, N",
        type_name="sensor_msgs/msg/JointState",
        fields={
            "position.0": "steering_angle",
            "velocity.0": "steering_rate",
            "position.{joint}": "articulation",
            "velocity.{joint}": "articulation_rate",
        },
        some_fields={
            "effort.{x}": "hitch_force_x",
            "effort.{y}": "hitch_force_y",
            "effort.{z}": "hitch_force_z",
        },
    ),
    Output(
        "axles",
        Of.UNIT,
        "wheels, each as `axle_<axle>_<side>_x`, `_y` and `_z`: position in the unit's frame, m; velocity "
        "is slip, x the share by which a braked wheel slides, y lateral slip; effort is force in the "
        "wheel's frame, z the load, N",
        type_name="sensor_msgs/msg/JointState",
        fields={
            "velocity.{x}": "slide",
            "velocity.{y}": "lateral_slip",
            "effort.{x}": "longitudinal_force",
            "effort.{y}": "lateral_force",
            "effort.{z}": "load",
        },
    ),
    scalar("yaw", Of.UNIT, "yaw", "rad"),
    scalar("yaw_rate", Of.UNIT, "yaw rate", "rad/s"),
    scalar("lateral_acceleration", Of.UNIT, "lateral acceleration", "m/s^2"),
    scalar("roll", Of.UNIT, "roll, to the right", "rad"),
    scalar(
        "load_transfer_ratio",
        Of.UNIT,
        "load transfer to the right",
        "1",
    ),
    Output("articulation", Of.JOINT, "articulation", "rad"),
    Output("hitch_force_x", Of.JOINT, "hitch force forwards", "N"),
    Output("hitch_force_y", Of.JOINT, "hitch force to the left", "N"),
    Output("hitch_force_z", Of.JOINT, "hitch load", "N"),
    Output("load", Of.WHEEL, "wheel load", "N"),
    Output("lateral_slip", Of.WHEEL, "lateral slip", "1"),
    Output("slide", Of.WHEEL, "share by which a braked wheel slides", "1"),
    Output("longitudinal_force", Of.WHEEL, "longitudinal force of a wheel", "N"),
    Output("lateral_force", Of.WHEEL, "lateral force of a wheel", "N"),
)
"""Outputs. A new one is added here; if only some models have it, also to their `quantity_names`."""

OF_EVERY_MODEL = (
    frozenset(Sample._fields)
    | {"steering_rate", "z", "w", "forward", "sideways"}
    | {
        *("imu_z", "imu_w", "imu_yaw_rate", "imu_lateral_acceleration", "imu_longitudinal_acceleration"),
    }
)
"""Quantities that the encoder finds in any sample."""


def available(quantity_names: Iterable[str]) -> list[Output]:
    """Outputs of a motion with these quantities besides those of every model."""
    known = OF_EVERY_MODEL.union(quantity_names)
    return [
        output
        for output in OUTPUTS
        if output.value is not None or known.issuperset(output.fields.values() or [output.name])
    ]


def columns(
    outputs: Iterable[Output], unit_names: Sequence[str], axles: Sequence[int] = ()
) -> list[tuple[str, Output, int]]:
    """Columns of outputs in the order of a CSV file: name, output, and index of the unit, joint or wheel.

    Wheels have columns only where the numbers of axles of the units are given.
    """
    single = [output for output in outputs if output.unit]
    by_unit = [
        (output, index) for index in range(len(unit_names)) for output in single if output.of is Of.UNIT
    ]
    order = [
        *((output, 0) for output in single if output.of is Of.RUN),
        *by_unit,
        *(
            (output, index)
            for output in single
            if output.of is Of.JOINT
            for index in range(len(unit_names) - 1)
        ),
        *((output, index) for index in range(2 * sum(axles)) for output in single if output.of is Of.WHEEL),
    ]
    return [(output.names(unit_names, axles)[index], output, index) for output, index in order]


def quantity(source: Sample | Response, name: str) -> FloatArray:
    """Quantity of a sample or a response: a field, or an element of `extra`."""
    values: FloatArray = source.extra[name] if name in source.extra else getattr(source, name)
    return values
