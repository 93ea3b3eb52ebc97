"""The project speaks plain English: sentences that had to be read twice have not come back."""

import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
HARD_TO_READ = (
    "are due at a timer's tick is asked",
    "is given up, counted and said",
    "which the executor may only come to",
    "What of a sample no vehicle could do",
    "What the lead unit has turned",
    "needs to go on from this instant",
    "refused, its stamp is not of now",
    "stamps that are not of now",
    "of the manoeuvre, rad; nan: its own",
    "set while running, it is below",
    "a longer line is none of a log",
    "does not say where it was made",
    "Of a parent that was killed",
    "What was eased for stops",
    "steps given up",
    "first_parting",
)
"""Each in favour of a sentence with subject, verb and the word of the field."""


@pytest.mark.skipif(not (ROOT / ".git").exists(), reason="needs the files of a checkout")
@pytest.mark.parametrize("words", HARD_TO_READ)
def test_a_sentence_that_was_hard_to_read_is_gone(words: str) -> None:
    command = ["git", "grep", "-lI", "--fixed-strings", words, "--", ".", ":!test/test_language.py"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.stdout == ""
