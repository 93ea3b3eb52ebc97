"""Drives that tests make: a known vehicle, measured with noise and offsets."""

from collections.abc import Callable, Mapping

import numpy as np
from scipy.signal import butter, lfilter

from yawdamp_ros.drives import Channel, Drive, Inputs, inputs_of, predict
from yawdamp_ros.drives.parameters import Subject
from yawdamp_ros.vehicle import Vehicle, VehicleSource, vehicle_text

PERIOD = 0.01
NOISE = {"yaw_rate": 0.003, "lateral_acceleration": 0.1}
"""Standard deviation of a sensor's white noise; a coloured one of the same size comes on top."""
SENSOR_OFFSETS = {"yaw_rate": 0.004, "lateral_acceleration": 0.05}
TRUTH = {"stiffness": 0.85, "inertia": 1.2, "steering_offset": 0.01}


def source_of(name: str) -> VehicleSource:
    return VehicleSource(vehicle_text(name), ())


def made_drive(  # noqa: PLR0913 - each is one setting of a drive
    name: str,
    seed: int,
    duration: float = 120.0,
    *,
    truth: Mapping[str, float] = TRUTH,
    predictor: Callable[[Vehicle, Inputs], Mapping[str, np.ndarray]] = predict,
    steering: float = 0.02,
) -> Drive:
    """Drive of a vehicle other than its file says, steered at random below 0.4 Hz, in rad rms."""
    rng = np.random.default_rng(seed)
    subject = Subject(source_of(name), [each for each in truth if each != "steering_offset"])
    vehicle = subject.vehicle_with({each: truth[each] for each in truth if each != "steering_offset"})
    times = PERIOD * np.arange(round(duration / PERIOD) + 1)
    slow = lfilter(*butter(2, 0.8 * PERIOD), rng.normal(size=len(times) + 2000))[2000:]
    angles = steering * slow / slow.std()
    speed = 17.0 + 3.0 * np.sin(2.0 * np.pi * times / 80.0)
    inputs = {
        "steering": Channel("steering", "made", times, angles),
        "speed": Channel("speed", "made", times, speed),
    }
    outputs = predictor(vehicle, inputs_of(Drive("made", inputs), 17.0))
    channels = {
        "steering": Channel("steering", "made", times, angles + truth.get("steering_offset", 0.0)),
        "speed": Channel("speed", "made", times, speed + 0.02 * rng.normal(size=len(times))),
    }
    for unit in vehicle.unit_names:
        for quantity, size in NOISE.items():
            white = size * rng.normal(size=len(times))
            coloured = lfilter([size * np.sqrt(1.0 - 0.95**2)], [1.0, -0.95], rng.normal(size=len(times)))
            offset = SENSOR_OFFSETS[quantity] * rng.normal()
            output = f"{unit}/{quantity}"
            channels[output] = Channel(output, "made", times, outputs[output] + white + coloured + offset)
    return Drive("made", channels)
