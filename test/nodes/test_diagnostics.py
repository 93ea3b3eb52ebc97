from typing import Any

from diagnostic_msgs.msg import DiagnosticStatus

from graph import values
from yawdamp_ros.nodes.diagnostics import Diagnosis, InputReading, Readings
from yawdamp_ros.nodes.neighbours import Finding, Neighbourhood
from yawdamp_ros.nodes.states import Problem, RecorderState
from yawdamp_ros.stepping import Verdict

ALONE = Neighbourhood(0, ())
IN_ORDER = Readings(
    samples=100,
    rate_wanted=100.0,
    worst_lateness=0.0015,
    steps_dropped=0,
    simulated_time=1.0,
    paused=False,
    steering_age=0.01,
    steering_timed_out=False,
    manoeuvre="",
    commands={Verdict.ACCEPTED: 5, Verdict.CLAMPED: 0, Verdict.STALE: 0},
    inputs={"speed": InputReading(22.5, None, {Verdict.ACCEPTED: 0, Verdict.BACKWARDS: 0})},
    neighbourhood=ALONE,
    recorder=RecorderState.RECORDING,
    recorder_detail="runs/a",
    messages_lost=0,
    least_damping_ratio=0.4,
    beyond="",
    speed=22.5,
)


def looks(*readings: Readings) -> dict[str, DiagnosticStatus]:
    """Statuses of the last of several looks, a second apart, by part."""
    diagnosis = Diagnosis("/yawdamp_sim", "interlink")
    array = [diagnosis.of(one, 1.0, 3_000_000_007) for one in readings][-1]
    assert (array.header.stamp.sec, array.header.stamp.nanosec) == (3, 7)
    return {status.name.removeprefix("/yawdamp_sim: "): status for status in array.status}


def told(status: DiagnosticStatus) -> tuple[bytes, str]:
    return status.level, values(status)["state"]


def with_changes(**changes: Any) -> Readings:  # noqa: ANN401 - any reading
    return IN_ORDER._replace(**changes)


def test_good_order_is_ok_in_every_part() -> None:
    statuses = looks(IN_ORDER)
    assert {part: told(status) for part, status in statuses.items()} == {
        "timing": (b"\0", "in_time"),
        "steering": (b"\0", "commanded"),
        "inputs": (b"\0", "no_command"),
        "recorder": (b"\0", "recording"),
        "model": (b"\0", "stable"),
        "events": (b"\0", "nothing"),
    }
    assert values(statuses["timing"])["achieved_rate"] == "100.00 Hz"
    assert values(statuses["timing"])["worst_lateness"] == "1.500 ms"
    assert {status.hardware_id for status in statuses.values()} == {"interlink"}
    assert statuses["recorder"].message == "recording to runs/a"


def test_every_count_is_told_under_the_key_of_its_verdict() -> None:
    steering = values(looks(IN_ORDER)["steering"])
    assert (steering["accepted"], steering["clamped"], steering["rejected_stale"]) == ("5", "0", "0")


def test_an_event_warns_once_and_stays_told() -> None:
    lifted = with_changes(events=("wheel_lift of trailer_2, axle 1, left at 3.2 s",))
    events = looks(IN_ORDER, lifted)["events"]
    assert told(events) == (b"\1", "happened")
    assert events.message == "wheel_lift of trailer_2, axle 1, left at 3.2 s"
    later = looks(IN_ORDER, lifted, lifted)["events"]
    assert told(later) == (b"\0", "nothing")
    assert (values(later)["count"], values(later)["last"]) == ("1", lifted.events[0])


def test_dropped_steps_warn_at_the_look_that_sees_them_and_not_at_the_next() -> None:
    dropped = with_changes(steps_dropped=40)
    assert told(looks(IN_ORDER, dropped)["timing"]) == (b"\1", "steps_dropped")
    assert told(looks(IN_ORDER, dropped, dropped)["timing"]) == (b"\0", "in_time")


def test_a_pause_is_told() -> None:
    timing = looks(with_changes(paused=True))["timing"]
    assert told(timing) == (b"\0", "paused")
    assert values(timing)["wanted_rate"] == "paused"


def test_a_rejected_command_warns_once_with_its_key() -> None:
    rejected = with_changes(commands={Verdict.ACCEPTED: 5, Verdict.CLAMPED: 0, Verdict.STALE: 2})
    steering = looks(IN_ORDER, rejected)["steering"]
    assert told(steering) == (b"\1", "commanded")
    assert values(steering)["problems"] == "rejected_stale"
    assert steering.message == ("since the last look: steering rejected, its time stamp is too far from now")
    assert told(looks(IN_ORDER, rejected, rejected)["steering"])[0] == b"\0"


