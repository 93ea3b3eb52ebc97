"""Vehicle files of every kind that should not be: accepted, or refused in one line that names them."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from faults.hostile import accepted_or_refused, checked, damaged, refusal
from yawdamp_ros.vehicle import load_vehicle, vehicle_text

pytestmark = pytest.mark.timeout(60)

TRUCK = b"""name: truck
speed: 20.0
units:
  - name: truck
    mass: 9200.0
    yaw_inertia: 36776.6
    axles:
      - {position: 0.04, cornering_stiffness: 8.9e5, steered: true}
      - {position: -4.4, cornering_stiffness: 1.2e6}
"""
BILLION = "a: &a [x, x, x, x, x, x, x, x, x, x]\n" + "".join(
    f"{name}: &{name} [{', '.join([f'*{before}'] * 10)}]\n"
    for before, name in zip("abcdefgh", "bcdefghi", strict=True)
)
MERGED = "a: &a {x: 1}\n" + "".join(
    f"{name}: &{name} {{<<: [{', '.join([f'*{before}'] * 10)}]}}\n"
    for before, name in zip("abcdefgh", "bcdefghi", strict=True)
)
KEYED = (
    "a: &a [x, x]\n"
    + "".join(
        f"{name}: &{name} [{', '.join([f'*{before}'] * 10)}]\n"
        for before, name in zip("abcdefgh", "bcdefghi", strict=True)
    )
    + "? *i\n: 1\n"
)


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "vehicle.yaml"


@settings(max_examples=200, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(content=st.one_of(damaged(TRUCK), damaged(vehicle_text("a_double").encode()), st.binary(max_size=300)))
def test_a_damaged_file_is_taken_or_refused_in_one_line(file: Path, content: bytes) -> None:
    file.write_bytes(content)
    accepted_or_refused("urdf", "--vehicle", file)


SCALARS = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.floats(),
    st.text(max_size=20),
    st.sampled_from(
        ["~", "0o17", "0x1F", "1_000", "1e400", "-0.0", ".inf", "yes", "2012-02-30", "!!int ''", "1:30"]
    ),
)
KEYS = (
    "name",
    "speed",
    "units.0",
    "units.0.name",
    "units.0.mass",
    "units.0.axles",
    "units.0.axles.0.steered",
    "x",
)


@settings(max_examples=100)
@given(
    key=st.sampled_from(KEYS),
    value=st.recursive(SCALARS, lambda inner: st.lists(inner, max_size=3), max_leaves=5),
)
def test_any_value_of_any_key_is_taken_or_refused_in_one_line(key: str, value: object) -> None:
    accepted_or_refused("urdf", "--vehicle", "truck_trailer", "--set", f"{key}={value}")


@pytest.mark.parametrize(
    "text, said",
    [
        ("", "None: expected a mapping"),
        (BILLION, "with what its aliases stand for"),
        (MERGED, "with what its aliases stand for"),
        (KEYED, "with what its aliases stand for"),
        ("a: &a [*a]", "with what its aliases stand for"),
        ("&a {? *a : 1}", "with what its aliases stand for"),
        ("[" * 100_000, "maximum depth"),
        ("{a: " * 50_000, "maximum depth"),
        ("- " * 100_000, "maximum depth"),
        ("a: [" + "1, " * 20_000 + "1]", "more than 10000 values"),
        ("speed: " + "9" * 200_000, "line 1: not valid YAML: a very long number"),
        ("name: 0x" + "f" * 5000, "a very long number"),
        ("? 0x" + "f" * 5000 + "\n: 1", "a very long number"),
        ("name: " + "1" * 400, "name: a very long number: expected a finite number"),
        ("speed: 1e400", "speed: inf: expected a finite number"),
        ("speed: .nan", "speed: nan: expected a finite number"),
        ("k" * 200_000 + ": 1", "mapping values are not allowed"),
        ("? " + "k" * 200_000 + "\n: 1", "kkk: unknown key; expected one of name, description"),
        ('"\\e[2J\\n\\0\\u2028": 1', r"\x1b[2J\n\x00\u2028: unknown key"),
        (TRUCK.decode().replace("truck", '"a\\nb"', 1), "name: 'a\\nb': expected a name"),
        ("1: 2", "1: unknown key"),
        ("2001-01-01: 2", "2001-01-01: unknown key"),
        ("? [1]\n: 2", "(1,): unknown key"),
        ("? {a: 1}\n: 2", "found unhashable key"),
        ("name: a\nname: b", "line 2: not valid YAML: found duplicate key"),
        ("name: 2001-13-45", "month must be in 1..12"),
        ("name: !!bool maybe", "not valid YAML"),
        ("name: !!int ''", "not valid YAML"),
        ("name: !!float ''", "not valid YAML"),
        (TRUCK.decode().replace("truck", "!!set {a, b}", 1), "expected a name"),
        ("a: 1\0", "unacceptable character #x0000"),
        ("%YAML 9.9\n---\na: 1", "incompatible YAML document"),
        ("--- 1\n--- 2", "another document"),
        ("x: &x 1\ny: &x 2", "x: unknown key"),
    ],
    ids=range(34),
)
def test_what_is_no_vehicle_is_refused_by_what_is_wrong_with_it(file: Path, text: str, said: str) -> None:
    file.write_text(text, encoding="utf-8")
    assert said in refusal("urdf", "--vehicle", file)


def test_a_time_zone_that_there_is_not_is_refused(file: Path) -> None:
    file.write_text(TRUCK.decode().replace("truck", "2001-01-01 00:00:00 +99:99", 1), encoding="utf-8")
    said = refusal("urdf", "--vehicle", file)
    # ruamel.yaml before 0.18 makes a time of it, which is no name either.
    assert "offset must be" in said or "expected a name" in said


@pytest.mark.parametrize("name", ["truck\\n", "truck\\r", "t" * 65])
def test_a_name_that_would_break_a_line_or_a_path_is_refused(name: str) -> None:
    assert "expected a name of lower-case letters" in refusal("urdf", "--set", f'name="{name}"')


@pytest.mark.filterwarnings("ignore:.*vehicle.yaml")  # a truck without its trailer, and of odd inertia
def test_aliases_tags_of_the_schema_a_mark_and_carriage_returns_do_no_harm(file: Path) -> None:
    text = TRUCK.decode().replace("mass: 9200.0", "mass: &mass !!float 9200").replace("36776.6", "*mass")
    file.write_bytes(b"\xef\xbb\xbf" + text.replace("\n", "\r\n").encode())
    assert load_vehicle(file).units[0].yaw_inertia == 9200.0


@pytest.mark.parametrize("encoding", ["utf-16", "utf-32", "latin-1"])
def test_another_encoding_is_said(file: Path, encoding: str) -> None:
    file.write_bytes((TRUCK.decode() + "description: Größe\n").encode(encoding))
    assert "not UTF-8 text" in refusal("urdf", "--vehicle", file)


@pytest.mark.parametrize(
    "tag",
    [
        "!!python/object/apply:os.system ['touch {}']",
        "!!python/object/new:os.system ['touch {}']",
        "!<tag:yaml.org,2002:python/object/apply:os.system> ['touch {}']",
        "!!python/name:os.system ''",
        "!!python/module:os ''",
        "!include {}",
        "!!js/function 'touch {}'",
    ],
)
def test_a_tag_is_never_executed(file: Path, tag: str) -> None:
    trace = file.with_name("executed")
    for text in (f"name: {tag}", f"{tag}", f"? {tag}\n: 1", f"a: &a {tag}\nb: *a"):
        file.write_text(text.format(trace), encoding="utf-8")
        assert "could not determine a constructor for the tag" in refusal("urdf", "--vehicle", file)
    assert list(file.parent.iterdir()) == [file]


def test_what_never_ends_is_not_waited_for(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe.yaml"
    os.mkfifo(pipe)
    for path in (pipe, Path("/dev/zero"), Path("/dev/full")):
        assert "cannot be read: not a regular file" in refusal("urdf", "--vehicle", path)


def test_a_directory_and_a_link_to_nowhere_are_refused(tmp_path: Path) -> None:
    link = tmp_path / "link.yaml"
    link.symlink_to(tmp_path / "nowhere")
    assert "no such vehicle" in refusal("urdf", "--vehicle", link)
    assert "cannot be read: Is a directory" in refusal("urdf", "--vehicle", tmp_path)


@pytest.mark.skipif(os.geteuid() == 0, reason="nothing is forbidden to root")
def test_a_file_that_may_not_be_read_is_refused(file: Path) -> None:
    file.write_bytes(TRUCK)
    file.chmod(0)
    assert "cannot be read: Permission denied" in refusal("urdf", "--vehicle", file)


@pytest.mark.parametrize("start", [b"", b"a: ", b"["])
def test_a_hundred_megabytes_of_one_line_are_not_read(file: Path, start: bytes) -> None:
    with file.open("wb") as opened:
        opened.write(start)
        opened.writelines([b"x" * 1_000_000] * 100)
    assert "cannot be read: longer than 262144 characters" in refusal("urdf", "--vehicle", file)


@pytest.mark.parametrize(
    "text",
    [BILLION, "[" * 100_000, "name: !!python/object/apply:os.system ['touch executed']"],
    ids=["aliases", "nesting", "tag"],
)
def test_the_command_itself_refuses_in_one_line(file: Path, text: str) -> None:
    file.write_text(text, encoding="utf-8")
    command = [sys.executable, "-m", "yawdamp_ros", "simulate", "--manoeuvre", "sine", "--vehicle", str(file)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=file.parent)
    assert (done.returncode, done.stdout) == (2, "")
    checked(done.stderr, str(file))
    assert list(file.parent.iterdir()) == [file]
