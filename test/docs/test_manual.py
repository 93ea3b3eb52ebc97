"""The manual builds without a warning, and its search finds the page that one looks for."""

import re
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

pytestmark = pytest.mark.skipif(find_spec("sphinx") is None, reason="the manual needs the extra `docs`")

ROOT = Path(__file__).parents[2]
CHROMIUM = shutil.which("chromium")


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The manual, built from a copy of its sources, so that the checkout stays as it is."""
    root = tmp_path_factory.mktemp("manual")
    ignored = shutil.ignore_patterns("_build", "auto_gallery", "__pycache__")
    for name in ("bench", "config", "docs", "examples"):
        shutil.copytree(ROOT / name, root / name, ignore=ignored)
    for name in ("CHANGELOG.md", "QUALITY_DECLARATION.md"):
        shutil.copy(ROOT / name, root / name)
    built = root / "html"
    command = [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-b", "html"]
    done = subprocess.run(
        [*command, str(root / "docs"), str(built)],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
    )
    assert done.returncode == 0, done.stderr
    return built


@pytest.mark.timeout(400)
def test_every_part_is_there(site: Path) -> None:
    for part in ("tutorials", "how_to", "reference", "explanation", "auto_gallery"):
        assert (site / part / "index.html").is_file(), part


@pytest.mark.skipif(CHROMIUM is None, reason="needs chromium")
@pytest.mark.timeout(400)
@pytest.mark.parametrize(
    "words, page",
    [
        ("jackknife", "brake_on_a_slippery_road"),
        ("MCAP", "reference/files"),
        ("rearward amplification", "rearward_amplification"),
        ("pause", "set_the_pace"),
    ],
)
def test_a_search_finds_the_right_page_first(site: Path, tmp_path: Path, words: str, page: str) -> None:
    command = [
        *(str(CHROMIUM), "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"),
        *("--disable-background-networking", "--disable-component-update", "--disable-sync"),
        *("--virtual-time-budget=20000", f"--user-data-dir={tmp_path}", "--dump-dom"),
        f"file://{site}/search.html?q={words.replace(' ', '+')}",
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=100)
    first = re.search(r'<ul[^>]*class="search">.*?<a href="([^"]+)"', done.stdout, re.DOTALL)
    assert first is not None, done.stdout
    assert page in first[1]
