"""The examples in process: what each shows, in figures."""

import importlib.util
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

EXAMPLES = Path(__file__).parents[2] / "examples"


def example(name: str) -> ModuleType:
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # dataclasses look it up there
    spec.loader.exec_module(module)
    return module


def test_yaw_damping_takes_a_fifth_off_an_a_double_s_amplification_and_locks_no_wheel(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    damping = example("yaw_damping")
    assert damping.main(["--output", str(tmp_path / "picture.png")]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == len(damping.CASES) + 1
    assert (tmp_path / "picture.png").stat().st_size > 10_000
    for name, vehicle, amplitude, friction in damping.CASES[:2]:
        plain, damped = damping.compare(vehicle, amplitude, friction)
        assert damped.amplification < 0.8 * plain.amplification, name
        assert damped.distance_from(plain) < 0.15, name
        assert not [event for event in damped.events if "lock" in event], name
    swaying = damping.CASES[2][1]
    ratios = [damping.drive(swaying, damping.SMALL, damped=damped).damping_ratio for damped in (False, True)]
    assert ratios[0] < 0.05
    assert ratios[1] > 0.2


def test_without_abs_wheels_lock_and_the_rig_leaves_its_bend(tmp_path: Path) -> None:
    braking = example("emergency_braking")
    assert braking.main(["--output", str(tmp_path / "picture.png")]) == 0
    kept, lost = braking.brake(abs_=True), braking.brake(abs_=False)
    assert kept.locked == []
    assert len(lost.locked) == 12
    assert kept.off < 0.5
    assert lost.off > 2.0
    assert any("trailer_swing" in event for event in lost.events)
    # 0.3 g at most, and four fifths of it with ABS, whatever is demanded.
    assert lost.distance > 15.0**2 / (2.0 * 0.3 * 9.81) - 2.0
    assert kept.distance == pytest.approx(15.0**2 / (2.0 * 0.8 * 0.3 * 9.81), rel=0.05)


def test_a_semitrailer_is_backed_into_its_bay(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    docking = example("docking")
    assert docking.main(["--output", str(tmp_path / "picture.png")]) == 0
    assert "beside the bay's axis" in capsys.readouterr().out
    done = docking.dock(speed=-2.5)
    assert abs(done.aside) < 0.1
    assert abs(done.heading) < 0.01
    assert abs(done.depth) < 0.1
    assert done.largest_articulation < 0.5
    assert np.ptp(done.path[-10:, :, :2], axis=0).max() < 2e-3  # it comes to rest
