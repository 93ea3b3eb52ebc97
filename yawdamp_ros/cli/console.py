"""What commands show: tables on standard output, progress on standard error."""

import sys
from collections.abc import Sequence

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
from rich.table import Table
from rich.text import Text

PIPE_WIDTH = 200
"""Columns of a table that goes to a pipe or a file, which has no edge."""


def print_table(title: str, columns: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Print a table; the first column is text, the others are numbers."""
    table = Table(title=Text(title), title_justify="left")
    for index, column in enumerate(columns):
        table.add_column(Text(column), justify="right" if index else "left", no_wrap=True)
    for row in rows:
        table.add_row(*map(Text, row))
    Console(width=None if sys.stdout.isatty() else PIPE_WIDTH).print(table)


class _Done(ProgressColumn):
    """How much is done and, where it is known, of how much."""

    def __init__(self, unit: str) -> None:
        super().__init__()
        self._unit = unit
        self._digits = 1 if unit == "s" else 0

    def render(self, task: Task) -> Text:
        total = "" if task.total is None else f" / {task.total:.{self._digits}f}"
        return Text(f"{task.completed:.{self._digits}f}{total} {self._unit}")


def progress_bar(unit: str = "s") -> Progress:
    """A progress bar on standard error; silent where that is no terminal."""
    console = Console(stderr=True)
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
