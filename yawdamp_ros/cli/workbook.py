"""Tables as spreadsheets."""

from collections.abc import Sequence
from pathlib import Path

from yawdamp_ros.cli.errors import UsageError

WIDEST = 40
"""Characters of the widest column."""


def save_workbook(rows: Sequence[Sequence[object]], path: str | Path) -> None:
    """Write a table with a row of headings, which stays in view and filters.

    Parameters
    ----------
    rows : sequence of sequence
        Rows; the first holds the headings.
    path : str or Path

    Raises
    ------
    UsageError
        If the file cannot be written.
    """
    from openpyxl import Workbook  # noqa: PLC0415 - an extra
    from openpyxl.styles import Font  # noqa: PLC0415
    from openpyxl.utils import get_column_letter  # noqa: PLC0415

    book = Workbook()
    sheet = book.active
    sheet.title = "measures"
    for row in rows:
        sheet.append(list(row))
    for cell in sheet[1]:
        cell.font = Font(bold=True)
    for number, column in enumerate(zip(*rows, strict=True), 1):
        longest = max(len(str(value)) for value in column if value is not None)
        sheet.column_dimensions[get_column_letter(number)].width = min(longest + 2, WIDEST)
    sheet.freeze_panes = "A2"
    sheet.auto_filter.ref = sheet.dimensions
    try:
        book.save(path)
    except OSError as error:
        message = f"{path}: cannot be written: {error.strerror}"
        raise UsageError(message) from error
