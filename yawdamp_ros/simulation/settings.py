"""Parameters of the simulator node: one record for the node, its help, the manual and config/sim.yaml."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import Field, dataclass, field, fields
from types import MappingProxyType
from typing import Any

from yawdamp_ros.dynamics import LOWEST_SPEED
from yawdamp_ros.dynamics.linear_range import LINEAR_ARTICULATION, LINEAR_LATERAL_ACCELERATION
from yawdamp_ros.manoeuvres import MANOEUVRES, SETTINGS
from yawdamp_ros.simulation.models import MODELS
from yawdamp_ros.simulation.steering_messages import (
    AUTOWARE_CONTROL,
    LONGITUDINAL_TYPES,
    STEERING_TYPES,
)
from yawdamp_ros.stepping import Start
from yawdamp_ros.stepping.held_input import FASTEST_REVERSE, HIGHEST_SPEED

UNSET = float("nan")
"""Value of a number that was not given: the manoeuvre's default applies."""
SLOWEST = 0.1
"""Least real_time_factor; slower, a pause and single steps serve better."""
FASTEST_RATE = 1e4
"""Largest rate of samples that a node accepts, in real time [1/s]."""
_ANGLE = "NaN, or an angle of at most pi/2"
_POSITIVE = "NaN, or a number above 0"
_NOT_NEGATIVE = "NaN, or a number of at least 0"


def _parameter(  # noqa: PLR0913 - each is one property of a parameter
    default: object,
    description: str,
    *,
    limits: tuple[float, float] | None = None,
    choices: Iterable[str] = (),
    constraint: str = "",
    dynamic: bool = False,
    name: str = "",
    kind: type | None = None,
    otherwise: str = "",
) -> Any:  # noqa: ANN401 - dataclasses.field is typed by its default
    metadata = {
        "description": description,
        "limits": limits,
        "choices": tuple(choices),
        "constraint": constraint,
        "dynamic": dynamic,
        "name": name,
        "kind": type(default) if kind is None else kind,
        "otherwise": otherwise,
    }
    if isinstance(default, list):
        return field(default_factory=default.copy, metadata=metadata)
    return field(default=default, metadata=metadata)


def _setting(name: str, description: str, constraint: str) -> Any:  # noqa: ANN401 - as above
    """Declare a number of a manoeuvre; NaN where it was not given, which no range can hold."""
    return _parameter(
        UNSET,
        f"{description}; NaN: the manoeuvre's default",
        constraint=constraint,
        name=f"manoeuvre.{name}",
    )


