"""What fuzzing kept, read again: each file is taken, or refused in one line that names it."""

from pathlib import Path

import pytest

from faults.targets import CORPUS, TARGETS, judge

pytestmark = pytest.mark.timeout(60)


@pytest.mark.parametrize("target", TARGETS)
def test_what_fuzzing_kept_is_taken_or_refused_in_one_line(target: str, tmp_path: Path) -> None:
    kept = sorted((CORPUS / target).iterdir())
    assert kept
    for path in kept:
        judge(target, path.read_bytes(), tmp_path)
