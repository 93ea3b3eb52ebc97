"""Back a semitrailer into a bay that lies four metres to the side.

    python examples/docking.py --output docking.png

Backwards a trailer is unstable: it folds unless it is steered against. Three laws, one inside the other, do
it: the trailer heads for the bay's axis by its distance from it, the articulation brings the trailer to that
heading, and the steering brings the articulation about. The speed is an input, too: -1.5 m/s, slower towards
the end, and 0 there.
"""

import argparse
import math
import sys
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from yawdamp_ros import load_vehicle
from yawdamp_ros.simulation import SimParameters
from yawdamp_ros.simulation.plant import Plant
from yawdamp_ros.vehicle import supports

PERIOD = 0.02
"""Period of the controller [s]."""
SPEED = -1.5
"""In m/s."""
SLOWEST = -0.1
"""Towards the end [m/s]."""
PATIENCE = 120.0
"""Simulated time after which it has failed [s]."""
OFFSET = 4.0
"""From the bay's axis at the start [m]."""
DEPTH = -60.0
"""Place of the trailer's axles in the bay [m]; its axis is y = 0."""
HEADING_GAIN, ARTICULATION_GAIN, STEERING_GAIN = 0.06, 1.2, 0.5
"""Gains of the three laws, the outer first [rad/m, 1, 1/m]."""
LARGEST_STEERING = 0.6
"""In rad."""


class Docking(NamedTuple):
    """Outcome of a docking.

    Attributes
    ----------
    aside : float
        Of the trailer's axles from the bay's axis at rest [m].
    heading : float
        Of the trailer there [rad].
    depth : float
        Beyond the place for the axles [m].
    largest_articulation : float
        On the way [rad].
    path : ndarray, shape (k, 2, 3)
        Position of the units' centres of gravity and yaw [m, rad].
    """

    aside: float
    heading: float
    depth: float
    largest_articulation: float
    path: np.ndarray


def dock(speed: float = SPEED) -> Docking:
    """Back into the bay."""
    vehicle = load_vehicle("tractor_semitrailer")
    tractor, trailer = vehicle.units
    front, rear = supports(tractor)[:2]
    wheelbase = front - rear
    axles = supports(trailer).rear
    length = vehicle.hitches[0][1] - axles
    settings = SimParameters(
        model="nonlinear",
        initial_speed=0.0,
        initial_pose=[0.0, OFFSET, 0.0],
        longitudinal_source="speed",
        publish_rate=1.0 / PERIOD,
    )
    plant = Plant(settings, vehicle)
    path, still = [], 0
    while plant.time < PATIENCE and plant.run.stopped is None and still < 1.0 / PERIOD:
        now = plant.sample
        heading = float(now.yaw[1])
        x, y = float(now.x[1]) + axles * math.cos(heading), float(now.y[1]) + axles * math.sin(heading)
        articulation = float(now.articulation[0])
        wanted_heading = min(max(HEADING_GAIN * y, -0.4), 0.4)
        wanted = min(max(ARTICULATION_GAIN * (heading - wanted_heading), -0.5), 0.5)
        turn = wheelbase * (math.sin(articulation) / length + STEERING_GAIN * (articulation - wanted))
        angle = min(max(math.atan(turn), -LARGEST_STEERING), LARGEST_STEERING)
        left = x - DEPTH
        demand = min(max(speed, -0.3 * left), SLOWEST) if left > 0.0 else 0.0
        plant.step({"steering": angle, "speed": demand})
        path.append(np.column_stack([now.x, now.y, now.yaw]))
        still = still + 1 if demand == 0.0 else 0
    return Docking(
        y, heading, DEPTH - x, max(abs(float(unit[0, 2] - unit[1, 2])) for unit in path), np.array(path)
    )


def main(arguments: Sequence[str]) -> int:
    """Back into the bay, print where the trailer stands, draw the way."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--output", metavar="FILE", help="picture of the way from above")
    options = parser.parse_args(arguments)
    done = dock()
    print(
        f"at rest {100.0 * abs(done.aside):.1f} cm beside the bay's axis, "
        f"{math.degrees(abs(done.heading)):.2f} degrees to it, "
        f"{100.0 * done.depth:+.1f} cm beyond its place; articulation up to "
        f"{math.degrees(done.largest_articulation):.0f} degrees on the way"
    )
    if options.output:
        draw(done, options.output)
    return 0


def draw(done: Docking, output: str) -> None:
    """Draw tractor and trailer every eight seconds."""
    from matplotlib.figure import Figure  # noqa: PLC0415 - only where a picture is wanted

    figure = Figure(figsize=(9.0, 3.2), layout="constrained")
    axes = figure.add_subplot()
    for y in (-1.6, 1.6):
        axes.plot([DEPTH - 4.0, DEPTH + 12.0], [y, y], color="0.3", linewidth=2.0)
    for instant in (*range(0, len(done.path), round(8.0 / PERIOD)), len(done.path) - 1):
        for unit, (behind, ahead, colour) in enumerate(((3.0, 3.5, "#d55e00"), (6.5, 7.0, "#0072b2"))):
            x, y, yaw = done.path[instant, unit]
            corners = np.array([-behind - 1.25j, ahead - 1.25j, ahead + 1.25j, -behind + 1.25j])
            box = complex(x, y) + np.exp(1j * yaw) * corners
            axes.fill(box.real, box.imag, color=colour, alpha=0.3)
    axes.plot(*done.path[:, 1, :2].T, color="#0072b2", linewidth=1.0, label="trailer's centre of gravity")
    axes.set(xlabel="x, m", ylabel="y, m", title="Backing a semitrailer into a bay", aspect="equal")
    axes.grid(visible=True, color="0.9")
    axes.legend(loc="lower right")
    figure.savefig(output)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
