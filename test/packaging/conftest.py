"""A copy of the sources, which every kind of installation is made from."""

import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="session")
def source(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of what git tracks, so that builds leave nothing in the checkout."""
    copy = tmp_path_factory.mktemp("workspace") / "src" / "yawdamp_ros"
    copy.mkdir(parents=True)
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True)
    files = listed.stdout.split("\0")[:-1]
    subprocess.run(["cp", "--parents", "-P", *files, copy], cwd=ROOT, check=True)
    return copy
