"""The runs behind the report's curves."""

from dataclasses import dataclass
from functools import cache

import numpy as np
import numpy.typing as npt

from yawdamp_ros import linear_model, load_vehicle, simulate
from yawdamp_ros.dynamics import split_outputs
from yawdamp_ros.manoeuvres import Chirp, Manoeuvre, Sine, Step
from yawdamp_ros.stepping import Response, TimeGrid, linear_response

MODELS = ("published", "consistent")
SINE = Sine(amplitude=0.1, frequency=1.5 / (2.0 * np.pi))

# A Simulink chirp passes its "frequency at target time" and rises on: 4 Hz after 1 s, 57.9 Hz after 15 s.
CHIRP = Chirp(frequency=0.15, final_frequency=0.15 + 3.85 * 15.0, sweep_time=15.0)


@dataclass(frozen=True)
class Case:
    """What the report ran for some of its figures."""

    vehicle: str
    manoeuvre: Manoeuvre
    duration: float
    speed: float
    overrides: tuple[str, ...] = ()
    sample_period: float = 0.01


CASES = {
    "single": Case("single_vehicle", Chirp(), 15.0, 20.0),
    "trailer_sine": Case("truck_trailer", Sine(amplitude=0.1, frequency=0.25), 8.0, 20.0),
    "trailer_step": Case("truck_trailer", Step(amplitude=1.0, start=1.0), 8.0, 20.0),
    "trailer_step_small": Case("truck_trailer", Step(amplitude=0.1, start=1.0), 8.0, 20.0),
    "sine": Case("interlink", SINE, 15.0, 22.2),
    "sine_hertz": Case("interlink", Sine(amplitude=0.1, frequency=1.5), 15.0, 22.2),
    "chirp": Case("interlink", CHIRP, 15.0, 22.2, sample_period=0.002),
    "equal": Case("interlink_equal_trailers", SINE, 15.0, 22.2),
    "swapped": Case("interlink_swapped", SINE, 15.0, 22.2),
    "quarter": Case("interlink_quarter_stiffness", SINE, 15.0, 22.2),
    "fast": Case("interlink", SINE, 15.0, 34.0),
    "soft_drive": Case(
        "interlink",
        SINE,
        15.0,
        22.2,
        tuple(f"units.0.axles.{axle}.cornering_stiffness=290000" for axle in (1, 2)),
    ),
}


@cache
def response(case: str, model: str) -> Response:
    """Response of a case by a model."""
    chosen = CASES[case]
    return simulate(
        load_vehicle(chosen.vehicle, chosen.overrides),
        chosen.manoeuvre,
        chosen.duration,
        sample_period=chosen.sample_period,
        speed=chosen.speed,
        model=model,
    )


def lateral_velocity(case: str) -> npt.NDArray[np.float64]:
    """Lateral velocity of each unit's centre of gravity in its own frame, in m/s, shape (m, n)."""
    # By the linear model, as a response holds none and its path follows the true geometry of the hitches.
    chosen = CASES[case]
    grid = TimeGrid.of(0.001, chosen.sample_period)
    model = linear_model(load_vehicle(chosen.vehicle), chosen.speed)
    steps = grid.samples_in(chosen.duration) * grid.steps_per_sample
    angles = np.array([chosen.manoeuvre(grid.seconds(step)) for step in range(steps + 1)])
    _, outputs = linear_response(model, angles, grid.step_size)
    return split_outputs(outputs[:: grid.steps_per_sample], len(model.vehicle.units)).lateral_velocity


def last_peaks(run: Response, period: float) -> npt.NDArray[np.float64]:
    """Time in s at which each unit's lateral acceleration is largest to the left in the last period."""
    last = run.time > run.time[-1] - period
    return np.asarray(run.time[last][np.argmax(run.lateral_acceleration[last], axis=0)])


def settled_amplitude(run: Response, period: float) -> npt.NDArray[np.float64]:
    """Largest lateral acceleration of each unit in the last period, in m/s^2."""
    last = run.time > run.time[-1] - period
    return np.asarray(np.abs(run.lateral_acceleration[last]).max(axis=0))
