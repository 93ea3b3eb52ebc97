"""Progress of commands, on standard error."""

from collections.abc import Callable, Iterator, Sequence

from rich.console import Console
from rich.progress import (
    BarColumn,
    Progress,
    ProgressColumn,
    Task,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)
from rich.text import Text


class _Done(ProgressColumn):
    """Progress: amount done and, if known, the total."""

    def __init__(self, unit: str) -> None:
        super().__init__()
        self._unit = unit
        self._digits = 1 if unit == "s" else 0

    def render(self, task: Task) -> Text:
        total = "" if task.total is None else f" / {task.total:.{self._digits}f}"
        return Text(f"{task.completed:.{self._digits}f}{total} {self._unit}")


def progress_bar(unit: str = "s") -> Progress:
    """Progress bar on standard error; silent without a terminal."""
    console = Console(stderr=True)
    # Needed besides `disable`: rich before 14 ends a disabled bar with an empty line.
    console.quiet = not console.is_terminal
    return Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        _Done(unit),
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
