"""Coverage-guided fuzzing of what reads files, for a minute each: `make soak`. Each says what it saw."""

import re
import subprocess
import sys
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path

import pytest

from faults.targets import CORPUS, TARGETS

pytestmark = [
    pytest.mark.timeout(3600),
    pytest.mark.skipif(find_spec("atheris") is None, reason="it has no wheels for this Python"),
]

SECONDS = 60
FUZZ = Path(__file__).parents[1] / "faults" / "fuzz.py"


@pytest.mark.parametrize("target", TARGETS)
def test_a_minute_of_fuzzing_finds_nothing(target: str, tmp_path: Path, say: Callable[[str], None]) -> None:
    found, corpus = tmp_path / "found", CORPUS / target
    found.mkdir()
    limits = [f"-max_total_time={SECONDS}", "-timeout=20", "-rss_limit_mb=3000", "-max_len=20000"]
    done = subprocess.run(
        [sys.executable, str(FUZZ), target, str(found), str(corpus), *limits, "-print_final_stats=1"],
        capture_output=True,
        text=True,
        errors="replace",
        check=False,
        cwd=tmp_path,
    )
    said = done.stdout + done.stderr
    executed = re.search(r"number_of_executed_units: (\d+)", said)
    finds = [path.name for path in tmp_path.iterdir() if path != found]
    say(
        f"{target}: {executed[1] if executed else 'unknown how many'} files in {SECONDS} s, "
        f"from {len(list(corpus.iterdir()))} kept, {len(list(found.iterdir()))} of them new ways through, "
        f"{len(finds)} finds"
    )
    assert done.returncode == 0, said[-5000:]
    assert executed is not None
    assert int(executed[1]) > len(list(corpus.iterdir()))
    assert not finds
