"""Damp a trailer's sway by braking one side of it: what electronic stability control of a trailer does.

    python examples/yaw_damping.py --output yaw_damping.png

A driver takes a rig along one and the same path with and without the controller. The controller wants the
last trailer to turn as the lead unit did where the trailer is now: it brakes the side that turns it there, by
a moment in proportion to the difference of the yaw rates. It reads yaw rates and a speed, and writes the
input ``<last unit>/yaw_moment``; its steps are those of the node's topics.
"""

import argparse
import math
import sys
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from yawdamp_ros import load_vehicle
from yawdamp_ros.simulation import SimParameters
from yawdamp_ros.simulation.plant import Plant
from yawdamp_ros.vehicle import Vehicle

PERIOD = 0.01
"""Period of the controller [s]."""
GAIN = 8e5
"""Moment for a difference of the yaw rates [N m s/rad]."""
LARGEST_MOMENT = 8e4
"""Largest yaw moment by the brakes of one side [N m]."""
PREVIEW = 20.0
"""Distance at which the driver looks at the path [m]."""
SMALL = 0.005
"""Steer angle that shakes the last unit without saturating a tyre [rad]."""
FREE = 4.8
"""Time from which on nothing but its own motion shakes the last unit [s]."""
CORRECTION = 0.05
"""Steer angle for a distance from the path there [rad/m]."""


@dataclass
class Drive:
    """Motion as driven, one row a period."""

    x: list[float] = field(default_factory=list)
    y: list[float] = field(default_factory=list)
    yaw: list[float] = field(default_factory=list)
    lateral_acceleration: list[list[float]] = field(default_factory=list)
    yaw_rate: list[list[float]] = field(default_factory=list)
    moment: list[float] = field(default_factory=list)
    events: list[str] = field(default_factory=list)

    @property
    def amplification(self) -> float:
        """Rearward amplification: largest lateral acceleration of the last unit over that of the first."""
        largest = np.abs(self.lateral_acceleration).max(axis=0)
        return float(largest[-1] / largest[0])

    def distance_from(self, other: "Drive") -> float:
        """Largest distance of the lead unit from another one's path [m]."""
        return float(np.abs(np.array(self.y) - np.interp(self.x, other.x, other.y)).max())

    @property
    def damping_ratio(self) -> float:
        """Damping ratio of the last unit's yaw rate in free motion, by its decrement."""
        rate = np.array(self.yaw_rate)[round(FREE / PERIOD) :, -1]
        size = np.abs(rate)
        peaks = 1 + np.flatnonzero((size[1:-1] >= size[:-2]) & (size[1:-1] > size[2:]))
        decrement = math.log(size[peaks[0]] / size[peaks[2]]) / 2.0  # of half a period
        return decrement / math.hypot(decrement, math.pi)


class YawDamper:
    """Yaw moment on the last unit that lets it turn as the lead unit did where it is now.

    Parameters
    ----------
    vehicle : Vehicle
    """

    def __init__(self, vehicle: Vehicle) -> None:
        self._distance = sum(front - rear for rear, front in vehicle.hitches)
        self._past: deque[float] = deque([0.0])

    def moment(self, lead_rate: float, last_rate: float, speed: float) -> float:
        """Moment to be asked for [N m] by yaw rates [rad/s] and the speed [m/s]."""
        self._past.append(lead_rate)
        while len(self._past) > self._distance / max(speed, 1.0) / PERIOD:
            self._past.popleft()
        wanted = GAIN * (self._past[0] - last_rate)
        return min(max(wanted, -LARGEST_MOMENT), LARGEST_MOMENT)


def manoeuvre(time: float, amplitude: float) -> float:
    """Steer angle of a single sine of 0.4 Hz from 1 s on [rad]."""
    return amplitude * math.sin(0.8 * math.pi * (time - 1.0)) if 1.0 <= time < 3.5 else 0.0  # noqa: PLR2004


