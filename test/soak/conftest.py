"""What the long tests share."""

from collections.abc import Callable

import pytest


@pytest.fixture
def say(capsys: pytest.CaptureFixture[str]) -> Callable[[str], None]:
    """Print a line past pytest's capture."""

    def shown(text: str) -> None:
        with capsys.disabled():
            print(f"\n  {text}", flush=True)

    return shown
