"""A sweep's file goes on from where it broke off, and holds one sweep only."""

from contextlib import closing
from pathlib import Path

import numpy as np
import pytest

from yawdamp_ros.logs import LogError
from yawdamp_ros.logs.sweep_csv import SweepCsv

POINTS = np.array([[1.0, 0.1], [1.0, 0.2], [2.0, 0.1], [2.0, 1 / 3]])
ANSWERS = np.array([[-1.5], [np.nan], [0.1 + 0.2], [4e-300]])
COLUMNS = ("units.0.mass,units.1.mass", "speed", "largest_real_part")
DEFINITION = {"vehicle": "interlink", "measure": "stability"}


def sink(path: Path, **changed: object) -> SweepCsv:
    return SweepCsv(path, {**DEFINITION, **changed}, POINTS, COLUMNS)


def test_rows_are_points_and_answers_in_full_precision(tmp_path: Path) -> None:
    path = tmp_path / "sweep.csv"
    with closing(sink(path)) as opened:
        opened.write(ANSWERS[:1])
        opened.write(ANSWERS[1:])
    assert path.read_text().splitlines() == [
        '"units.0.mass,units.1.mass",speed,largest_real_part',
        "1.0,0.1,-1.5",
        "1.0,0.2,nan",
        "2.0,0.1,0.30000000000000004",
        "2.0,0.3333333333333333,4e-300",
    ]


def test_a_file_cut_anywhere_is_gone_on_from(tmp_path: Path) -> None:
    whole = tmp_path / "whole.csv"
    with closing(sink(whole)) as opened:
        opened.write(ANSWERS)
    text = whole.read_text()
    description = (tmp_path / "whole.csv.json").read_text()
    for length in range(len(text) + 1):
        path = tmp_path / "cut.csv"
        path.write_text(text[:length])
        (tmp_path / "cut.csv.json").write_text(description)
        with closing(sink(path)) as opened:
            assert len(opened.answers) == max(text[:length].count("\n") - 1, 0)
            np.testing.assert_array_equal(opened.answers, ANSWERS[: len(opened.answers)])
            opened.write(ANSWERS[len(opened.answers) :])
        assert path.read_text() == text


def test_what_is_written_is_in_the_file_at_once(tmp_path: Path) -> None:
    path = tmp_path / "sweep.csv"
    with closing(sink(path)) as opened:
        opened.write(ANSWERS[:2])
        assert path.read_text().count("\n") == 3


@pytest.mark.parametrize(
    "spoil",
    [
        lambda path: path.with_name("sweep.csv.json").write_text("{}"),
        lambda path: path.with_name("sweep.csv.json").unlink(),
        lambda path: path.write_text(path.read_text().replace("1.0,0.2", "1.0,0.3")),
        lambda path: path.write_text(path.read_text().replace("speed", "mass")),
        lambda path: path.write_text(path.read_text() + "1.0\n"),
        lambda path: path.write_text(path.read_text() + "a,b,c\n"),
        lambda path: path.write_text(path.read_text() + "2.0,0.4,1.0\n" * 3),
    ],
)
def test_a_file_that_is_not_of_this_sweep_is_refused_and_left_alone(tmp_path: Path, spoil: object) -> None:
    path = tmp_path / "sweep.csv"
    with closing(sink(path)) as opened:
        opened.write(ANSWERS)
    spoil(path)
    before = path.read_bytes()
    with pytest.raises(LogError, match=r"sweep.csv: is there and is not of this sweep"):
        sink(path)
    assert path.read_bytes() == before


def test_another_question_about_the_same_points_is_another_sweep(tmp_path: Path) -> None:
    with closing(sink(tmp_path / "sweep.csv")) as opened:
        opened.write(ANSWERS)
    with pytest.raises(LogError, match="is not of this sweep"):
        sink(tmp_path / "sweep.csv", vehicle="a_double")


def test_a_place_that_cannot_be_written_is_one_line(tmp_path: Path) -> None:
    with pytest.raises(LogError, match="cannot be used: No such file or directory"):
        sink(tmp_path / "nowhere" / "sweep.csv")