def drive(  # noqa: PLR0913 - each is one thing to vary
    vehicle: Vehicle,
    amplitude: float,
    *,
    path: Drive | None = None,
    damped: bool = False,
    friction: float = 0.8,
    duration: float = 9.5,
) -> Drive:
    """Drive a manoeuvre, along the path of another drive where one is given."""
    plant = Plant(SimParameters(model="nonlinear", speed=vehicle.speed, publish_rate=1.0 / PERIOD), vehicle)
    plant.step({"friction": friction})
    damper, done = YawDamper(vehicle), Drive()
    place = f"{vehicle.unit_names[-1]}/yaw_moment"
    while plant.time < duration and plant.run.stopped is None:
        now = plant.sample
        angle = manoeuvre(plant.time, amplitude)
        if path is not None:
            aim = float(now.x[0]) + PREVIEW * math.cos(now.yaw[0])
            there = float(now.y[0]) + PREVIEW * math.sin(now.yaw[0])
            angle += CORRECTION * (_preview(path, aim) - there)
        moment = damper.moment(float(now.yaw_rate[0]), float(now.yaw_rate[-1]), now.velocity[0].real)
        plant.step({"steering": angle, place: moment if damped else 0.0})
        done.x.append(float(now.x[0]))
        done.y.append(float(now.y[0]))
        done.yaw.append(float(now.yaw[0]))
        done.lateral_acceleration.append(now.lateral_acceleration.tolist())
        done.yaw_rate.append(now.yaw_rate.tolist())
        done.moment.append(moment if damped else 0.0)
    done.events = [f"{event.name} of {event.where}" for event in plant.run.events]
    return done


def _preview(path: Drive, aim: float) -> float:
    """Return the point at which a driver of this path aimed, who then needs no correction."""
    ahead = np.array(path.x) + PREVIEW * np.cos(path.yaw)
    return float(np.interp(aim, ahead, np.array(path.y) + PREVIEW * np.sin(path.yaw)))


def compare(vehicle: Vehicle, amplitude: float, friction: float = 0.8) -> tuple[Drive, Drive]:
    """The same path without and with the controller."""
    plain = drive(vehicle, amplitude, friction=friction)
    return plain, drive(vehicle, amplitude, path=plain, damped=True, friction=friction)


SWAYING = (
    "units.1.front_hitch=4.5",
    "units.1.axles.0.position=-0.3",
    "units.1.yaw_inertia=150000",
    "speed=22.2",
)
"""File of a truck with a long centre-axle trailer, whose sway hardly dies out by itself."""
CASES = (
    ("A-double, dry road", load_vehicle("a_double"), 0.02, 0.8),
    ("A-double, friction 0.3", load_vehicle("a_double"), 0.02, 0.3),
    ("low-damped centre-axle trailer", load_vehicle("truck_trailer", SWAYING), 0.01, 0.8),
)


def main(arguments: Sequence[str]) -> int:
    """Drive every case, print what it gains, draw the first."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--output", metavar="FILE", help="picture of the A-double with and without")
    options = parser.parse_args(arguments)
    drives = []
    for name, vehicle, amplitude, friction in CASES:
        plain, damped = compare(vehicle, amplitude, friction)
        drives.append((plain, damped))
        change = damped.amplification / plain.amplification - 1.0
        print(
            f"{name}: rearward amplification {plain.amplification:.2f} to {damped.amplification:.2f} "
            f"({100.0 * change:+.0f} %), "
            f"lead unit within {damped.distance_from(plain):.2f} m of its path, "
            f"events: {', '.join(damped.events) or 'none'}"
        )
    sways = [drive(CASES[-1][1], SMALL, damped=damped).damping_ratio for damped in (False, True)]
    print(f"{CASES[-1][0]}: damping ratio of its sway {sways[0]:.2f} to {sways[1]:.2f}")
    if options.output:
        draw(*drives[0], options.output)
    return 0


def draw(plain: Drive, damped: Drive, output: str) -> None:
    """Draw the lateral acceleration of the first and the last unit, and the moment."""
    from matplotlib.figure import Figure  # noqa: PLC0415 - only where a picture is wanted

    figure = Figure(figsize=(9.0, 4.6), layout="constrained")
    above, below = figure.subplots(2, sharex=True, height_ratios=(3, 1))
    time = PERIOD * np.arange(len(plain.x))
    above.plot(time, np.array(plain.lateral_acceleration)[:, 0], color="0.6", label="tractor")
    for done, colour, label in (
        (plain, "#d55e00", "last trailer"),
        (damped, "#0072b2", "last trailer, damped"),
    ):
        above.plot(
            PERIOD * np.arange(len(done.x)),
            np.array(done.lateral_acceleration)[:, -1],
            color=colour,
            label=label,
        )
    above.set(ylabel="lateral acceleration, m/s²", title="Yaw damping of an A-double by braking one side")
    below.plot(PERIOD * np.arange(len(damped.x)), 1e-3 * np.array(damped.moment), color="#0072b2")
    below.set(xlabel="time, s", ylabel="moment, kN m")
    for axes in (above, below):
        axes.grid(visible=True, color="0.9")
    above.legend(loc="upper right")
    figure.savefig(output)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