def test_an_input_whose_controller_fell_silent_warns_until_it_comes_again() -> None:
    silent = with_changes(
        inputs={"acceleration": InputReading(-1.0, 0.7, {Verdict.ACCEPTED: 3}, timed_out=True)}
    )
    inputs = looks(IN_ORDER, silent, silent)["inputs"]
    assert told(inputs) == (b"\1", "timed_out")
    assert values(inputs)["problems"] == "acceleration_timed_out"
    assert inputs.message == "acceleration: no command for longer than steering_timeout"
    heard = with_changes(inputs={"acceleration": InputReading(-1.0, 0.1, {Verdict.ACCEPTED: 4})})
    assert told(looks(silent, heard)["inputs"]) == (b"\0", "commanded")


def test_the_speed_s_problems_are_told_apart_from_the_steering_s() -> None:
    reading = InputReading(20.0, 0.25, {Verdict.ACCEPTED: 1, Verdict.BACKWARDS: 1})
    backwards = with_changes(inputs={"speed": reading})
    statuses = looks(IN_ORDER, backwards)
    assert told(statuses["steering"]) == (b"\0", "commanded")
    assert told(statuses["inputs"]) == (b"\1", "commanded")
    inputs = values(statuses["inputs"])
    assert inputs["problems"] == "speed_rejected_backwards"
    assert (inputs["speed"], inputs["speed_rejected_backwards"]) == ("20, 0.250 s ago", "1")
    assert told(looks(IN_ORDER, backwards, backwards)["inputs"])[0] == b"\0"


def test_two_sources_of_one_input_are_told_by_its_topic() -> None:
    crowd = Finding(Problem.SEVERAL_PUBLISHERS, "/trailer_1/brake: 2 publish at once", "/trailer_1/brake")
    statuses = looks(with_changes(neighbourhood=Neighbourhood(0, (crowd,))))
    assert told(statuses["steering"])[0] == b"\0"
    assert statuses["inputs"].message == "/trailer_1/brake: 2 publish at once"
    assert values(statuses["inputs"])["problems"] == "several_publishers"


def test_the_origin_of_the_steering_is_told() -> None:
    assert told(looks(with_changes(steering_age=None))["steering"]) == (b"\0", "no_command")
    timed_out = with_changes(steering_age=0.7, steering_timed_out=True)
    assert told(looks(timed_out)["steering"]) == (b"\1", "timed_out")
    driven = with_changes(steering_age=None, manoeuvre="sine")
    assert told(looks(driven)["steering"]) == (b"\0", "manoeuvre")


def test_the_neighbours_findings_warn_for_as_long_as_they_last() -> None:
    findings = (
        Finding(Problem.SEVERAL_PUBLISHERS, "two steer"),
        Finding(Problem.QOS_MISMATCH, "one is deaf"),
    )
    crowded = with_changes(neighbourhood=Neighbourhood(3, findings))
    for statuses in (looks(crowded), looks(crowded, crowded)):
        assert statuses["steering"].level == b"\1"
        assert values(statuses["steering"])["problems"] == "several_publishers,qos_mismatch"
        assert statuses["steering"].message == "two steer; one is deaf"


def test_a_recorder_that_failed_is_an_error_for_good_and_one_that_drops_when_it_does() -> None:
    failed = with_changes(recorder=RecorderState.FAILED, recorder_detail="no space left")
    assert told(looks(failed, failed)["recorder"]) == (b"\2", "failed")
    assert looks(failed)["recorder"].message == "failed: no space left"
    dropping = with_changes(messages_lost=16)
    assert told(looks(IN_ORDER, dropping)["recorder"]) == (b"\2", "dropping")
    assert told(looks(IN_ORDER, dropping, dropping)["recorder"]) == (b"\0", "recording")


def test_an_unstable_model_warns() -> None:
    assert told(looks(with_changes(least_damping_ratio=-0.01))["model"]) == (b"\1", "unstable")


def test_a_run_beyond_the_linear_range_warns_with_its_sentence() -> None:
    model = looks(with_changes(beyond="lateral acceleration of truck 4.1 m/s^2, past 4"))["model"]
    assert told(model) == (b"\1", "beyond_linear_range")
    assert model.message == "lateral acceleration of truck 4.1 m/s^2, past 4"
