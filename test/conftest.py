"""What all tests share."""

import sys
from pathlib import Path

from hypothesis import settings

sys.path.insert(0, str(Path(__file__).parent))

# The same examples every time: a check that fails now and then is no check of a commit.
settings.register_profile("repeatable", derandomize=True, deadline=None)
settings.load_profile("repeatable")
