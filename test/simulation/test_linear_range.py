import math

from yawdamp_ros import load_vehicle
from yawdamp_ros.manoeuvres import LaneChange
from yawdamp_ros.simulation import Limits, LinearRange, Run, SimParameters, Stop
from yawdamp_ros.simulation.commands import Commands
from yawdamp_ros.simulation.models import make_motion
from yawdamp_ros.stepping import TimeGrid


def driven(amplitude: float, told: list[Stop]) -> LinearRange:
    """A lane change of the interlink with a step of 10 ms, watched."""
    settings = SimParameters(manoeuvre="sine", amplitude=amplitude, frequency=LaneChange().frequency)
    grid = TimeGrid.of(0.01, 0.01)
    motion = make_motion(load_vehicle("interlink"), "consistent", None, grid.step_size)
    watched = LinearRange(motion.vehicle.unit_names, Limits.warning(settings), told.append)
    run = Run(motion, grid, Commands(settings, grid, motion), [watched], Limits.of(settings))
    run.start()
    run.advance(800)
    assert run.stopped is None
    assert run.samples == 801
    return watched


def test_a_gentle_run_stays_within() -> None:
    told: list[Stop] = []
    watched = driven(0.02, told)
    assert (watched.first, watched.sentence, watched.look(), told) == (None, "", None, [])


def test_a_hard_run_goes_on_and_is_told_of_once_with_its_first_instant() -> None:
    told: list[Stop] = []
    watched = driven(0.1, told)
    assert told == [watched.first]
    assert watched.first is not None
    assert (watched.first.key, watched.first.where) == ("lateral_acceleration", "truck")
    assert "lateral acceleration of truck 4.0" in watched.sentence
    assert "past 4, where tyres saturate" in watched.sentence
    assert watched.look() is not None
    assert watched.look() is None


def test_the_nonlinear_model_has_no_linear_range() -> None:
    assert Limits.warning(SimParameters(model="nonlinear")) == (math.inf, math.inf)
    assert Limits.warning(SimParameters()) == (4.0, 0.2)
