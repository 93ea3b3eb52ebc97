"""Brake with all there is in a bend on a slippery road, with and without ABS.

    python examples/emergency_braking.py --output emergency_braking.png

A tractor and semitrailer takes a bend at 15 m/s. A patch of friction 0.3 begins, and an
emergency brake demands 6 m/s^2, twice what that road gives. With ABS the wheels keep turning, and the rig
follows the bend to rest. Without, wheels lock and guide no more.
"""

import argparse
import sys
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from yawdamp_ros import load_vehicle
from yawdamp_ros.simulation import SimParameters
from yawdamp_ros.simulation.plant import Plant

PERIOD = 0.01
"""Period of the controller [s]."""
SPEED = 15.0
"""In m/s."""
FRICTION = 0.3
"""Friction of the patch."""
DEMAND = -6.0
"""Demanded deceleration [m/s^2]."""
STEERING = 0.025
"""Steer angle of the bend [rad]."""
BRAKING = 6.0
"""Time at which the patch and the braking begin [s]."""


class Stop(NamedTuple):
    """Outcome of one emergency braking.

    Attributes
    ----------
    distance : float
        From the demand to rest [m].
    off : float
        Largest distance of the tractor from the bend that it drove before [m].
    articulation : float
        Largest after the demand [rad].
    events : list of str
        With their times.
    path : ndarray, shape (k, n, 2)
        Of the units' centres of gravity [m].
    yaw : ndarray, shape (k, n)
        In rad.
    """

    distance: float
    off: float
    articulation: float
    events: list[str]
    path: np.ndarray
    yaw: np.ndarray

    @property
    def locked(self) -> list[str]:
        """Wheels that locked."""
        return [event for event in self.events if "wheel_lock" in event]


def brake(*, abs_: bool) -> Stop:
    """Brake from a steady turn to rest."""
    vehicle = load_vehicle(
        "tractor_semitrailer", [f"units.{unit}.abs={str(abs_).lower()}" for unit in (0, 1)]
    )
    settings = SimParameters(
        model="nonlinear", initial_speed=SPEED, longitudinal_source="acceleration", publish_rate=1.0 / PERIOD
    )
    plant = Plant(settings, vehicle)
    where, yaw, bend = [], [], 0.0
    while plant.run.stopped is None and plant.time < BRAKING + 15.0:
        bend = min(bend + STEERING * PERIOD / 2.0, STEERING)
        inputs = {"steering": bend}
        if plant.time >= BRAKING:
            inputs |= {"friction": FRICTION, "acceleration": DEMAND}
        sample = plant.step(inputs)
        where.append(np.column_stack([sample.x, sample.y]))
        yaw.append(sample.yaw)
        if plant.time > BRAKING and np.abs(sample.velocity).max() < 0.05:  # noqa: PLR2004 - at rest, m/s
            break
    path, turned = np.array(where), np.array(yaw)
    begun = round(BRAKING / PERIOD)
    steps = np.linalg.norm(np.diff(path[begun:, 0], axis=0), axis=1)
    events = [
        f"{plant.grid.seconds(each.step):.2f} s {each.name} of {each.where}" for each in plant.run.events
    ]
    articulation = np.abs(turned[begun:, 0] - turned[begun:, 1]).max()
    return Stop(float(steps.sum()), _off(path[:, 0], begun), float(articulation), events, path, turned)


def _off(path: np.ndarray, begun: int) -> float:
    """Distance from the circle through the path of the last two seconds before an instant [m]."""
    x, y = path[begun - 200 : begun].T
    # x^2 + y^2 = 2 a x + 2 b y + c, the circle's centre (a, b).
    (a, b, c), *_ = np.linalg.lstsq(
        np.column_stack([2.0 * x, 2.0 * y, np.ones_like(x)]), x * x + y * y, rcond=None
    )
    radius = np.sqrt(c + a * a + b * b)
    return float(np.abs(np.hypot(path[begun:, 0] - a, path[begun:, 1] - b) - radius).max())


def main(arguments: Sequence[str]) -> int:
    """Brake with and without ABS, print what differs, draw both."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--output", metavar="FILE", help="picture of both from above")
    options = parser.parse_args(arguments)
    stops = {"with ABS": brake(abs_=True), "without ABS": brake(abs_=False)}
    for name, stop in stops.items():
        print(
            f"{name}: at rest after {stop.distance:.1f} m, {stop.off:.1f} m off its bend, articulation up to "
            f"{stop.articulation:.2f} rad, {len(stop.locked)} wheels lock"
        )
    if options.output:
        draw(stops, options.output)
    return 0


def draw(stops: dict[str, Stop], output: str) -> None:
    """Draw where the units were each second of the braking."""
    from matplotlib.figure import Figure  # noqa: PLC0415 - only where a picture is wanted

    figure = Figure(figsize=(9.0, 4.0), layout="constrained")
    axes = figure.add_subplot()
    for (name, stop), colour in zip(stops.items(), ("#0072b2", "#d55e00"), strict=True):
        axes.plot(*stop.path[:, 0].T, color=colour, linewidth=1.0, label=name)
        for instant in (*range(round(BRAKING / PERIOD), len(stop.path), 100), len(stop.path) - 1):
            for unit, (behind, ahead) in enumerate(((2.5, 2.5), (6.0, 7.0))):
                along = np.exp(1j * stop.yaw[instant, unit])
                ends = complex(*stop.path[instant, unit]) + along * np.array([-behind, ahead])
                axes.plot(ends.real, ends.imag, color=colour, linewidth=4.0, alpha=0.6)
    axes.set(xlabel="x, m", ylabel="y, m", title="Emergency braking in a bend, friction 0.3", aspect="equal")
    start = stops["with ABS"].path[round(BRAKING / PERIOD), 0]
    axes.set(xlim=(start[0] - 25.0, start[0] + 55.0))
    axes.grid(visible=True, color="0.9")
    axes.legend(loc="upper left")
    figure.savefig(output)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
