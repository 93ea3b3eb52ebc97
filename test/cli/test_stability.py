"""The command `stability`: what scripts and people read of it."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from yawdamp_ros.cli import run

PUBLISHED = ["stability", "--vehicle", "interlink", "--model", "published"]
TRAILER_2_REARWARD = [
    *("--set", "units.2.front_hitch=5.645"),
    *("--set", "units.2.axles.0.position=-2.205"),
    *("--set", "units.2.axles.1.position=-3.605"),
    *("--speed", "22.2"),
]


def answer(capsys: pytest.CaptureFixture[str], *arguments: str, status: int = 0) -> dict[str, object]:
    assert run([*arguments, "--format", "json"]) == status
    captured = capsys.readouterr()
    assert captured.err == ""
    return json.loads(captured.out)


def test_published_interlink_gives_table_6(capsys: pytest.CaptureFixture[str]) -> None:
    report = answer(capsys, *PUBLISHED, "--speed", "22.22222222222222")
    assert report["stable"] is True
    eigenvalues = [mode["eigenvalue"] for mode in report["modes"]]
    assert [[round(part, 4) for part in pair] for pair in eigenvalues] == [
        [-5.7256, 23.2396],
        [-5.7256, -23.2396],
        [-2.3315, 1.3318],
        [-2.3315, -1.3318],
        [-0.1135, 0],
        [-0.0917, 0],
    ]
    assert [round(mode["damping_ratio"], 5) for mode in report["modes"]] == [
        *(0.23922, 0.23922, 0.86833, 0.86833, 1, 1)
    ]


def test_published_interlink_with_trailer_2_s_cg_rearward_is_unstable(
    capsys: pytest.CaptureFixture[str],
) -> None:
    report = answer(capsys, *PUBLISHED, *TRAILER_2_REARWARD, status=1)
    assert report["stable"] is False
    real, imaginary = report["modes"][0]["eigenvalue"]
    assert (round(real, 2), round(imaginary, 1)) == (1.46, 23.8)


def test_json_holds_what_the_contract_lists(capsys: pytest.CaptureFixture[str]) -> None:
    report = answer(capsys, "stability", "--vehicle", "truck_trailer")
    assert report["vehicle"] == "truck_trailer"
    assert report["model"] == "consistent"
    assert report["speed"] == 20.0
    assert report["state_names"] == [
        *("truck/lateral_velocity", "truck/yaw_rate", "trailer/yaw_rate", "articulation_1")
    ]
    assert len(report["state_matrix"]) == len(report["input_matrix"]) == len(report["modes"]) == 4
    assert set(report["modes"][0]) >= {
        *("eigenvalue", "damping_ratio", "undamped_frequency", "damped_frequency")
    }
    assert report["understeer_gradient"] == pytest.approx(0.0012792153, abs=1e-10)
    assert report["critical_speed"] is None


def test_speed_below_which_the_published_model_is_unstable_is_no_critical_speed(
    capsys: pytest.CaptureFixture[str],
) -> None:
    report = answer(capsys, *PUBLISHED)
    assert report["critical_speed"] is None
    (boundary,) = report["stability_boundaries"]
    assert boundary["value"] == pytest.approx(12.2, abs=0.05)
    assert (boundary["unstable"], boundary["kind"]) == ("below", "oscillatory")
    assert run(PUBLISHED) == 0
    assert "none reached by speeding up; unstable below 12.2302 m/s" in capsys.readouterr().out


def test_text_tells_modes_by_the_units_that_move(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["stability"]) == 0
    text = capsys.readouterr().out
    assert "interlink, consistent model, 22.2222 m/s, stable" in text
    assert "truck + trailer_1 + trailer_2" in text
    assert "understeer gradient   0.004747 rad/(m/s2) (2.6671 deg/g)" in text
    assert "none: stable at every speed from 0.5 to 70 m/s" in text


def test_critical_speed_of_an_oversteering_car_in_words(capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["--vehicle", "single_vehicle", "--set", "units.0.axles.1.cornering_stiffness=4e4"]
    assert run(["stability", *arguments, "--speed", "50"]) == 1
    text = capsys.readouterr().out
    assert "50 m/s, UNSTABLE" in text
    assert "(a real root crosses)" in text
    assert "unstable above" in text


def test_piped_text_is_whole_and_plain() -> None:
    command = [sys.executable, "-m", "yawdamp_ros", "stability", "--vehicle", "a_double"]
    text = subprocess.run(command, capture_output=True, text=True, check=True, timeout=60).stdout
    assert "\x1b" not in text
    assert "…" not in text
    assert "semitrailer_2/lateral_acceleration" in text


def test_transfer_function_to_an_output(capsys: pytest.CaptureFixture[str]) -> None:
    report = answer(capsys, "stability", "--output", "trailer_2/yaw_rate")
    function = report["transfer_function"]
    assert function["output"] == "trailer_2/yaw_rate"
    assert function["static_gain"] == pytest.approx(report["static_gains"]["truck/yaw_rate"])
    assert len(function["poles"]) == 6
    assert len(function["zeros"]) == 5
    assert run(["stability", "--output", "trailer_2/yaw_rate"]) == 0
    assert "Transfer function from steer angle to trailer_2/yaw_rate" in capsys.readouterr().out


def test_varied_stiffness_finds_the_published_boundary(capsys: pytest.CaptureFixture[str]) -> None:
    keys = "units.0.axles.1.cornering_stiffness,units.0.axles.2.cornering_stiffness"
    arguments = ["--speed", "22.22222222222222", "--vary", f"{keys}=2e5:6e5:5"]
    report = answer(capsys, *PUBLISHED, *arguments)
    assert report["keys"] == keys.split(",")
    assert report["values"] == [2e5, 3e5, 4e5, 5e5, 6e5]
    assert [len(row) for row in report["eigenvalues"]] == [6] * 5
    (boundary,) = report["stability_boundaries"]
    assert round(boundary["value"], -2) == 301.7e3
    assert run([*PUBLISHED, *arguments]) == 0
    text = capsys.readouterr().out
    assert "unstable below 301685 (a real root crosses)" in text


def test_varied_speed_without_a_boundary_says_so(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["stability", "--vary", "speed=5:35:3"]) == 0
    assert "stable all the way from 5 to 35" in capsys.readouterr().out


def test_locus_is_drawn(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    picture = tmp_path / "locus.svg"
    assert run(["stability", "--vary", "speed=5:35:3", "--plot", str(picture)]) == 0
    assert capsys.readouterr().err == ""
    assert picture.read_text(encoding="utf-8").lstrip().startswith("<?xml")


def test_classic_pictures_are_drawn(tmp_path: Path) -> None:
    pytest.importorskip("control")
    names = {"--bode": "b.png", "--nyquist": "n.png", "--root-locus": "r.svg"}
    options = [text for option, name in names.items() for text in (option, str(tmp_path / name))]
    assert run(["stability", "--output", "trailer_2/lateral_acceleration", *options]) == 0
    assert {path.name for path in tmp_path.iterdir()} == set(names.values())


@pytest.mark.parametrize("picture", ["--bode", "--nyquist", "--root-locus"])
def test_without_python_control_the_error_names_the_extra(
    picture: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "control", None)
    assert run(["stability", picture, str(tmp_path / "x.png")]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.count("\n") == 1
    assert "pip install 'yawdamp_ros[analysis]'" in captured.err


@pytest.mark.parametrize(
    "arguments, said",
    [
        (["--output", "truck/roll"], "output: 'truck/roll': expected one of truck/lateral_velocity"),
        (["--vary", "speed=5:35"], "speed=5:35: expected KEY=A:B:N"),
        (["--vary", "speed=5:35:1"], "expected KEY=A:B:N"),
        (["--vary", "speed=5:nan:3"], "expected KEY=A:B:N"),
        (["--vary", "=5:35:3"], "expected KEY=A:B:N"),
        (["--vary", "units.7.mass=5:35:3"], "units.7.mass: no such key to set"),
        (["--vary", "speed=0:35:3"], "speed: 0.0: expected a speed in m/s"),
        (["--plot", "x.png"], "--plot: it draws what --vary gives"),
        (["--vary", "speed=5:35:3", "--output", "articulation_1"], "--vary: not together with --output"),
        (["--vary", "speed=5:35:3", "--plot", "x.gif"], "x.gif: expected a name ending in .png or .svg"),
        (["--vehicle", "a_double", "--model", "published"], "model: published: a_double has 4 units"),
    ],
)
def test_wrong_use_is_one_line_and_status_2(
    arguments: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["stability", *arguments]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.count("\n") == 1
    assert said in captured.err
