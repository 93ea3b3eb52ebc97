"""One run, whoever drives it."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given
from hypothesis import strategies as st

from yawdamp_ros import load_vehicle
from yawdamp_ros.dynamics import LinearModel
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.pictures.run_panels import run_panels
from yawdamp_ros.runs import outputs, read_response_csv, read_response_recording
from yawdamp_ros.runs.encoder import Encoder
from yawdamp_ros.runs.outputs import FLOAT64, Of, Output
from yawdamp_ros.runs.recipe import Recipe, RunFile
from yawdamp_ros.runs.resimulation import Resimulation
from yawdamp_ros.runs.response_csv import ResponseCsv
from yawdamp_ros.simulation import Commands, Limits, Run, SimParameters, make_motion, models
from yawdamp_ros.stepping import AppliedInput, Event, Motion, Response, Sample, TimeGrid
from yawdamp_ros.vehicle import Vehicle, VehicleSource, vehicle_text

GRID = TimeGrid.of(0.001, 0.01)
SOFT = ["units.0.axles.1.cornering_stiffness=50000", "units.0.axles.2.cornering_stiffness=50000"]


class Kept:
    """A sink that keeps what it is given."""

    def __init__(self) -> None:
        self.samples: list[Sample] = []
        self.closed = False

    def write(self, sample: Sample) -> None:
        self.samples.append(sample)

    def close(self) -> None:
        self.closed = True

    def all(self, field: str) -> npt.NDArray[np.float64]:
        return np.concatenate([np.atleast_1d(getattr(sample, field)) for sample in self.samples])


def run_of(
    settings: SimParameters, overrides: Sequence[str] = (), log: tuple[list[float], list[float]] | None = None
) -> tuple[Run, Commands, Kept]:
    motion = make_motion(load_vehicle(settings.vehicle, overrides), settings.model, None, GRID.step_size)
    commands, kept = Commands(settings, GRID, motion, log), Kept()
    return Run(motion, GRID, commands, [kept], Limits.of(settings)), commands, kept


@given(cuts=st.lists(st.integers(1, 40), min_size=1, max_size=8), limit=st.sampled_from([100.0, 3.0]))
def test_how_samples_are_handed_on_changes_no_bit_and_no_end(cuts: list[int], limit: float) -> None:
    settings = SimParameters(
        manoeuvre="lane_change",
        start=0.0,
        steering_time_constant=0.1,
        steering_rate_limit=0.2,
        max_lateral_acceleration=limit,
    )
    (each, _, one), (batch, _, many) = run_of(settings), run_of(settings)
    for run, samples in ((each, [1] * sum(cuts)), (batch, cuts)):
        run.start()
        for count in samples:
            if run.stopped is None:
                run.advance(count)
    assert each.samples == batch.samples == len(one.all("step"))
    for field in ("step", "steering_angle"):
        np.testing.assert_array_equal(one.all(field), many.all(field))
    apart = np.array([sample.lateral_acceleration for sample in one.samples])
    together = np.vstack([sample.lateral_acceleration for sample in many.samples])
    np.testing.assert_array_equal(apart, together)
    assert each.stopped == batch.stopped
    inputs = [[entry for sample in kept.samples for entry in sample.inputs] for kept in (one, many)]
    assert inputs[0] == inputs[1]


def test_a_run_is_stopped_at_the_first_sample_past_a_limit_however_fast_it_grows() -> None:
    settings = SimParameters(manoeuvre="pulse", start=0.0)
    run, _, kept = run_of(settings, SOFT)
    run.start()
    while run.stopped is None:
        run.advance(1000)
    assert run.stopped.key in {"lateral_acceleration", "articulation"}
    assert "where the model means nothing" in run.stopped.reason
    assert run.stopped.step == kept.samples[-1].step[-1] + 10
    assert run.time == GRID.seconds(run.stopped.step)
    before = run.samples
    run.advance(10)
    assert run.samples == before


def test_a_log_is_clamped_divided_and_timed_out_as_commands_on_a_topic_are() -> None:
    settings = SimParameters(
        steering_ratio=16.0, max_steering_angle=0.05, steering_timeout=0.02, on_steering_timeout="zero"
    )
    times, angles = [0.0, 0.02, 0.1], [0.32, 1.6, -0.16]
    run, _, kept = run_of(settings, log=(times, angles))
    run.start()
    run.advance(15)
    applied = [(entry.step, entry.value) for sample in kept.samples for entry in sample.inputs]
    assert applied[1:] == [(0, 0.02), (20, 0.05), (40, 0.0), (100, -0.01), (120, 0.0)]
    received = [(entry.step, entry.angle) for sample in kept.samples for entry in sample.commands]
    assert received == [(0, 0.32), (20, 1.6), (100, -0.16)]
    live, by_topic, _ = run_of(settings)
    live.start()
    angles_live = []
    for step in range(1, 151):
        for time, angle in zip(times, angles, strict=True):
            if round(time * 1000) == step:
                by_topic.steering_input.offer(angle, step - 1)
        angles_live.append(by_topic.steering(range(step, step + 1))[0])
    again, by_log, _ = run_of(settings, log=(times[1:], angles[1:]))
    again.start()
    assert list(by_log.steering(range(1, 151))) == angles_live


def test_reset_and_speed_act_together_at_the_first_step_of_the_next_sample() -> None:
    run, commands, kept = run_of(SimParameters(manoeuvre="step", start=0.0))
    run.start()
    run.advance(50)
    commands.reset()
    commands.held["speed"].offer(15.0, 0)
    run.advance()
    assert [(entry.name, entry.step) for entry in kept.samples[-1].inputs] == [("reset", 501), ("speed", 501)]
    assert abs(float(kept.samples[-1].x[0])) < 0.2
    run.close()
    assert kept.closed


# A new output: one entry in one table.

SIDESLIP = Output(
    "sideslip",
    Of.UNIT,
    "side-slip angle",
    "rad",
    FLOAT64,
    {"data": "sideslip"},
    value=lambda sample: sample.lateral_velocity / sample.velocity.real,
)


def recorded(
    directory: Path, settings: SimParameters, motion: Motion, kind: type[Commands] = Commands
) -> tuple[Response, Response]:
    """A run of two seconds, by its CSV file and by its recording."""
    commands, csv = kind(settings, GRID, motion), directory / "run.csv"
    encoder = Encoder(motion, settings, GRID, start_time=0)
    source = VehicleSource(vehicle_text(settings.vehicle), ())
    recipe = Recipe(
        motion, GRID, settings, source, stamps=encoder.stamps, types=encoder.types, frames=encoder.frames
    )
    (directory / "run").mkdir()
    encoder.sinks.append(RunFile(recipe.open(directory / "run", settings)))
    run = Run(motion, GRID, commands, [encoder, ResponseCsv(csv, motion, GRID)])
    run.start()
    run.advance(200)
    run.close()
    return read_response_csv(csv), read_response_recording(directory / "run")


def test_one_entry_makes_a_topic_a_channel_a_column_and_a_curve(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(outputs, "OUTPUTS", (*outputs.OUTPUTS, SIDESLIP))
    settings = SimParameters(vehicle="truck_trailer", manoeuvre="lane_change", start=0.0)
    motion = make_motion(load_vehicle(settings.vehicle), settings.model, None, GRID.step_size)
    assert Encoder(motion, settings, GRID, start_time=0).types["trailer/sideslip"] == FLOAT64
    by_csv, by_recording = recorded(tmp_path, settings, motion)
    assert np.abs(by_csv.extra["sideslip"]).max() > 0.001
    np.testing.assert_array_equal(by_csv.extra["sideslip"], by_recording.extra["sideslip"])
    labels = [panel.y_label for panel in run_panels([("run", by_csv)])]
    assert "side-slip angle, rad" in labels
    again = Resimulation(tmp_path / "run")
    assert len(list(again.compare())) == 201
    assert again.bit_identical


def test_a_run_recorded_before_an_output_came_is_run_again_without_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    settings = SimParameters(vehicle="truck_trailer", manoeuvre="lane_change", start=0.0)
    motion = make_motion(load_vehicle(settings.vehicle), settings.model, None, GRID.step_size)
    recorded(tmp_path, settings, motion)
    monkeypatch.setattr(outputs, "OUTPUTS", (*outputs.OUTPUTS, SIDESLIP))
    again = Resimulation(tmp_path / "run")
    assert len(list(again.compare())) == 201
    assert (again.bit_identical, again.difference) == (True, None)


# A new model: one class, one entry in the registry.


class Leaning:
    """The linear motion, with a quantity, an input and an event of its own."""

    def __init__(self, vehicle: Vehicle, speed: float | None, step_size: float) -> None:
        self._inner = make_motion(vehicle, "consistent", speed, step_size)
        self.vehicle = vehicle
        self.input_names = (*self._inner.input_names, "truck/gust")
        self.state_names = (*self._inner.state_names, "gust")
        self.quantity_names = ("lean",)
        self._gust = 0.0
        self._noted: list[AppliedInput] = []

    @property
    def step(self) -> int:
        return self._inner.step

    @property
    def speed(self) -> float:
        return self._inner.speed

    @property
    def steering_angle(self) -> float:
        return self._inner.steering_angle

    def apply(self, applied: AppliedInput) -> None:
        if applied.name == "truck/gust":
            self._gust = applied.value
            self._noted.append(applied)
        else:
            self._inner.apply(applied)

    def advance(self, steps: int = 1) -> None:
        self._inner.advance(steps)

    def run(self, angles: Sequence[float] | FloatArray, steps_per_sample: int | None = None) -> Sample:
        return self._leaning(self._inner.run(angles, steps_per_sample))

    def sample(self) -> Sample:
        return self._leaning(self._inner.sample())

    def snapshot(self) -> Mapping[str, Any]:
        return {**self._inner.snapshot(), "gust": self._gust}

    def restore(self, snapshot: Mapping[str, Any]) -> None:
        self._inner.restore(snapshot)
        self._gust = snapshot["gust"]

    def linearise(self) -> LinearModel:
        return self._inner.linearise()

    def _leaning(self, sample: Sample) -> Sample:
        lean = 0.02 * sample.lateral_acceleration + self._gust
        over = np.abs(lean).max() > 0.05
        events = (Event(int(np.max(sample.step)), "rollover", "truck", final=True),) if over else ()
        noted, self._noted = tuple(self._noted), []
        return sample._replace(extra={"lean": lean}, events=events, inputs=sample.inputs + noted)


LEAN = outputs.scalar("lean", Of.UNIT, "lean", "rad")


class Gusts(Commands):
    """Commands with a gust at a step."""

    def inputs(self, steps: range) -> Sequence[AppliedInput]:
        gusts = [AppliedInput(605, "truck/gust", 0.01)] if 605 in steps else []
        return [*super().inputs(steps), *gusts]


def test_a_model_with_quantities_inputs_and_events_of_its_own_is_one_entry(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(models, "MODELS", {**models.MODELS, "leaning": Leaning})
    monkeypatch.setattr(outputs, "OUTPUTS", (*outputs.OUTPUTS, LEAN))
    settings = SimParameters(
        vehicle="truck_trailer", model="leaning", manoeuvre="step", amplitude=0.01, start=0.0
    )
    motion = make_motion(load_vehicle(settings.vehicle), "leaning", None, GRID.step_size)
    by_csv, by_recording = recorded(tmp_path, settings, motion, Gusts)
    assert by_csv.extra["lean"].shape == (len(by_csv.time), 2)
    np.testing.assert_array_equal(by_csv.extra["lean"], by_recording.extra["lean"])
    again = Resimulation(tmp_path / "run")
    assert len(list(again.compare())) == len(by_csv.time)
    assert again.bit_identical
    linear = make_motion(load_vehicle(settings.vehicle), "consistent", None, GRID.step_size)
    assert "truck/lean" not in Encoder(linear, settings, GRID, start_time=0).types


def test_a_final_event_stops_a_run() -> None:
    settings = SimParameters(vehicle="truck_trailer", manoeuvre="step", start=0.0)
    motion = Leaning(load_vehicle(settings.vehicle), None, GRID.step_size)
    run = Run(motion, GRID, Commands(settings, GRID, motion), [Kept()])
    run.start()
    while run.stopped is None:
        run.advance()
    assert (run.stopped.key, run.stopped.where) == ("rollover", "truck")
