"""The command `assess`: what scripts and people read of it."""

import json
from collections.abc import Sequence
from pathlib import Path

import pytest

from yawdamp_ros.analysis import MEASURES, load_scheme
from yawdamp_ros.cli import run


def answer(
    capsys: pytest.CaptureFixture[str], *arguments: str, status: int = 0, warnings: Sequence[str] = ()
) -> dict[str, dict[str, object]]:
    assert run(["assess", *arguments, "--format", "json"]) == status
    captured = capsys.readouterr()
    assert captured.err.splitlines() == list(warnings)
    return {row["measure"]: row for row in json.loads(captured.out)}


def test_json_is_a_list_of_what_the_contract_names(capsys: pytest.CaptureFixture[str]) -> None:
    rows = answer(capsys)
    assert list(rows) == list(MEASURES)
    for row in rows.values():
        assert list(row) == ["measure", "value", "unit", "level", "pass", "definition"]
    assert rows["least_damping_ratio"]["value"] == pytest.approx(0.658, abs=5e-4)
    assert rows["least_damping_ratio"]["pass"] is True
    assert rows["critical_speed"]["value"] is None
    assert rows["rearward_amplification_steer_axle"]["pass"] is None
    assert "at 24.4444 m/s" in rows["rearward_amplification"]["definition"]


def test_status_is_1_where_a_level_is_failed(capsys: pytest.CaptureFixture[str]) -> None:
    rows = answer(capsys, "--vehicle", "a_double", status=1)
    assert rows["high_speed_transient_offtracking"]["pass"] is False
    assert [name for name, row in rows.items() if row["pass"] is False] == [
        "high_speed_transient_offtracking"
    ]


def test_rollover_threshold_is_an_input(capsys: pytest.CaptureFixture[str]) -> None:
    assert answer(capsys, "--srt", "0.35")["rearward_amplification_steer_axle"]["pass"] is True


def test_speed_model_and_changes_are_those_of_every_command(capsys: pytest.CaptureFixture[str]) -> None:
    slow = answer(capsys, "--speed", "10", "--set", "units.2.mass=20000")
    assert all("at 10 m/s" in row["definition"] for row in slow.values())
    published = answer(capsys, "--model", "published")
    assert published["rearward_amplification"]["value"] is None
    assert "cannot be held on a lane change" in published["rearward_amplification"]["definition"]


def test_text_gives_value_unit_verdict_and_level(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["assess", "--vehicle", "a_double", "--srt", "0.3", "--definitions"]) == 1
    lines = capsys.readouterr().out.splitlines()

    def cells(measure: str) -> list[str]:
        (line,) = (line for line in lines if line.startswith(f"│ {measure} "))
        return [cell.strip() for cell in line.strip("│").split("│")]

    assert cells("high_speed_transient_offtracking")[1:5] == ["1.018", "m", "24.44", "FAIL"]
    assert cells("yaw_damping_coefficient")[4:] == ["pass", "PBS: >= 0.15"]
    assert cells("rearward_amplification_steer_axle")[4] == "FAIL"
    assert any(line.startswith("understeer gradient: ") and line.endswith("deg/g") for line in lines)
    assert "Definitions; levels are from secondary sources" in lines


def test_text_says_where_a_measure_is_ambiguous(capsys: pytest.CaptureFixture[str]) -> None:
    stiffness = [f"units.0.axles.{axle}.cornering_stiffness=3.236e5" for axle in (1, 2)]
    stiffness += [f"units.3.axles.{axle}.cornering_stiffness=2.671e4" for axle in range(3)]
    options = [part for change in stiffness for part in ("--set", change)]
    said = "ambiguous: yaw_damping_coefficient could be read as 0.1225 to 0.444, on either side of its level"
    assert run(["assess", "--vehicle", "a_double", *options]) == 1
    assert said in capsys.readouterr().out.splitlines()
    soft = (
        "warning: a_double: units.3.axles.0: cornering stiffness 26710 N/rad, "
        "0.4 times the axle's load per rad: "
        "expected 2 to 12; is it in kgf/rad, or the tyre load in kg? (2 more like it)"
    )
    found = answer(capsys, "--vehicle", "a_double", *options, status=1, warnings=[soft])
    row = found["yaw_damping_coefficient"]
    assert row["pass"] is False
    assert said in row["definition"]


def test_text_says_why_there_is_no_value(capsys: pytest.CaptureFixture[str]) -> None:
    unstable = ["--set", "units.0.axles.1.cornering_stiffness=3e4", "--speed", "40"]
    assert run(["assess", "--vehicle", "single_vehicle", *unstable]) == 1
    text = capsys.readouterr().out
    assert text.count("no value: single_vehicle at 40 m/s: unstable: there is no lane change") == 1


