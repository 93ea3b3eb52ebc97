"""Tables that fit their terminal: numbers whole, prose shortened first."""

import re
import sys
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.table import Table

PIPE_WIDTH = 200
"""Width of a table in a pipe or a file, which has none of its own."""
LEAST_PROSE = 12
"""Characters of prose that are always shown."""
FRAME = 3
"""Characters that a frame takes from each column; narrow tables have two spaces instead."""

_BREAKS = re.compile(r"(?<=_)(?=[a-z])|(?<=\+ )(?=[a-z])|(?<=   )(?=\S)|(?<=; )")
"""Places where a line may break: in names, between modes, eigenvalues and levels."""


def print_table(
    title: str,
    columns: Sequence[str],
    rows: Sequence[Sequence[str]],
    prose: Sequence[int] = (0,),
    width: int | None = None,
) -> None:
    """Print a table; where the terminal is too narrow, in several parts.

    Parameters
    ----------
    title : str
    columns : sequence of str
        Headings.
    rows : sequence of sequence of str
        Rows; the first column is text, the others are numbers.
    prose : sequence of int
        Columns that may be shortened, the first one first.
    width : int, optional
        Width in characters; the default is the terminal's, or `PIPE_WIDTH`.
    """
    # Imported here: help prints no table.
    from rich import box  # noqa: PLC0415
    from rich.console import Console  # noqa: PLC0415
    from rich.table import Table  # noqa: PLC0415
    from rich.text import Text  # noqa: PLC0415

    if width is None and not sys.stdout.isatty():
        width = PIPE_WIDTH
    console = Console(width=width)
    whole = _widths(columns, rows)
    if sum(whole) + FRAME * len(columns) < console.width:
        table = Table(title=Text(title), title_justify="left")
        _fill(table, columns, rows, prose, whole)
        console.print(table)
        return
    for part in _parts(columns, rows, prose, console.width):
        headings = [columns[index] for index in part]
        cells = [[row[index] for index in part] for row in rows]
        told = [part.index(index) for index in prose if index in part]
        table = Table(title=Text(title), title_justify="left", box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0))
        table.show_edge = False
        _fill(table, headings, cells, told, _fitted(headings, cells, told, console.width))
        console.print(table)


def _fill(
    table: "Table",
    columns: Sequence[str],
    rows: Sequence[Sequence[str]],
    prose: Sequence[int],
    widths: Sequence[int],
) -> None:
    from rich.text import Text  # noqa: PLC0415 - as above

    for index, (column, width) in enumerate(zip(columns, widths, strict=True)):
        table.add_column(Text(column), justify="right" if index else "left", width=width, overflow="ellipsis")
    for row in rows:
        table.add_row(
            *(
                Text("\n".join(_lines(cell, widths[index])) if index in prose else cell, no_wrap=True)
                for index, cell in enumerate(row)
            )
        )


def _widths(columns: Sequence[str], rows: Sequence[Sequence[str]]) -> list[int]:
    return [max(_length(column), *_lengths(rows, index)) for index, column in enumerate(columns)]


def _fitted(
    columns: Sequence[str], rows: Sequence[Sequence[str]], prose: Sequence[int], width: int
) -> list[int]:
    """Widths of columns that are shortened as far as they need to: prose, then headings."""
    widths = _widths(columns, rows)
    excess = sum(widths) + 2 * (len(columns) - 1) + 1 - width
    least = _least(columns, rows, prose)
    for index in [*prose, *(index for index in range(len(columns)) if index not in prose)]:
        cut = max(0, min(excess, widths[index] - least[index]))
        widths[index] -= cut
        excess -= cut
    return widths


def _least(columns: Sequence[str], rows: Sequence[Sequence[str]], prose: Sequence[int]) -> list[int]:
    """Least widths of columns: numbers and the words of a heading are whole."""
    words = [max(map(len, column.split()), default=0) for column in columns]
    return [
        min(LEAST_PROSE, max(_length(column), *_lengths(rows, index)))
        if index in prose
        else max(words[index], *_lengths(rows, index))
        for index, column in enumerate(columns)
    ]


def _parts(
    columns: Sequence[str], rows: Sequence[Sequence[str]], prose: Sequence[int], width: int
) -> Iterator[list[int]]:
    """Columns of each part of a table, all of which begin with the first column."""
    least = _least(columns, rows, prose)
    part = [0]
    for index in range(1, len(columns)):
        if len(part) > 1 and sum(least[each] + 2 for each in [*part, index]) - 1 > width:
            yield part
            part = [0]
        part.append(index)
    yield part


def _lengths(rows: Sequence[Sequence[str]], index: int) -> list[int]:
    return [0, *(_length(row[index]) for row in rows)]


def _length(text: str) -> int:
    """Length of the longest line."""
    return max(map(len, text.split("\n")))


def _lines(cell: str, width: int) -> list[str]:
    """Prose in lines of a width, where there is a place to break it."""
    lines = [""]
    for piece in _BREAKS.split(cell):
        if lines[-1] and len(lines[-1]) + len(piece.rstrip()) > width:
            lines.append("")
        lines[-1] += piece
    return [line.rstrip() for line in lines]
