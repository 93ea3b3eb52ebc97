"""The place of the machine code."""

import logging
from pathlib import Path

import pytest

from yawdamp_ros.nonlinear import compiled

find_directory = compiled.cache_directory.__wrapped__


def test_it_is_kept_beside_the_modules_by_a_digest_of_them() -> None:
    directory = find_directory()
    assert directory.parent == Path(compiled.__file__).parent / "__pycache__"
    assert directory == find_directory()


def test_what_cannot_be_written_there_goes_to_the_users_cache(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(compiled, "__file__", "/dev/null/compiled.py")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert find_directory().parent == tmp_path / "yawdamp_ros"


def test_where_nothing_can_be_written_that_is_said_and_it_goes_on(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr(compiled, "__file__", "/dev/null/compiled.py")
    monkeypatch.setenv("XDG_CACHE_HOME", "/dev/null")
    with caplog.at_level(logging.WARNING):
        assert find_directory() is None
    assert len(caplog.records) == 1
    assert "no cache can be written" in caplog.text
    monkeypatch.setattr(compiled, "cache_directory", lambda: None)

    def twice(value: float) -> float:
        return 2.0 * value

    assert compiled.compiled(twice)(1.5) == 3.0


def test_a_first_compilation_is_announced_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    announce = compiled.announce_compilation.__wrapped__
    monkeypatch.setattr(compiled, "cache_directory", lambda: tmp_path)
    announce()
    assert caplog.messages == ["the nonlinear model is compiled for its first use here: half a minute"]
    (tmp_path / "chain.nbi").touch()
    announce()
    assert len(caplog.records) == 1
