from pathlib import Path

import pytest

from yawdamp_ros.cli import run
from yawdamp_ros.logs.errors import LogError
from yawdamp_ros.logs.room import check_room, size_of_run


@pytest.mark.parametrize("name", ["run", "run.csv"])
@pytest.mark.parametrize("model, wheels", [("consistent", 0), ("nonlinear", 14)])
def test_the_size_of_a_run_is_estimated_within_a_factor_of_two(
    name: str, model: str, wheels: int, tmp_path: Path
) -> None:
    options = ["--manoeuvre", "sine", "--amplitude", "0.01", "--duration", "30", "--sample-period", "0.01"]
    options += ["--model", model]
    assert run(["simulate", *options, "--output", str(tmp_path / name)]) == 0
    paths = [tmp_path / name] if name.endswith(".csv") else list((tmp_path / name).glob("*.mcap"))
    size = sum(path.stat().st_size for path in paths)
    assert 0.5 < size_of_run(3001, 3, wheels, csv=name.endswith(".csv")) / size < 2.0


def test_a_run_that_a_disk_has_no_room_for_is_refused(tmp_path: Path) -> None:
    check_room(tmp_path / "new" / "run", 1000, 3)
    with pytest.raises(LogError, match=r"GB to write, and .* GB free"):
        check_room(tmp_path / "new" / "run", 10**15, 3)
