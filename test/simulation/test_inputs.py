"""Inputs besides steering: each acts, is judged, and repeats bit for bit."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from runs import recorded
from yawdamp_ros.cli.simulate import main
from yawdamp_ros.runs.recipe import applied_topic
from yawdamp_ros.runs.resimulation import Resimulation
from yawdamp_ros.runs.response_recording import read_response_recording
from yawdamp_ros.simulation import Commands, Run, SimParameters, SimulationError, make_motion
from yawdamp_ros.simulation.friction_route import FrictionRoute
from yawdamp_ros.simulation.inputs import INPUTS, held_inputs
from yawdamp_ros.simulation.plant import Plant
from yawdamp_ros.simulation.steering_messages import LongitudinalDemand
from yawdamp_ros.stepping import Sample, TimeGrid, Verdict
from yawdamp_ros.vehicle import load_vehicle

GRID = TimeGrid.of(0.001, 0.01)
COMMANDED = ("units.2.axles.0.steered=commanded", "units.2.axles.1.steered=commanded")
VEHICLE = load_vehicle("interlink", overrides=COMMANDED)


class Last:
    """Keeps the newest sample."""

    sample: Sample

    def write(self, sample: Sample) -> None:
        self.sample = sample

    def close(self) -> None:
        """Nothing is open."""


def driven(source: str = "acceleration", speed: float = 15.0) -> tuple[Commands, Run, Last]:
    settings = SimParameters(model="nonlinear", longitudinal_source=source)
    motion = make_motion(VEHICLE, "nonlinear", speed, GRID.step_size)
    commands, last = Commands(settings, GRID, motion), Last()
    run = Run(motion, GRID, commands, [last])
    run.start()
    return commands, run, last


def test_every_entry_of_the_table_is_an_input_of_the_nonlinear_model() -> None:
    taken = set(held_inputs(make_motion(VEHICLE, "nonlinear", None, GRID.step_size)))
    names = {each.topic.replace("<unit>", "trailer_2") for each in INPUTS}
    assert names <= taken
    assert "trailer_1/steering" not in taken  # it has no axle that is commanded


@pytest.mark.parametrize(
    "name, value, sign",
    [
        ("trailer_2/yaw_moment", 4e4, 1.0),
        ("trailer_2/yaw_moment", -4e4, -1.0),
        ("trailer_2/steering", -0.02, 1.0),
    ],
)
def test_a_trailer_turns_by_its_own_actuators(name: str, value: float, sign: float) -> None:
    commands, run, last = driven()
    assert commands.demand(name, value) is Verdict.ACCEPTED
    run.advance(30)
    assert sign * last.sample.yaw_rate[2] > 0.004  # rad/s
    assert np.abs(last.sample.yaw_rate[0]) < 0.003


def test_a_unit_s_brake_slows_all_and_friction_limits_it() -> None:
    reached = []
    for friction in (0.8, 0.05):
        commands, run, last = driven()
        commands.demand("friction", friction)
        commands.demand("acceleration", 0.0)
        commands.demand("trailer_2/brake", 3.0)
        run.advance(100)
        reached.append(float(last.sample.velocity.real[0]))
    share = VEHICLE.units[2].mass / sum(unit.mass for unit in VEHICLE.units)
    assert reached[0] == pytest.approx(15.0 - 3.0 * share - 0.1, abs=0.08)  # air and rolling take the rest
    assert reached[1] > reached[0] + 0.5


def test_of_two_demands_that_one_counts_which_the_source_names() -> None:
    commands, run, _ = driven("acceleration")
    assert commands.demand("speed", 3.0) is Verdict.NOT_SOURCE
    assert commands.demand("acceleration", -20.0) is Verdict.CLAMPED
    assert commands.demand("friction", float("nan")) is Verdict.NOT_FINITE
    run.advance(1)
    assert commands.held["speed"].counts[Verdict.NOT_SOURCE] == 1
    assert run.motion.speed < 15.0


def test_a_linear_model_names_what_it_does_not_take() -> None:
    motion = make_motion(VEHICLE, "consistent", None, GRID.step_size)
    with pytest.raises(SimulationError, match="trailer_1/brake: model consistent does not take it"):
        Commands(SimParameters(), GRID, motion, None, {"trailer_1/brake": ([0.0], [1.0])})


@pytest.mark.parametrize("folding", [0.0, 0.02])
def test_a_log_stops_a_rig_lets_it_stand_and_backs_it(
    tmp_path: Path, folding: float, capsys: pytest.CaptureFixture[str]
) -> None:
    """80 km/h to rest at 3 m/s^2, a minute at rest, 20 m backwards in reverse gear, repeated bit for bit."""
    log = tmp_path / "drive.csv"
    rows = [
        (0.0, 0.0, -3.0, 1.0, 0.8),
        (40.0, 0.0, -3.0, 1.0, 0.6),
        (70.0, folding, 0.5, -1.0, 0.8),
        (76.0, folding, 0.05, -1.0, 0.8),
        (83.0, folding, -3.0, -1.0, 0.8),
        (85.0, folding, -3.0, -1.0, 0.8),
    ]
    lines = [",".join(map(str, row)) for row in rows]
    log.write_text("time,steering_angle,acceleration,gear,friction\n" + "\n".join(lines) + "\n")
    output = tmp_path / "run"
    options = "--sample-period 0.1 --model nonlinear --longitudinal-source acceleration"
    assert main(["--log", str(log), *options.split(), "--output", str(output)]) == 0
    assert "not followed" not in capsys.readouterr().err
    drive = read_response_recording(output)
    speed = np.hypot(np.gradient(drive.x[:, 0], drive.time), np.gradient(drive.y[:, 0], drive.time))
    stopped = drive.time[np.argmax(speed < 0.5)]
    assert stopped == pytest.approx(21.7222 / 3.0, abs=0.2)
    at_rest = (drive.time > stopped + 2.5) & (drive.time < 69.9)
    assert drive.time[at_rest][-1] - drive.time[at_rest][0] > 60.0
    assert np.ptp(drive.x[at_rest], axis=0).max() < 1e-3
    assert np.ptp(drive.y[at_rest], axis=0).max() < 1e-3
    backed = drive.x[at_rest][-1, 0] - drive.x[-1, 0]
    assert backed > 20.0
    folded = np.abs(drive.articulation[-1]).max()
    assert folded > 0.3 if folding else folded < 1e-9
    again = Resimulation(output)
    list(again.compare())
    assert again.bit_identical
    assert again.agrees


def test_a_run_with_every_input_repeats_bit_for_bit(tmp_path: Path) -> None:
    motion = make_motion(VEHICLE, "nonlinear", None, GRID.step_size)
    names = ["steering_angle", *(name for name in held_inputs(motion) if name != "speed")]
    limits = {"gear": 1.0, "friction": 0.8, "brake": 1.5, "yaw_moment": 2e4, "steering": 0.02}
    most = np.array([limits.get(name.rpartition("/")[2], 0.02) for name in names])
    drawn = most * np.random.default_rng(4).uniform(0.1, 1.0, (60, len(names)))
    drawn[:, names.index("gear")] = np.where(np.arange(60) < 50, 1.0, 0.0)
    rows = [",".join(map(str, [0.05 * row, *values])) for row, values in enumerate(drawn.tolist())]
    (tmp_path / "log.csv").write_text("\n".join([",".join(["time", *names]), *rows]))
    output = tmp_path / "run"
    options = ["--column", "steering_angle", "--model", "nonlinear", "--output", str(output)]
    options += ["--longitudinal-source", "acceleration", "--channel", "trailer_2/steering=trailer_2/steering"]
    changes = [word for change in COMMANDED for word in ("--set", change)]
    assert main(["--log", str(tmp_path / "log.csv"), *options, *changes]) == 0
    assert {
        f"/{applied_topic(name)}" for name in motion.input_names if name not in {"speed", "reset"}
    } <= set(recorded(output))
    again = Resimulation(output)
    list(again.compare())
    assert (again.bit_identical, again.agrees) == (True, True)


def test_a_speed_that_a_topic_left_is_no_speed_that_is_set() -> None:
    settings = SimParameters(speed=20.0, longitudinal_source="speed")
    motion = make_motion(load_vehicle("truck_trailer"), "consistent", 20.0, 0.001)
    commands = Commands(settings, TimeGrid.of(0.001, 0.01), motion)
    run = Run(motion, TimeGrid.of(0.001, 0.01), commands, [])
    run.start()
    commands.demand("speed", 15.0)
    run.advance(2)
    assert motion.speed == 15.0
    commands.change(replace(settings, speed=15.0))  # the node tells the speed in force
    commands.change(replace(settings, speed=15.0, longitudinal_source="parameter"))
    commands.change(replace(settings, speed=20.0, longitudinal_source="parameter"))
    run.advance(2)
    assert motion.speed == 20.0


def test_a_rollover_is_recorded_whatever_else_acts(tmp_path: Path) -> None:
    rows = [f"{0.1 * row},{0.12 if row > 10 else 0.0},0.8" for row in range(60)]
    (tmp_path / "log.csv").write_text("\n".join(["time,steering_angle,friction", *rows]))
    recorded = tmp_path / "run"
    options = ["--vehicle", "a_double", "--model", "nonlinear", "--log", str(tmp_path / "log.csv")]
    assert main([*options, "--output", str(recorded)]) == 1
    assert read_response_recording(recorded).events[-1].name == "rollover"


def test_a_speed_of_the_steering_is_approached_at_its_rate_and_silence_is_told() -> None:
    commands, run, last = driven("steering")
    assert commands.demand("speed", 3.0) is Verdict.NOT_SOURCE
    assert commands.follow(LongitudinalDemand(10.0, rate=2.0)) == ("speed", 10.0, Verdict.ACCEPTED)
    commands.demand("friction", 0.5)
    for period in range(50):
        run.advance()
        (applied,) = [each.value for each in last.sample.inputs if each.name == "speed"]
        assert applied == pytest.approx(15.0 - 0.02 * (period + 1))
    assert commands.silent == []
    for _ in range(750):
        run.advance()
    assert run.motion.speed == pytest.approx(10.0, abs=0.1)
    assert commands.silent == ["speed"]  # a friction is said once
    assert commands.follow(LongitudinalDemand(10.0, acceleration=-1.0))[0] == "acceleration"
    assert commands.follow(LongitudinalDemand(float("nan")))[2] is Verdict.NOT_FINITE
    run.advance(100)
    assert run.motion.speed == pytest.approx(9.0, abs=0.2)
    assert commands.silent == ["acceleration"]


def test_friction_follows_the_distance_and_the_run_and_its_start_are_repeated(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    route, output = tmp_path / "ice.csv", tmp_path / "run"
    route.write_text("distance,friction\n15,0.05\n30,0.8\n")
    options = ["--model", "nonlinear", "--manoeuvre", "step", "--amplitude", "0.02", "--start", "0.2"]
    options += ["--friction-file", str(route), "--duration", "3", "--output", str(output)]
    options += ["--initial-speed", "12", "--speed", "14"]
    start = ["--initial-pose", "10", "-5", "1.5", "--initial-articulation", "0.1", "0.05"]
    assert main([*options, *start]) == 0
    drive = read_response_recording(output)
    assert (drive.x[0, 0], drive.y[0, 0], drive.yaw[0, 0]) == (10.0, -5.0, pytest.approx(1.5))
    assert drive.articulation[0].tolist() == [0.1, 0.05]
    way = np.cumsum(np.hypot(np.diff(drive.x[:, 0]), np.diff(drive.y[:, 0])))
    applied = recorded(output)["/friction"]
    assert [message.data for _, message in applied] == [0.05, 0.8]
    for (_, distance), (stamp, _) in zip([(0, 15.0), (0, 30.0)], applied, strict=True):
        assert way[np.searchsorted(drive.time, stamp / 1e9) - 1] == pytest.approx(distance, abs=0.4)
    again = Resimulation(output)
    list(again.compare())
    assert (again.bit_identical, again.agrees) == (True, True)
    capsys.readouterr()


@pytest.mark.parametrize(
    "text, told",
    [
        ("distance,mu\n0,0.5\n", "line 1: columns distance, mu: expected distance and friction"),
        ("distance,friction\n0,0.5\n5,slick\n", "line 3: friction: 'slick': expected a finite number"),
        ("distance,friction\n0,0.5\n5,3\n", "line 3: friction: 3: expected a number from 0.01 to 2"),
        ("friction,distance\n0.5,4\n0.6,4\n", "line 3: distance: 4: expected more than 4"),
        ("distance,friction\n0\n", "line 2: 1 values: expected 2"),
        ("distance,friction\n", "no rows below the column names"),
    ],
)
def test_a_friction_file_s_mistake_is_told_with_line_and_value(tmp_path: Path, text: str, told: str) -> None:
    (tmp_path / "ice.csv").write_text(text)
    with pytest.raises(SimulationError, match=f"friction_file: .*ice.csv: {told}"):
        FrictionRoute.read(tmp_path / "ice.csv")


def test_a_manoeuvre_leaves_no_steering_to_command() -> None:
    plant = Plant(SimParameters(manoeuvre="step"))
    with pytest.raises(SimulationError, match="steering: a run with a manoeuvre does not take it"):
        plant.step({"steering": 0.5})


def test_dead_times_and_lags_delay_what_is_demanded() -> None:
    settings = SimParameters(
        model="nonlinear",
        longitudinal_source="acceleration",
        steering_dead_time=0.24,
        acceleration_dead_time=0.1,
        acceleration_time_constant=0.2,
    )
    motion = make_motion(VEHICLE, "nonlinear", 15.0, GRID.step_size)
    commands, last = Commands(settings, GRID, motion), Last()
    run = Run(motion, GRID, commands, [last])
    run.start()
    commands.steer(0.01)
    commands.demand("acceleration", -2.0)
    angles, demands = [], {}
    for _ in range(60):
        run.advance()
        angles.append(float(last.sample.steering_angle))
        demands |= {each.step: each.value for each in last.sample.inputs if each.name == "acceleration"}
    # Step 241 is the first that lies 0.24 s after the step from which on the command acts.
    assert (angles[23], angles[24]) == (0.0, 0.01)
    for step, value in demands.items():
        late = max(0.001 * (step - 1) - 0.1, 0.0)  # the demand acts from step 1 on
        assert value == pytest.approx(-2.0 * (1.0 - np.exp(-late / 0.2)), abs=1e-9)
    assert min(demands.values()) < -1.8
