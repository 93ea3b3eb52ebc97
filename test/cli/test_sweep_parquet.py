"""Sweeps as Parquet: what others read of them, and that an interrupted one goes on."""

from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

from yawdamp_ros.cli import run

pytestmark = pytest.mark.skipif(find_spec("pyarrow") is None, reason="needs pyarrow, an extra")

SWEEP = ["sweep", "--random", "1100", "--range", "units.1.mass=5000:30000", "--measure", "steady_offtracking"]


def table(path: Path) -> np.ndarray:
    from pyarrow import parquet  # noqa: PLC0415 - an extra

    found = parquet.read_table(path)
    assert found.column_names == ["units.1.mass", "largest_real_part", "steady_offtracking"]
    return np.column_stack([column.to_numpy() for column in found.columns])


def test_it_holds_the_numbers_of_the_csv_file(tmp_path: Path) -> None:
    for name in ("x.csv", "x.parquet"):
        assert run([*SWEEP, "--output", str(tmp_path / name)]) == 0
    rows = np.genfromtxt(tmp_path / "x.csv", delimiter=",", skip_header=1)
    np.testing.assert_array_equal(table(tmp_path / "x.parquet"), rows)


def test_a_sweep_goes_on_from_the_parts_that_are_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("yawdamp_ros.logs.sweep_parquet.ROWS", 300)
    output = tmp_path / "x.parquet"
    assert run([*SWEEP, "--output", str(output)]) == 0
    parts = sorted(output.iterdir())
    assert [part.name for part in parts] == [f"part-{index:06}.parquet" for index in range(3)]
    whole, kept = table(output), parts[0].stat().st_mtime_ns
    for part in parts[1:]:
        part.unlink()
    (output / ".part").write_bytes(b"PAR1")  # which a killed sweep leaves
    assert run([*SWEEP, "--output", str(output)]) == 0
    np.testing.assert_array_equal(table(output), whole)
    assert parts[0].stat().st_mtime_ns == kept
    capsys.readouterr()
    assert run([*SWEEP, "--seed", "1", "--output", str(output)]) == 2
    assert "is there and is not of this sweep" in capsys.readouterr().err
    parts[0].write_bytes(b"no table")
    assert run([*SWEEP, "--output", str(output)]) == 2
    assert capsys.readouterr().err.count("\n") == 1
