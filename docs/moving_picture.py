"""Write docs/jackknife.gif, a truck and trailer that brakes in a turn: `make moving-picture`.

The nonlinear model drives both. Friction is 0.3, so that the brakes ask for more than the road gives: without
ABS the drive axle locks and the truck turns about its hitch.
"""

import io
import sys
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon
from PIL import Image

from yawdamp_ros import load_vehicle
from yawdamp_ros.simulation import make_motion
from yawdamp_ros.stepping import AppliedInput, Sample
from yawdamp_ros.vehicle import Unit, Vehicle, complete
from yawdamp_ros.vehicle.shape import extent

GIF = Path(__file__).parent / "jackknife.gif"
VEHICLE = "truck_trailer"
SPEED, FRICTION, DECELERATION = 15.0, 0.3, 3.5
STEERING = 0.02
"""Road-wheel angle in rad, reached after one second."""
BRAKES_AT, DURATION = 2.0, 7.0
FRAMES_PER_SECOND = 12
STEP = 0.001
COLOURS = ("#0072b2", "#e69f00")
SHADES = 48
"""Colours of the file; more would make it larger, not better."""
WITHOUT_ABS = [
    "units.0.axles.0.brake_share=0.1",
    "units.0.axles.1.brake_share=1.0",
    "units.1.axles.0.brake_share=0.1",
    "units.0.abs=false",
    "units.1.abs=false",
]
WITH_ABS = [*WITHOUT_ABS[:3], "units.0.abs=true", "units.1.abs=true"]


def drive(vehicle: Vehicle) -> list[Sample]:
    """Turn left, then brake; return a sample for every frame."""
    motion = make_motion(vehicle, "nonlinear", SPEED, STEP)
    motion.apply(AppliedInput(0, "friction", FRICTION))
    steps = round(1.0 / FRAMES_PER_SECOND / STEP)
    samples = [motion.sample()]
    for frame in range(round(DURATION * FRAMES_PER_SECOND)):
        if frame == round(BRAKES_AT * FRAMES_PER_SECOND):
            motion.apply(AppliedInput(motion.step, "acceleration", -DECELERATION))
        angle = STEERING * min(1.0, frame / FRAMES_PER_SECOND)
        samples.append(motion.run([angle] * steps))
    return samples


def picture(vehicle: Vehicle, rows: Mapping[str, Sample], time: float) -> Image.Image:
    """Draw one frame: the combination from above, a row for each drive."""
    figure = Figure(figsize=(8.0, 4.8), dpi=100)
    figure.subplots_adjust(left=0.01, right=0.99, top=0.94, bottom=0.02, hspace=0.14)
    for axes, (title, sample) in zip(figure.subplots(2, 1), rows.items(), strict=True):
        _draw(axes, complete(vehicle).units, sample)
        axes.set_title(title, fontsize=10, loc="left", pad=3)
    figure.axes[0].set_title(f"{time:.1f} s", fontsize=10, loc="right", pad=3)
    memory = io.BytesIO()
    figure.savefig(memory, format="png")
    return Image.open(memory).convert("RGB")


def _draw(axes: Axes, units: tuple[Unit, ...], sample: Sample) -> None:
    x, y = float(sample.x[0]) - 6.0, float(sample.y[0])
    axes.set(xlim=(x - 24.0, x + 24.0), ylim=(y - 7.5, y + 6.0), xticks=[], yticks=[], facecolor="#dde3e8")
    for dash in np.arange(8.0 * np.floor((x - 30.0) / 8.0), x + 30.0, 8.0):
        for lane in np.arange(-5.25, 30.0, 3.5):
            axes.plot([dash, dash + 3.0], [lane, lane], color="white", linewidth=2.0, zorder=0)
    for index, unit in enumerate(units):
        centre, heading = complex(sample.x[index], sample.y[index]), sample.heading[index]
        rear, front = extent(unit)
        rear, front = rear - (unit.rear_overhang or 0.0), front + (unit.front_overhang or 0.0)
        side = 0.5j * (unit.width or 0.0)
        body = centre + np.array([rear - side, front - side, front + side, rear + side]) * heading
        outline = np.column_stack([body.real, body.imag])
        axes.add_patch(Polygon(outline, facecolor=COLOURS[index], edgecolor="black", alpha=0.9))
        for axle in unit.axles:
            turned = np.exp(1j * sample.steering_angle) if axle.steered else 1.0
            for wheel in (-0.5j, 0.5j):
                place = axle.position + wheel * (axle.track_width or 0.0)
                tyre = centre + (place + np.array([-0.55, 0.55]) * turned) * heading
                axes.plot(tyre.real, tyre.imag, color="black", linewidth=3.0, solid_capstyle="butt")


def main() -> int:
    """Write the picture."""
    vehicles = {
        "without ABS: the drive axle locks": load_vehicle(VEHICLE, WITHOUT_ABS),
        "with ABS": load_vehicle(VEHICLE, WITH_ABS),
    }
    drives = zip(*map(drive, vehicles.values()), strict=True)
    shape = next(iter(vehicles.values()))
    frames = [
        picture(shape, dict(zip(vehicles, samples, strict=True)), number / FRAMES_PER_SECOND)
        for number, samples in enumerate(drives)
    ]
    palette = frames[0].quantize(SHADES)
    first, *others = [each.quantize(palette=palette, dither=Image.Dither.NONE) for each in frames]
    duration = 1000 // FRAMES_PER_SECOND
    first.save(GIF, save_all=True, append_images=others, duration=duration, loop=0, optimize=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
