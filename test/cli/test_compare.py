"""`compare` and `identify` as users call them."""

import json
from pathlib import Path

import numpy as np
import pytest

from made_drives import TRUTH, made_drive
from yawdamp_ros.cli import run
from yawdamp_ros.drives import Drive


def written(tmp_path: Path, drive: Drive) -> str:
    """CSV of a drive, all of whose channels have the same times."""
    path = tmp_path / "drive.csv"
    columns = [channel.values for channel in drive.channels.values()]
    table = np.column_stack([drive["steering"].times, *columns])
    np.savetxt(
        path, table, delimiter=",", header=",".join(["time", *drive.channels]), comments="", fmt="%.17g"
    )
    return str(path)


@pytest.fixture(scope="module")
def drive() -> Drive:
    return made_drive("truck_trailer", 7, 60.0)


def test_compare_tells_each_channel_in_eighty_columns(
    tmp_path: Path, drive: Drive, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["compare", written(tmp_path, drive), "--vehicle", "truck_trailer"]) == 0
    printed = capsys.readouterr()
    assert printed.err == ""
    lines = printed.out.splitlines()
    assert "  speed: column speed, 6001 samples, 100 Hz, " in printed.out
    assert "│ trailer a_y, m/s²" in printed.out
    assert "Excitation: 60.0 s at 1" in printed.out
    tables = [line for line in lines if line[:1] in "┏┃┡│└" and line]
    assert max(len(line.rstrip()) for line in tables) <= 80


def test_compare_in_json_holds_what_the_table_shows(
    tmp_path: Path, drive: Drive, capsys: pytest.CaptureFixture[str]
) -> None:
    path = written(tmp_path, drive)
    page = tmp_path / "page.html"
    arguments = ["--vehicle", "truck_trailer", "--format", "json", "--html", str(page)]
    assert run(["compare", path, *arguments]) == 0
    assert '"verdict": "R2 of simulated against measured: 0.' in page.read_text(encoding="utf-8")
    record = json.loads(capsys.readouterr().out)
    assert [channel["output"] for channel in record["channels"]] == [
        "truck/yaw_rate",
        "trailer/yaw_rate",
        "truck/lateral_acceleration",
        "trailer/lateral_acceleration",
    ]
    first = record["channels"][0]
    assert first["unit"] == "rad/s"
    assert first["samples"] == 6001
    assert len(first["coherence"]["frequency"]) == len(first["coherence"]["value"]) > 100
    assert record["excitation"]["steering_rms"] == pytest.approx(0.02, rel=0.3)


def test_a_run_takes_the_place_of_the_model(
    tmp_path: Path, drive: Drive, capsys: pytest.CaptureFixture[str]
) -> None:
    path, simulated = written(tmp_path, drive), str(tmp_path / "run.csv")
    arguments = ["--vehicle", "truck_trailer", "--speed", "17"]
    assert run(["simulate", "--log", path, *arguments, "--sample-period", "0.01", "--output", simulated]) == 0
    capsys.readouterr()
    records = []
    for options in ([], ["--run", simulated]):
        assert run(["compare", path, *arguments, *options, "--format", "json"]) == 0
        records.append(json.loads(capsys.readouterr().out))
    assert records[1]["against"] == f"the run {simulated}"
    for model, recorded in zip(records[0]["channels"], records[1]["channels"], strict=True):
        # They begin alike but for the first second: a run starts from rest.
        assert recorded["r_squared"] == pytest.approx(model["r_squared"], abs=0.02)


@pytest.mark.parametrize(
    "arguments, problem",
    [
        (["--run", "none.csv"], "none.csv: cannot be read: No such file"),
        (["--channel", "spin=x"], "spin=x: expected CHANNEL=PLACE"),
        (["--topic", "/steering"], "is a table and has none"),
    ],
)
def test_wrong_use_is_one_line(
    tmp_path: Path, drive: Drive, arguments: list[str], problem: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["compare", written(tmp_path, drive), "--vehicle", "truck_trailer", *arguments]) == 2
    errors = capsys.readouterr().err
    assert problem in errors
    assert errors.count("\n") == 1


def test_identify_tells_values_intervals_and_the_vehicle(
    tmp_path: Path, drive: Drive, capsys: pytest.CaptureFixture[str]
) -> None:
    path, page = written(tmp_path, drive), tmp_path / "page.html"
    arguments = ["identify", path, "--vehicle", "truck_trailer"]
    assert run([*arguments, "--html", str(page), "--format", "json"]) == 0
    record = json.loads(capsys.readouterr().out)
    found = {each["name"]: each for each in record["parameters"]}
    for name, truth in TRUTH.items():
        assert found[name]["value"] == pytest.approx(truth, rel=0.15)
        assert found[name]["low"] < found[name]["value"] < found[name]["high"]
    assert record["overrides"][0].startswith("units.0.yaw_inertia=")
    assert record["checked"][0]["r_squared"] > 0.95
    text = page.read_text(encoding="utf-8")
    assert "The part kept to check" in text
    assert '"verdict": "The drive determines stiffness, inertia, steering offset. R2 on the part' in text
    assert run(arguments) == 0
    printed = capsys.readouterr().out
    assert "│ stiffness" in printed
    assert "  --set units.1.yaw_inertia=" in printed
    assert max(len(line.rstrip()) for line in printed.splitlines() if line[:1] in "┏┃┡│└" and line) <= 80


def test_identify_ends_with_status_1_where_a_parameter_is_not_seen(
    tmp_path: Path, drive: Drive, capsys: pytest.CaptureFixture[str]
) -> None:
    straight = drive.steered_by(1e4)
    arguments = ["identify", written(tmp_path, straight), "--vehicle", "truck_trailer", "--fit", "inertia"]
    assert run(arguments) == 1
    assert "warning: inertia cannot be seen in this drive" in capsys.readouterr().err
