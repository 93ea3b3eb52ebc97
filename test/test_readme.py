"""What the README says is what the project does."""

import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from ruamel.yaml import YAML

import parameter_table
from yawdamp_ros import load_vehicle, simulate
from yawdamp_ros.cli.dispatch import COMMANDS
from yawdamp_ros.manoeuvres import LaneChange
from yawdamp_ros.share import share_directory
from yawdamp_ros.simulation.settings import PARAMETERS, SimParameters
from yawdamp_ros.vehicle import builtin_vehicles, parse_vehicle

README = (Path(__file__).parents[1] / "README.md").read_text(encoding="utf-8")


def test_the_tables_of_parameters_and_outputs_are_those_of_the_declarations() -> None:
    assert parameter_table.readme(README) == README
    assert README.count(parameter_table.HEAD) == README.count(parameter_table.OUTPUT_HEAD) == 1


def flat(parameters: dict[str, Any], prefix: str = "") -> dict[str, Any]:
    """Parameters as the node names them, groups joined by dots."""
    found: dict[str, Any] = {}
    for name, value in parameters.items():
        found |= flat(value, f"{prefix}{name}.") if isinstance(value, dict) else {prefix + name: value}
    return found


def test_the_parameter_file_is_that_of_the_declarations() -> None:
    text = (share_directory() / "config" / "sim.yaml").read_text(encoding="utf-8")
    assert text == parameter_table.parameter_file()
    given = flat(YAML(typ="safe", pure=True).load(text)["/**"]["ros__parameters"])
    defaults = {
        name: getattr(SimParameters(), declared.name)
        for name, declared in PARAMETERS.items()
        if not declared.metadata["otherwise"]
    }
    assert list(given) == list(defaults)
    for name, default in defaults.items():
        both_nan = isinstance(default, float) and math.isnan(default) and math.isnan(given[name])
        assert both_nan or (given[name], type(given[name])) == (default, type(default)), name


def test_the_peaks_shown_are_those_of_the_run() -> None:
    response = simulate(load_vehicle("interlink"), LaneChange(amplitude=0.018), 15.0, sample_period=0.01)
    for index, unit in enumerate(response.unit_names):
        yaw, rate, acceleration = (
            np.abs(values[:, index]).max()
            for values in (response.yaw, response.yaw_rate, response.lateral_acceleration)
        )
        assert re.search(rf"│ {unit} +│ +{yaw:.4f} │ +{rate:.4f} │ +{acceleration:.3f} │", README)


@pytest.mark.parametrize("name", [*COMMANDS, *builtin_vehicles()])
def test_every_command_and_builtin_is_named(name: str) -> None:
    assert f"`{name}`" in README or f"`{name} " in README


def test_the_vehicle_shown_is_valid() -> None:
    (shown,) = re.findall(r"```yaml\n(.*?)```", README, re.DOTALL)
    assert parse_vehicle(shown, "README.md").unit_names == ("truck", "trailer")


def test_the_library_example_runs() -> None:
    (shown,) = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
    scope: dict[str, object] = {}
    exec(shown, scope)  # noqa: S102 - the README's own lines
    assert {"model", "response"} <= set(scope)


def test_make_sim_drives_one_lane_within_the_linear_range() -> None:
    makefile = (Path(__file__).parents[1] / "Makefile").read_text(encoding="utf-8")
    (amplitude,) = re.findall(r"--manoeuvre lane_change --amplitude ([\d.]+) --duration 15", makefile)
    response = simulate(load_vehicle("interlink"), LaneChange(amplitude=float(amplitude)), 15.0)
    assert response.y[-1] == pytest.approx([3.5] * 3, abs=0.05)
    assert np.abs(response.lateral_acceleration).max() < 2.0
