"""Make docs/recorded_drive.csv: a drive of the running node, measured with noise and offsets.

``python docs/make_recorded_drive.py`` takes two minutes, for the node runs in real time. What is steered and
how the speed varies is the same each time; when a command arrives is not.
"""

import csv
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from yawdamp_ros.logs.drive_formats import load_drive

OUTPUT = Path(__file__).with_name("recorded_drive.csv")
DURATION, PERIOD = 100.0, 0.04
RATIO = 18.0
"""Hand-wheel over road-wheel angle."""
TRUTH = (
    "units.0.axles.0.cornering_stiffness=324630",
    "units.0.axles.1.cornering_stiffness=623360",
    "units.1.axles.0.cornering_stiffness=749200",
)
"""0.85 times what the vehicle's file says."""
HAND_WHEEL_OFFSET = 4.0
"""In deg: what the sensor of the hand wheel shows when the wheels are straight."""
GYRO_OFFSET, ACCELERATION_OFFSET = 0.4, 0.08
"""Standard deviations of the truck's sensors [deg/s, m/s^2]."""


def hand_wheel(time: float) -> float:
    """Angle in deg: lane changes of several lengths, and a little sway."""
    lane = sum(
        np.sin(2.0 * np.pi * (time - start) / length) * (start <= time < start + length) * size
        for start, length, size in (
            (8, 6, 25),
            (20, 4, 20),
            (31, 3, 18),
            (45, 8, 30),
            (60, 2.5, 15),
            (75, 5, 24),
        )
    )
    return float(lane + 2.0 * np.sin(0.9 * time) + 1.2 * np.sin(3.1 * time))


def main() -> None:
    """Run node and replay, and write what was measured."""
    with tempfile.TemporaryDirectory() as directory:
        place = Path(directory)
        times = PERIOD * np.arange(round(DURATION / PERIOD) + 1)
        with (place / "asked.csv").open("w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(["time", "steering_wheel_deg", "speed"])
            writer.writerows([at, hand_wheel(at), 17.0 + 3.5 * np.sin(0.11 * at)] for at in times)
        drive(place)
        write(place / "run")


def drive(place: Path) -> None:
    """Let the node be driven."""
    command = [sys.executable, "-m", "yawdamp_ros"]
    changes = [word for change in TRUTH for word in ("--set", change)]
    settings = {
        "longitudinal_source": "speed",
        "record_directory": "run",
        "yaw_rate_stddev": 0.004,
        "lateral_acceleration_stddev": 0.12,
        "noise_seed": 1,
    }
    arguments = [word for name, value in settings.items() for word in ("-p", f"{name}:={value}")]
    node = subprocess.Popen(  # noqa: S603 - the project's own command
        [*command, "sim", "--vehicle", "truck_trailer", *changes, "--ros-args", *arguments], cwd=place
    )
    asked = ["replay", "asked.csv", "--steering-ratio", str(RATIO)]
    subprocess.run([*command, *asked], cwd=place, check=True)  # noqa: S603
    node.send_signal(signal.SIGINT)
    node.wait()


def write(run: Path) -> None:
    """Write what sensors would have recorded of a run, from the first command on."""
    made = load_drive(run)
    # Every fourth sample of the node, all of whose messages of one instant bear one stamp.
    kept = np.flatnonzero((made["truck/yaw_rate"].times >= 0.0) & (made["truck/yaw_rate"].times < DURATION))[
        ::4
    ]
    times = made["truck/yaw_rate"].times[kept]
    wheel = np.degrees(RATIO * made["steering"].held(times)) + HAND_WHEEL_OFFSET
    columns = {
        "time_s": (times, 4),
        "steering_wheel_angle_deg": (np.round(wheel / 0.1) * 0.1, 1),
        "speed_kmh": (3.6 * made["speed"].held(times), 2),
        "yaw_rate_deg_s": (np.degrees(made["truck/yaw_rate"].values[kept]) + GYRO_OFFSET, 3),
        "lateral_acceleration": (made["truck/lateral_acceleration"].values[kept] + ACCELERATION_OFFSET, 3),
        "trailer/yaw_rate_deg_s": (np.degrees(made["trailer/yaw_rate"].values[kept]), 3),
    }
    with OUTPUT.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        rounded = [[f"{value:.{digits}f}" for value in values] for values, digits in columns.values()]
        writer.writerows(zip(*rounded, strict=True))


if __name__ == "__main__":
    main()
