"""CSV files of every kind that should not be: steering logs, runs, and sweeps that are gone on from."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from faults.hostile import accepted_or_refused, checked, damaged, refusal
from yawdamp_ros.cli import run
from yawdamp_ros.logs import SteeringLog, read_steering_csv

pytestmark = pytest.mark.timeout(60)

LOG = b"time,steering_angle\n" + b"".join(b"%.2f,%.3f\n" % (0.01 * row, 0.001 * row) for row in range(12))
HEADER = "time,steering_angle,car/yaw,car/yaw_rate,car/lateral_acceleration"
RUN = f"{HEADER}\n0.0,0.1,0.0,0.0,0.5\n0.001,0.1,1e-05,0.002,0.5\n".encode()
STRANGE = settings(max_examples=80, suppress_health_check=[HealthCheck.function_scoped_fixture])


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "log.csv"


@pytest.fixture
def out(tmp_path: Path) -> str:
    return str(tmp_path / "out.csv")


@STRANGE
@given(content=st.one_of(damaged(LOG), st.binary(max_size=200)))
def test_a_damaged_steering_log_is_taken_or_refused_in_one_line(file: Path, out: str, content: bytes) -> None:
    file.write_bytes(content)
    accepted_or_refused("simulate", "--log", file, "--duration", "0.01", "--output", out)


CELLS = st.one_of(st.floats().map(repr), st.integers().map(str), st.text(max_size=8), st.just("9" * 400))


@STRANGE
@given(rows=st.lists(st.lists(CELLS, min_size=1, max_size=4).map(",".join), max_size=6))
def test_any_cells_are_a_log_or_refused_in_one_line(file: Path, out: str, rows: list[str]) -> None:
    file.write_text("\n".join(["time,steering,other", *rows]), encoding="utf-8", newline="")
    accepted_or_refused("simulate", "--log", file, "--duration", "0.01", "--output", out)


@pytest.mark.parametrize(
    "content, said",
    [
        (b"time,steering\n0,1e308\n", "line 2: steering: 1e308: expected an angle within 10000 rad"),
        (b"time,steering\n-1e308,0\n1e308,0\n", "it lasts inf s; expected at most 1e+09 s"),
        (b"time,steering\n0,0\n1763769600,0\n", "it lasts 1.76377e+09 s; expected at most 1e+09 s"),
        (b"time,steering\n0,0\n0,-0.0\n-1e-9,0\n", "line 4: time: -1e-09: expected a time not before 0.0"),
        (b"time,steering\n0," + b"9" * 100_000, "expected a finite number"),
        (b'time,steering\n0,"0\n' + b"1,0\n" * 50_000, "not valid CSV: field larger than field limit"),
        (b"time;steering\n0;0\n", "no time column"),
        (b"time,steering\n0,\0\n", r"line 2: steering: '\x00': expected a finite number"),
        (
            b'"ti\nme\x1b[2J",steering\n0,0\n',
            r"expected one of time, time_s, t, timestamp, time_ms, time_us, time_ns among ti\nme\x1b[2J",
        ),
        (b",".join(b"steer%d" % index for index in range(60_000)) + b",time\n", "several steering columns"),
        ("time,steering\n0,0\n".encode("utf-16"), "not UTF-8 text"),
        ("time,steering,größe\n0,0\n".encode("latin-1"), "not UTF-8 text"),
    ],
    ids=range(12),
)
def test_what_is_no_log_is_refused_by_what_is_wrong_with_it(
    file: Path, content: bytes, said: str, out: str
) -> None:
    file.write_bytes(content)
    assert said in refusal("simulate", "--log", file, "--output", out)
    assert not Path(out).exists()


def test_lines_of_any_length_end_and_times_that_stand_still_are_taken(file: Path) -> None:
    file.write_bytes(b"\xef\xbb\xbftime,steering\r\n5,0.1,9,9\r\n\r\n5,0.2\r\n1_0,-0.0\r\n")
    assert read_steering_csv(file) == SteeringLog(str(file), [0.0, 0.0, 5.0], [0.1, 0.2, -0.0])


@pytest.mark.parametrize("command", ["simulate", "plot", "resimulate"])
def test_what_never_ends_is_not_waited_for(file: Path, command: str, out: str) -> None:
    arguments = {"simulate": ["--output", out, "--log"], "plot": [], "resimulate": []}[command]
    os.mkfifo(file)
    for path in (file, Path("/dev/zero")):
        assert "cannot be read: not a regular file" in refusal(command, *arguments, path)


@pytest.mark.parametrize(
    "start", [b"", b"time,steering\n0,", b'time,steering\n0,"', b"time,steering," + b"," * 100]
)
def test_a_hundred_megabytes_of_one_line_are_not_read(file: Path, start: bytes, out: str) -> None:
    with file.open("wb") as opened:
        opened.write(start)
        opened.writelines([b"1" * 1_000_000] * 100)
    assert "a line of more than 1048576 characters" in refusal("simulate", "--log", file, "--output", out)


@STRANGE
@given(content=st.one_of(damaged(RUN), st.binary(max_size=200)))
def test_a_damaged_run_is_taken_or_refused_in_one_line(file: Path, content: bytes) -> None:
    file.write_bytes(content)
    accepted_or_refused("resimulate", file, "--vehicle", "single_vehicle", statuses=(0, 1))


@settings(max_examples=8, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    unit=st.text(max_size=12).filter(lambda name: '"' not in name),
    values=st.lists(st.floats(-1e30, 1e30), min_size=5, max_size=5),
)
def test_any_unit_and_any_numbers_are_drawn_or_refused_in_one_line(
    file: Path, unit: str, values: list[float]
) -> None:
    header = ",".join(f'"{name}"' for name in HEADER.replace("car", unit).split(","))
    file.write_text(f"{header}\n{','.join(map(repr, values))}\n0,0,0,0,0\n", encoding="utf-8", newline="")
    accepted_or_refused("plot", file, "--output", str(file.with_suffix(".svg")))


@pytest.mark.parametrize(
    "name, unit",
    [
        ("run", r"$\frac$"),
        ("run", "$"),
        ("run", "\x1b[2J"),
        ("run", "漢字"),
        (r"$\frac{$", "car"),
        ("漢字", "car"),
        ("a\x1bb", "car"),
    ],
    ids=range(7),
)
def test_a_name_is_no_formula_whatever_signs_are_in_it(tmp_path: Path, name: str, unit: str) -> None:
    file = tmp_path / f"{name}.csv"
    file.write_text(RUN.decode().replace("car", unit), encoding="utf-8")
    assert accepted_or_refused("plot", file, "--output", str(tmp_path / "run.svg"))


@pytest.mark.parametrize(
    "text, said",
    [
        (f"{HEADER},car/yaw\n0,0,0,0,0,0\n", "column car/yaw: twice; expected every column once"),
        (
            f"{HEADER}\n0,0,0,0,1e31\n",
            "line 2: car/lateral_acceleration: 1e31: expected a number within 1e+30",
        ),
        (f"{HEADER}\n0,0,0,0\n", "line 2: 4 values; expected 5"),
        ("time,steering_angle,x\x1b[2J/yaw\n", r"no column x\x1b[2J/yaw_rate; it has time"),
        (",".join(f"u{index}/yaw" for index in range(60_000)) + "\n", "no column time; it has u0/yaw"),
    ],
    ids=range(5),
)
def test_what_is_no_run_is_refused_by_what_is_wrong_with_it(file: Path, text: str, said: str) -> None:
    file.write_text(text, encoding="utf-8")
    for command in ("plot", "resimulate"):
        assert said in refusal(command, file)


def test_a_run_of_thousands_of_units_is_no_work(file: Path) -> None:
    units = [f"u{index}" for index in range(9000)]
    names = [
        "time",
        "steering_angle",
        *(f"{unit}/{name}" for unit in units for name in ("yaw", "yaw_rate", "lateral_acceleration")),
    ]
    names += [f"articulation_{joint}" for joint in range(1, len(units))]
    file.write_text(",".join(names) + "\n" + ",".join(["0"] * len(names)) + "\n")
    # What is wrong is the picture, not the file.
    assert "9000 units in one picture; expected at most 7" in refusal("plot", str(file))


@pytest.fixture(scope="module")
def swept(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("sweep") / "sweep.csv"
    assert accepted_or_refused("sweep", "--vary", "speed=10:20:3", "--jobs", "1", "--output", path)
    return path


@settings(max_examples=30, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data(), which=st.sampled_from(["sweep.csv", "sweep.csv.json"]))
def test_a_damaged_sweep_is_gone_on_from_or_refused_and_left_alone(
    swept: Path, tmp_path: Path, data: st.DataObject, which: str
) -> None:
    for name in ("sweep.csv", "sweep.csv.json"):
        shutil.copy(swept.with_name(name), tmp_path / name)
    content = data.draw(damaged((tmp_path / which).read_bytes()))
    (tmp_path / which).write_bytes(content)
    output = tmp_path / "sweep.csv"
    if not accepted_or_refused("sweep", "--vary", "speed=10:20:3", "--jobs", "1", "--output", output):
        assert (tmp_path / which).read_bytes() == content


@pytest.mark.parametrize(
    "spoil", [lambda path: path.write_bytes(b"x" * 50_000_000), lambda path: path.write_text("notes")]
)
def test_a_file_that_holds_something_else_is_not_written_over(
    swept: Path, tmp_path: Path, spoil: object
) -> None:
    output = Path(shutil.copy(swept, tmp_path))
    shutil.copy(f"{swept}.json", tmp_path)
    spoil(output)
    size = output.stat().st_size
    refusal("sweep", "--vary", "speed=10:20:3", "--jobs", "1", "--output", output)
    assert output.stat().st_size == size


def test_the_command_itself_refuses_in_one_line(file: Path, out: str) -> None:
    file.write_bytes(b"time,steering\n0,1e308\n")
    command = [sys.executable, "-m", "yawdamp_ros", "simulate", "--log", str(file), "--output", out]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (2, "")
    checked(done.stderr, str(file))


def test_of_a_log_without_end_only_what_is_asked_for_is_read(file: Path, out: str) -> None:
    rows = (f"{0.01 * row:.2f},0.01\n" for row in range(20_000))
    file.write_text("time,steering_angle\n" + "".join(rows))
    os.truncate(file, 1 << 36)  # 64 GiB more, which no disk holds
    assert run(["simulate", "--log", str(file), "--duration", "1", "--output", out]) == 0
    assert len(Path(out).read_text().splitlines()) == 1002


def test_memory_that_does_not_suffice_is_said_in_one_line(file: Path) -> None:
    rows = (f"{0.01 * row:.2f},0.01,0.1\n" for row in range(200_000))
    file.write_text("time,steering_angle,truck/yaw_rate\n" + "".join(rows))
    program = """
import resource, sys
import yawdamp_ros.drives, yawdamp_ros.logs.drive_csv
from yawdamp_ros.cli import run

run(["compare", sys.argv[1], "--duration", "20"])
used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (used + (8 << 20), used + (8 << 20)))
sys.exit(run(["compare", sys.argv[1]]))
"""
    done = subprocess.run(
        [sys.executable, "-c", program, str(file)], capture_output=True, text=True, check=False, timeout=50
    )
    assert (done.returncode, done.stderr.splitlines()[-1]) == (2, "yawdamp compare: out of memory")
    assert "Traceback" not in done.stderr