# ruff: noqa: RUF009 - each default is a dataclasses.field
@dataclass(frozen=True)
class SimParameters:
    """Parameters of the simulator node; `PARAMETERS` holds the names that a ROS graph sees.

    Examples
    --------
    >>> from yawdamp_ros.simulation import SimParameters
    >>> SimParameters(vehicle="a_double").publish_rate
    100.0
    """

    vehicle: str = _parameter("interlink", "builtin name or path of a vehicle file")
    vehicle_overrides: list[str] = _parameter(
        [""], "changes to the vehicle, each KEY=VALUE as in units.1.mass=4156"
    )
    model: str = _parameter("consistent", "model of the vehicle", choices=MODELS)
    speed: float | None = _parameter(
        None,
        "longitudinal speed in m/s; the nonlinear model reaches it by a controller",
        limits=(-FASTEST_REVERSE, HIGHEST_SPEED),
        dynamic=True,
        kind=float,
        otherwise="`initial_speed`, or the vehicle's own",
    )
    longitudinal_source: str = _parameter(
        "parameter",
        "source of the speed: the parameter, the topic speed or acceleration, or the steering message's own "
        "fields, each from its first message on",
        choices=("parameter", "speed", "acceleration", "steering"),
        dynamic=True,
    )
    initial_speed: float | None = _parameter(
        None,
        "speed at the start in m/s",
        limits=(-FASTEST_REVERSE, HIGHEST_SPEED),
        kind=float,
        otherwise="speed",
    )
    initial_pose: list[float] = _parameter(
        [0.0, 0.0, 0.0], "x and y in m and yaw in rad of the lead unit at the start, and after a reset"
    )
    initial_articulation: list[float] = _parameter(
        [0.0], "articulation of every joint at the start in rad; one 0: straight; nonlinear model"
    )
    start_paused: bool = _parameter(
        default=False, description="time stands until ~/pause or ~/step is called"
    )
    wait_for_command: bool = _parameter(
        default=False, description="time stands until the first command is accepted"
    )
    step_samples: int = _parameter(1, "sample periods that ~/step takes", limits=(1, 100_000), dynamic=True)
    step_size: float = _parameter(0.001, "fixed integration step in s", limits=(1e-6, 1.0))
    publish_rate: float = _parameter(100.0, "samples a second of simulated time, in Hz", limits=(0.1, 1e4))
    real_time_factor: float = _parameter(
        1.0,
        "simulated over real time, 0.1 to 100; 0: as fast as it goes",
        limits=(0.0, 100.0),
        dynamic=True,
    )
    autoware: bool = _parameter(
        default=False,
        description="take Autoware's control_cmd and gear_cmd, and publish its vehicle status",
    )
    friction_file: str = _parameter(
        "",
        "CSV file with the columns distance in m along the path and friction from there on; nonlinear model",
    )
    steering_type: str = _parameter(
        "std_msgs/msg/Float64", "message type of the steering topic", choices=STEERING_TYPES
    )
    steering_joint: str = _parameter("steering", "joint that steers, where the type is JointState")
    steering_ratio: float = _parameter(
        1.0, "steering command over road-wheel angle; 1: road-wheel commands", limits=(1e-3, 1e3)
    )
    max_steering_angle: float = _parameter(
        0.8, "road-wheel angle in rad beyond which a command is clamped", limits=(0.0, 1.5), dynamic=True
    )
    max_steering_age: float = _parameter(
        0.5,
        "largest difference in s between a command's stamp and now; 0: any",
        limits=(0.0, 1e6),
        dynamic=True,
    )
    steering_timeout: float = _parameter(
        0.5,
        "simulated time in s without a command after which on_steering_timeout acts; silence of other inputs "
        "is reported, too",
        limits=(0.0, 1e6),
        dynamic=True,
    )
    on_steering_timeout: str = _parameter(
        "hold", "after a timeout: hold the last command, or zero", choices=("hold", "zero"), dynamic=True
    )
    steering_dead_time: float = _parameter(
        0.0, "time in s from a steering command until the road wheels begin to follow", limits=(0.0, 10.0)
    )
    acceleration_dead_time: float = _parameter(
        0.0, "time in s from a demanded acceleration until it begins to act", limits=(0.0, 10.0)
    )
    acceleration_time_constant: float = _parameter(
        0.0, "first-order lag of a demanded acceleration in s; 0: none", limits=(0.0, 10.0)
    )
    steering_time_constant: float = _parameter(
        0.0, "first-order lag of the road wheels in s; 0: none", limits=(0.0, 10.0)
    )
    steering_rate_limit: float = _parameter(
        0.0, "largest rate of the road-wheel angle in rad/s; 0: any", limits=(0.0, 100.0)
    )
    manoeuvre: str = _parameter(
        "none",
        "manoeuvre by which the node steers, in place of the topic",
        choices=("none", *MANOEUVRES),
        name="manoeuvre.name",
    )
    amplitude: float = _setting("amplitude", "road-wheel steer angle of the manoeuvre in rad", _ANGLE)
    frequency: float = _setting(
        "frequency", "frequency of sine and lane change, and of the chirp's start, in Hz", _POSITIVE
    )
    start: float = _setting("start", "simulated time at which the manoeuvre begins, in s", _NOT_NEGATIVE)
    cycles: float = _setting(
        "cycles", "number of cycles of sine and lane change, 0 for no end", _NOT_NEGATIVE
    )
    rise_time: float = _setting("rise_time", "duration of the ramp in s", _POSITIVE)
    width: float = _setting("width", "duration of the pulse in s", _POSITIVE)
    final_frequency: float = _setting(
        "final_frequency", "frequency of the chirp at its end, in Hz", _POSITIVE
    )
    sweep_time: float = _setting("sweep_time", "duration of the chirp in s", _POSITIVE)
    max_lateral_acceleration: float = _parameter(
        100.0,
        "lateral acceleration of any unit in m/s^2 beyond which the run is stopped",
        limits=(1.0, 1e6),
        dynamic=True,
    )
    max_articulation: float = _parameter(
        3.14,
        "articulation of any joint in rad beyond which the run is stopped",
        limits=(0.1, 1e3),
        dynamic=True,
    )
    warn_lateral_acceleration: float = _parameter(
        LINEAR_LATERAL_ACCELERATION,
        "lateral acceleration of any unit in m/s^2 beyond which the run leaves the linear range; it goes on",
        limits=(0.1, 1e6),
        dynamic=True,
    )
    warn_articulation: float = _parameter(
        LINEAR_ARTICULATION,
        "articulation of any joint in rad beyond which the run leaves the linear range; it goes on",
        limits=(0.01, 1e3),
        dynamic=True,
    )
    duration: float = _parameter(
        0.0, "simulated time in s after which the node ends; 0: none", limits=(0.0, 1e9)
    )
    publish_scalars: bool = _parameter(
        default=True, description="also publish yaw, yaw_rate and lateral_acceleration as Float64"
    )
    publish_clock: bool | None = _parameter(
        None,
        "publish simulated time on /clock",
        kind=bool,
        otherwise="whether real_time_factor is not 1",
    )
    publish_markers: bool = _parameter(default=False, description="publish the units as markers")
    publish_tf: bool = _parameter(
        default=True,
        description="record the frames of the units, and publish them where tf2_msgs is installed",
    )
    publish_tf_hitches: bool = _parameter(
        default=True,
        description="also those behind the lead unit; false beside a robot_state_publisher",
    )
    world_frame: str = _parameter(
        "",
        "frame that all rigs share, such as map, to which the frame odom of this one is fixed; empty: none",
    )
    frame_prefix: str = _parameter(
        "",
        "prefix of the names of all frames, such as left/, which keeps nodes side by side apart on /tf",
        otherwise="the node's namespace",
    )
    yaw_stddev: float = _parameter(
        0.0, "standard deviation of the noise on imu's yaw in rad", limits=(0.0, 1.0)
    )
    yaw_rate_stddev: float = _parameter(
        0.0, "standard deviation of the noise on imu's yaw rate in rad/s", limits=(0.0, 1.0)
    )
    lateral_acceleration_stddev: float = _parameter(
        0.0, "standard deviation of the noise on imu's lateral acceleration in m/s^2", limits=(0.0, 10.0)
    )
    yaw_bias: float = _parameter(0.0, "constant error of imu's yaw in rad", limits=(-1.0, 1.0))
    yaw_rate_bias: float = _parameter(0.0, "constant error of imu's yaw rate in rad/s", limits=(-1.0, 1.0))
    lateral_acceleration_bias: float = _parameter(
        0.0, "constant error of imu's lateral acceleration in m/s^2", limits=(-10.0, 10.0)
    )
    yaw_drift: float = _parameter(
        0.0,
        "random walk of imu's yaw, standard deviation after a second in rad",
        limits=(0.0, 1.0),
    )
    yaw_rate_drift: float = _parameter(
        0.0,
        "random walk of imu's yaw rate, standard deviation after a second in rad/s",
        limits=(0.0, 1.0),
    )
    lateral_acceleration_drift: float = _parameter(
        0.0,
        "random walk of imu's lateral acceleration, standard deviation after a second in m/s^2",
        limits=(0.0, 10.0),
    )
    imu_delay: float = _parameter(
        0.0, "time in s by which imu shows the motion late, in whole sample periods", limits=(0.0, 10.0)
    )
    noise_seed: int = _parameter(
        0, "seed of the noise: the same seed gives the same noise", limits=(0, 2**31 - 1)
    )
    record: bool = _parameter(default=True, description="record the run from its start")
    record_directory: str = _parameter(
        "",
        "directory of the run, which must not exist; empty: runs/<stamp>_<vehicle>; a change applies to the "
        "next ~/record and must be a path below the working directory",
        dynamic=True,
    )

    def problem(self) -> str:
        """First conflict between these values; empty if there is none."""
        if problem := self.start_problem() or self.model_problem() or self._source_problem():
            return problem
        if 0.0 < self.real_time_factor < SLOWEST:
            return f"real_time_factor: {self.real_time_factor}: expected 0, or {SLOWEST} to 100"
        if self.publish_rate * max(self.real_time_factor, 1.0) > FASTEST_RATE:
            return (
                f"real_time_factor: {self.real_time_factor}: with publish_rate {self.publish_rate} "
                f"expected at most {FASTEST_RATE:g} samples a second"
            )
        if self.manoeuvre == "none" and self.manoeuvre_settings:
            given = next(iter(self.manoeuvre_settings))
            return f"manoeuvre.{given}: manoeuvre.name is none; expected a manoeuvre"
        return ""

    def start_problem(self) -> str:
        """First conflict in how the run starts; empty if there is none."""
        if len(self.initial_pose) != len(Start._fields) - 1 or not all(map(math.isfinite, self.initial_pose)):
            return f"initial_pose: {list(self.initial_pose)}: expected x and y in m and yaw in rad"
        if not all(abs(angle) < math.pi for angle in self.initial_articulation):
            return f"initial_articulation: {list(self.initial_articulation)}: expected angles below pi in rad"
        if self.start_paused and self.wait_for_command:
            return "wait_for_command: start_paused is given as well; expected one of the two"
        return ""

    def _source_problem(self) -> str:
        if self.autoware and self.steering_type != AUTOWARE_CONTROL:
            return f"autoware: true: steering_type is {self.steering_type}; expected {AUTOWARE_CONTROL}"
        if self.longitudinal_source != "steering":
            return ""
        if self.manoeuvre != "none":
            return f"longitudinal_source: steering: the manoeuvre {self.manoeuvre} steers, and no message"
        if self.steering_type not in LONGITUDINAL_TYPES:
            return (
                f"longitudinal_source: steering: {self.steering_type} holds no speed; expected steering_type "
                f"{' or '.join(LONGITUDINAL_TYPES)}"
            )
        return ""

    def model_problem(self) -> str:
        """First setting that the model cannot follow; empty if there is none."""
        if self.model == "nonlinear":
            return ""
        for name, speed in (("speed", self.speed), ("initial_speed", self.initial_speed)):
            if speed is not None and speed < LOWEST_SPEED:
                return (
                    f"{name}: {speed}: model {self.model} cannot stand or reverse; expected at least "
                    f"{LOWEST_SPEED} m/s, or model nonlinear; leave it out for the vehicle's own"
                )
        if self.friction_file:
            return (
                f"friction_file: {self.friction_file}: model {self.model} has no friction; expected nonlinear"
            )
        if self.longitudinal_source == "acceleration":
            return (
                f"longitudinal_source: acceleration: model {self.model} follows speeds alone; expected model "
                "nonlinear"
            )
        return ""

    @property
    def first_speed(self) -> float | None:
        """Speed at the start [m/s]; None: the vehicle's own."""
        return self.speed if self.initial_speed is None else self.initial_speed

    @property
    def first_pose(self) -> Start:
        """Pose at the start."""
        x, y, yaw = self.initial_pose
        articulation = tuple(self.initial_articulation)
        return Start(x, y, yaw, articulation if any(articulation) else ())

    @property
    def clock(self) -> bool:
        """True if simulated time is published on /clock; by default if it is not real time."""
        return self.real_time_factor != 1.0 if self.publish_clock is None else self.publish_clock

    @property
    def manoeuvre_settings(self) -> dict[str, float]:
        """Settings of the manoeuvre that were given."""
        given = {name: getattr(self, name) for name in SETTINGS}
        return {name: value for name, value in given.items() if not math.isnan(value)}


PARAMETERS: Mapping[str, Field[Any]] = MappingProxyType(
    {declared.metadata["name"] or declared.name: declared for declared in fields(SimParameters)}
)
"""Fields of `SimParameters` by the names of the node's parameters."""

FORMER_NAMES: Mapping[str, str] = MappingProxyType(
    {declared.name: name for name, declared in PARAMETERS.items() if name != declared.name}
    | {"speed_source": "longitudinal_source"}
)
"""Present name of each former name that 0.1 still accepts."""

FORMER_VALUES: Mapping[tuple[str, str], str] = MappingProxyType({("speed_source", "topic"): "speed"})
"""Present value of each former name and value."""