def test_a_scheme_has_one_verdict_its_limits_and_the_level_that_is_reached(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert (
        run(["assess", "--vehicle", "a_double", "--scheme", "pbs", "--level", "2", "--format", "json"]) == 1
    )
    found = json.loads(capsys.readouterr().out)
    assert (found["scheme"], found["level"], found["verdict"], found["level_reached"]) == (
        "pbs",
        "2",
        "fail",
        None,
    )
    assert found["deciding"] == ["rearward_amplification_steer_axle", "high_speed_transient_offtracking"]
    rows = {row["measure"]: row for row in found["measures"]}
    assert list(rows) == list(load_scheme("pbs").measures)
    assert rows["low_speed_swept_path"]["limit"] == 8.7
    assert "units.3.cg_height" in found["assumed"]
    assert rows["rearward_amplification_steer_axle"]["limit"] == pytest.approx(
        5.7 * rows["rear_static_rollover_threshold"]["value"]
    )


def test_text_of_a_scheme_fits_80_columns_and_begins_with_the_verdict(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert run(["assess", "--vehicle", "a_double", "--scheme", "rtac", "--definitions"]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[1] == "FAILS rtac; decided by load_transfer_ratio, high_speed_transient_offtracking"
    assert "Sources of the limits" in lines
    assert any(line.startswith("assumed, not given by the file") for line in lines)
    assert max(map(len, lines[:9])) <= 80


def test_csv_has_a_row_for_each_measure_of_each_vehicle_in_the_units_asked_for(
    capsys: pytest.CaptureFixture[str],
) -> None:
    vehicles = ["--vehicle", "a_double", "--vehicle", "interlink"]
    assert run(["assess", *vehicles, "--scheme", "rtac", "--format", "csv", "--units", "engineering"]) == 1
    rows = [line.split(",") for line in capsys.readouterr().out.splitlines()]
    assert [row[0] for row in rows[1:]] == ["a_double"] * 4 + ["interlink"] * 4
    assert rows[2][rows[0].index("speed")] == "88.0"
    assert rows[2][rows[0].index("measure")] == "load_transfer_ratio"


@pytest.mark.filterwarnings("ignore:datetime.datetime.utcnow")  # openpyxl before 3.1.4
def test_spreadsheet_holds_the_rows_of_the_csv(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    openpyxl = pytest.importorskip("openpyxl")
    path = tmp_path / "table.xlsx"
    assert run(["assess", "--scheme", "rtac", "--format", "csv", "--xlsx", str(path)]) == 0
    written = [line.split(",") for line in capsys.readouterr().out.splitlines()]
    held = [list(row) for row in openpyxl.load_workbook(path).active.values]
    assert held[0] == written[0]
    for row, line in zip(held[1:], written[1:], strict=True):
        assert row[:3] == line[:3]
        assert row[3] == pytest.approx(float(line[3]))


def test_vehicles_stand_side_by_side(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["assess", "--vehicle", "a_double", "--vehicle", "interlink", "--scheme", "rtac"]) == 1
    text = capsys.readouterr().out
    assert "1.018!" in text
    assert "verdict, level reached" in text


@pytest.mark.parametrize(
    "arguments, said",
    [
        (["--scheme", "pbs", "--level", "5"], "level: 5: pbs: expected one of 1, 2, 3, 4"),
        (["--xlsx", "table.csv"], "--xlsx: table.csv: expected a name ending in .xlsx"),
        (["--scheme", "nowhere.yaml"], "nowhere.yaml: no such scheme; expected a file or one of"),
        (["--srt", "-1"], "srt: -1.0: expected a static rollover threshold in g"),
        (["--srt", "high"], "argument --srt: invalid float value"),
        (["--vehicle", "bicycle"], "bicycle: no such vehicle"),
        (["--speed", "0"], "speed: 0.0: expected a speed in m/s"),
        (["--scheme", "pbs", "--class", "car"], "class: car: pbs: expected one of bus, tanker"),
        (["--differences", "--class", "bus"], "--class: not with --differences"),
        (["--jobs", "2"], "--jobs: it goes with --random"),
        (["--seed", "2"], "--seed: it goes with --random"),
    ],
)
def test_wrong_use_is_one_line_and_status_2(
    arguments: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["assess", *arguments]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.count("\n") == 1
    assert said in captured.err
