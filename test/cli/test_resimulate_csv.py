from pathlib import Path

import pytest

from yawdamp_ros.cli import run


@pytest.fixture
def csv_run(tmp_path: Path) -> Path:
    path = tmp_path / "run.csv"
    options = ["--vehicle", "truck_trailer", "--speed", "25", "--duration", "2", "--output", str(path)]
    assert run(["simulate", "--manoeuvre", "chirp", *options]) == 0
    return path


def test_a_csv_is_run_again_with_the_vehicle_it_is_told(
    csv_run: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["resimulate", str(csv_run), "--vehicle", "truck_trailer", "--speed", "25"]) == 0
    shown = capsys.readouterr().out
    assert "2001 samples, 14007 values over 2 s" in shown
    assert "promised is 1e-9 of the motion, for a CSV file does not record its build" in shown
    assert "every value is bit-identical" in shown


def test_another_speed_is_another_run(csv_run: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["resimulate", str(csv_run), "--vehicle", "truck_trailer", "--speed", "25.001"]) == 1
    assert "DIFFERENT first at 0.00" in capsys.readouterr().out


def test_a_csv_without_every_step_or_of_other_units_is_refused(
    csv_run: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["resimulate", str(csv_run)]) == 2
    assert "units truck, trailer: expected truck, trailer_1, trailer_2" in capsys.readouterr().err
    lines = csv_run.read_text().splitlines()
    gap = tmp_path / "gap.csv"
    gap.write_text("\n".join([*lines[:50], *lines[60:]]))
    assert run(["resimulate", str(gap), "--vehicle", "truck_trailer"]) == 2
    assert "time: expected one sample a step, from 0 s on" in capsys.readouterr().err
