from pathlib import Path

import pytest

from yawdamp_ros.nodes.parameter_files import misfit, parameter_files

VALUES = "{ros__parameters: {speed: 20.0}}"


def test_the_files_are_those_behind_the_option() -> None:
    arguments = ["--ros-args", "--params-file", "a.yaml", "-p", "speed:=20.0", "--params-file", "b.yaml"]
    assert parameter_files(arguments) == [Path("a.yaml"), Path("b.yaml")]


@pytest.mark.parametrize(
    "text",
    [
        f"/**: {VALUES}",
        f"/left/yawdamp_sim: {VALUES}",
        f"left: {{yawdamp_sim: {VALUES}}}",
        f"/*/yawdamp_sim: {VALUES}",
        f"/**/yawdamp_sim: {VALUES}",
        f"other: {VALUES}\n/**: {VALUES}",
        "",
        "a: [",
    ],
)
def test_a_file_with_a_key_that_fits_is_no_misfit(tmp_path: Path, text: str) -> None:
    path = tmp_path / "file.yaml"
    path.write_text(text)
    assert misfit(path, "/left/yawdamp_sim") == ""


@pytest.mark.parametrize("key", ["yawdamp_sim", "/yawdamp_sim", "/right/yawdamp_sim", "/*", "/left"])
def test_a_file_whose_keys_are_of_other_nodes_is_named_with_them(tmp_path: Path, key: str) -> None:
    path = tmp_path / "file.yaml"
    path.write_text(f"{key}: {VALUES}")
    said = misfit(path, "/left/yawdamp_sim")
    assert said.startswith(f"{path}: none of its parameters is for /left/yawdamp_sim: ")
    assert said.endswith(f"its keys are /{key.strip('/')}; expected /**")
