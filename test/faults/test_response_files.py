"""Recorded runs that are not what they say: drawn and run again, or refused in one line that names them."""

import json
import struct
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from rclpy.serialization import serialize_message
from sensor_msgs.msg import JointState

from faults.hostile import (
    CDR,
    accepted_or_refused,
    changed_json,
    damaged,
    recording,
    refusal,
    rewritten,
    run_metadata,
)

pytestmark = pytest.mark.timeout(60)

STRANGE = settings(max_examples=35, suppress_health_check=[HealthCheck.function_scoped_fixture])


@pytest.fixture(scope="module")
def run_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    directory = tmp_path_factory.mktemp("recorded") / "run"
    options = ("--vehicle", "truck_trailer", "--duration", "0.05", "--output", directory)
    assert accepted_or_refused("simulate", "--manoeuvre", "sine", "--start", "0", *options)
    return directory / "run_0.mcap"


@pytest.fixture
def target(tmp_path: Path) -> Path:
    return tmp_path / "changed.mcap"


@STRANGE
@given(data=st.data())
def test_a_damaged_run_is_taken_or_refused_in_one_line(
    run_file: Path, target: Path, data: st.DataObject
) -> None:
    target.write_bytes(data.draw(damaged(run_file.read_bytes())))
    accepted_or_refused("resimulate", target, statuses=(0, 1))


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=10),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner, max_size=3),
    max_leaves=5,
).map(json.dumps)
ENTRIES = (
    "vehicle.yaml",
    "vehicle_overrides",
    "model",
    "speed",
    "step_ns",
    "steps_per_sample",
    "start_time_ns",
    "input_topics",
    "output_topics",
    "initial",
    "parameters",
    "build",
)


@STRANGE
@given(entry=st.sampled_from(ENTRIES), text=st.one_of(JSON, st.text(max_size=20), st.none()))
def test_any_text_of_any_entry_is_taken_or_refused_in_one_line(
    run_file: Path, target: Path, entry: str, text: str | None
) -> None:
    rewritten(run_file, target, {entry: text})
    accepted_or_refused("resimulate", target, statuses=(0, 1))


@STRANGE
@given(
    entry=st.sampled_from(["initial", "parameters"]),
    key=st.sampled_from(
        ["step", "speed", "vector", "x", "sampled", "yaw_stddev", "noise_seed", "frame_prefix"]
    ),
    value=JSON.map(json.loads),
)
def test_any_value_of_the_start_is_taken_or_refused_in_one_line(
    run_file: Path, target: Path, entry: str, key: str, value: object
) -> None:
    known = run_metadata(run_file)[entry]
    rewritten(run_file, target, {entry: changed_json(known, **{key: value})})
    accepted_or_refused("resimulate", target, statuses=(0, 1))


@pytest.mark.parametrize(
    "changes, said",
    [
        ({"step_ns": "0"}, "steps of 0 ns"),
        ({"step_ns": "-1000000"}, "steps of -1000000 ns"),
        ({"step_ns": "1"}, "steps of 1 ns"),
        ({"step_ns": "9" * 5000}, "Exceeds the limit"),
        ({"steps_per_sample": "0"}, "0 a sample"),
        ({"steps_per_sample": "1" + "0" * 18}, "1000000000000000000 a sample"),
        ({"initial": "[" * 100_000}, "maximum recursion depth"),
        ({"vehicle_overrides": "[3]"}, "not a run of this package"),
        ({"parameters": "[3]"}, "not a run of this package"),
        ({"parameters": '{"noise_seed": -1, "yaw_stddev": 1.0}'}, "cannot be run again"),
        ({"output_topics": "{}"}, "not a run of this package"),
        (
            {"vehicle.yaml": "name: !!python/object/apply:os.system ['touch executed']"},
            "not determine a constructor",
        ),
        ({"vehicle.yaml": "a: &a [*a]"}, "with what its aliases stand for"),
        ({"speed": "nan"}, "speed: nan: expected a speed"),
        ({"model": "\x1b[2J\n" * 1000}, "expected one of consistent, published"),
    ],
    ids=range(15),
)
def test_a_run_that_cannot_be_is_refused_by_what_is_wrong_with_it(
    run_file: Path, target: Path, changes: dict[str, str], said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(target.parent)
    rewritten(run_file, target, changes)
    assert said in refusal("resimulate", target)
    assert list(target.parent.iterdir()) == [target]


def test_a_start_far_from_the_first_sample_is_a_difference(run_file: Path, target: Path) -> None:
    known = run_metadata(run_file)["initial"]
    for step in (-(10**12), 10**12):
        rewritten(run_file, target, {"initial": changed_json(known, step=step)})
        assert accepted_or_refused("resimulate", target, statuses=(1,))


def test_an_attachment_is_written_nowhere(target: Path) -> None:
    names = ("../escaped", "/escaped", "a/b", "vehicle.yaml\0", "..")
    target.write_bytes(
        recording([], attachments=dict.fromkeys(names, b"x"), metadata={"../escaped": {"a": "b"}})
    )
    for command in ("resimulate", "plot"):
        refusal(command, target)
    assert list(target.parent.iterdir()) == [target]
    assert not (target.parent.parent / "escaped").exists()


def with_joint_states(run_file: Path, target: Path, data: bytes) -> Path:
    """A copy of a run whose joint states are some bytes."""
    return rewritten(run_file, target, {}, {"/joint_states": data})


HUGE_COUNT = CDR + struct.pack("<iI", 0, 0) + struct.pack("<I", 1) + b"\0\0\0\0" + b"\xff\xff\xff\xff"


@pytest.mark.parametrize(
    "data",
    [
        b"",
        CDR,
        b"\0" * 8,
        HUGE_COUNT,
        CDR + b"\xff" * 200,
        serialize_message(JointState()),
        serialize_message(JointState(position=[1e308] * 3)),
    ],
    ids=range(7),
)
def test_a_message_that_is_none_is_a_difference_or_refused(run_file: Path, target: Path, data: bytes) -> None:
    with_joint_states(run_file, target, data)
    accepted_or_refused("resimulate", target, statuses=(1,))
    accepted_or_refused("plot", target, "--output", str(target.with_suffix(".svg")))


@STRANGE
@given(data=st.binary(max_size=120))
def test_any_bytes_of_a_message_are_a_difference_or_refused(
    run_file: Path, target: Path, data: bytes
) -> None:
    with_joint_states(run_file, target, CDR + data)
    accepted_or_refused("resimulate", target, statuses=(1,))


@pytest.mark.parametrize("value", [float("nan"), float("inf"), 1e308])
def test_a_steering_that_is_no_number_is_a_difference_or_refused(
    run_file: Path, target: Path, value: float
) -> None:
    rewritten(run_file, target, {}, {"/steering_applied": CDR + struct.pack("<d", value)})
    accepted_or_refused("resimulate", target, statuses=(1,))
