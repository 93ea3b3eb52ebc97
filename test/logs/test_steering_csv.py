import math
from pathlib import Path

import pytest

from yawdamp_ros.logs import LogError, SteeringLog, read_steering_csv


def written(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "log.csv"
    path.write_text(text, encoding="utf-8")
    return path


def test_the_steering_column_is_found_by_its_name(tmp_path: Path) -> None:
    log = read_steering_csv(written(tmp_path, "speed,time,steering_angle\n20,0.5,0.1\n21,1.5,-0.2\n"))
    assert log.times == [0.0, 1.0]
    assert log.angles == [0.1, -0.2]


def test_a_column_in_degrees_says_so_by_its_name_or_by_the_option(tmp_path: Path) -> None:
    by_name = read_steering_csv(written(tmp_path, "time_s,steering_wheel_angle_deg\n0,180\n"))
    by_option = read_steering_csv(written(tmp_path, "t,wheel\n0,180\n"), "wheel", degrees=True)
    assert by_name.angles == by_option.angles == [pytest.approx(math.pi)]


def test_a_byte_order_mark_spaces_and_blank_lines_do_no_harm(tmp_path: Path) -> None:
    log = read_steering_csv(written(tmp_path, "\ufefftime, steering\n\n0, 1e-1\n\n"))
    assert log.angles == [0.1]


@pytest.mark.parametrize(
    "text, message",
    [
        ("", "empty; expected a line of column names"),
        ("time,steering\n", "no samples"),
        ("zeit,steering\n0,0\n", "no time column; expected one of time, time_s, t, timestamp"),
        ("time,angle\n0,0\n", "no steering column; name one with --column: time, angle"),
        (
            "time,steer_l,steer_r\n0,0,0\n",
            "several steering columns; name one with --column: steer_l, steer_r",
        ),
        ("time,steering\n0,left\n", "line 2: steering: 'left': expected a finite number"),
        ("time,steering\n0,nan\n", "line 2: steering: 'nan': expected a finite number"),
        ("time,steering\n0,0\ninf,0\n", "line 3: time: 'inf': expected a finite number"),
        ("time,steering\n0,0\n1\n", "line 3: steering: missing, the line has 1 values"),
        ("time,steering\n1,0\n0.5,0\n", "line 3: time: 0.5: expected a time not before 1.0"),
        ('time,steering\n0,"' + "x" * 200_000 + '"\n', "not valid CSV: field larger than field limit"),
    ],
)
def test_a_bad_log_is_refused_in_one_line_that_names_the_place(
    tmp_path: Path, text: str, message: str
) -> None:
    path = written(tmp_path, text)
    with pytest.raises(LogError) as caught:
        read_steering_csv(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_column_that_is_not_there_is_refused_with_those_that_are(tmp_path: Path) -> None:
    path = written(tmp_path, "time,steering\n0,0\n")
    with pytest.raises(LogError, match="wheel: no such column; expected one of time, steering"):
        read_steering_csv(path, "wheel")


def test_a_missing_file_a_directory_and_a_binary_file_are_refused(tmp_path: Path) -> None:
    with pytest.raises(LogError, match="No such file"):
        read_steering_csv(tmp_path / "none.csv")
    with pytest.raises(LogError, match="Is a directory"):
        read_steering_csv(tmp_path)
    binary = tmp_path / "binary.csv"
    binary.write_bytes(b"\x89PNG\r\n\x1a\n\xff\xfe")
    with pytest.raises(LogError, match="not UTF-8 text"):
        read_steering_csv(binary)


def test_the_newest_sample_is_in_force() -> None:
    log = SteeringLog("log", [0.0, 1.0, 1.0, 2.0], [0.1, 0.2, 0.3, 0.4])
    assert [log(time) for time in (-0.1, 0.0, 0.999, 1.0, 1.5, 2.0, 99.0)] == [
        0.0,
        0.1,
        0.1,
        0.3,
        0.3,
        0.4,
        0.4,
    ]


def test_a_hand_wheel_log_is_divided_by_its_ratio() -> None:
    assert SteeringLog("log", [0.0], [1.688]).divided(16.88).angles == [0.1]
