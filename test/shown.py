"""Pages that show commands with what they print."""

import importlib.util
import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[1] / "docs"


def shown(page: str) -> list[tuple[str, str]]:
    """Commands of a page of docs, each with the output below it."""
    text = (DOCS / page).read_text(encoding="utf-8")
    found = re.findall(r"```console\n\$ (.+)\n([^`]*)```", text)
    assert len(found) == text.count("```console")
    return found


def differences_of() -> Callable[[str, str], list[str]]:
    """How `docs/reproduce.py` compares texts with numbers in them."""
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(DOCS))
        spec = importlib.util.spec_from_file_location("reproduce", DOCS / "reproduce.py")
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
    return module.differences


def printed(command: str) -> str:
    """What a command prints where the package is installed, without blanks at the ends of lines."""
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        ["bash", "-c", command],
        cwd=DOCS.parent,
        env={**os.environ, "PATH": path},
        capture_output=True,
        text=True,
        check=False,
        timeout=100,
    )
    assert done.stderr == ""
    return "".join(f"{line.rstrip()}\n" for line in done.stdout.splitlines())
