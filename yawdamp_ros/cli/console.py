"""Progress of commands, on standard error."""

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.progress import Progress


def progress_bar(unit: str = "s") -> "Progress":
    """Progress bar on standard error; silent without a terminal."""
    # Imported here: help shows no progress.
    from rich.console import Console  # noqa: PLC0415
    from rich.progress import (  # noqa: PLC0415
        BarColumn,
        Progress,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    from yawdamp_ros.cli.progress_column import Done  # noqa: PLC0415

    console = Console(stderr=True)
    # Needed besides `disable`: rich before 14 ends a disabled bar with an empty line.
    console.quiet = not console.is_terminal
    return Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        Done(unit),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
        console=console,
        disable=not console.is_terminal,
        transient=True,
    )


def progress_of(description: str) -> Callable[[Sequence[float]], Iterator[float]]:
    """Return an iterator over values that shows its progress, as `progress_bar` does."""

    def progress(values: Sequence[float]) -> Iterator[float]:
        with progress_bar("values") as bar:
            yield from bar.track(values, description=description)

    return progress
