"""A column of a progress bar: the amount done."""

from rich.progress import ProgressColumn, Task
from rich.text import Text


class Done(ProgressColumn):
    """Progress: amount done and, if known, the total."""

    def __init__(self, unit: str) -> None:
        super().__init__()
        self._unit = unit
        self._digits = 1 if unit == "s" else 0

    def render(self, task: Task) -> Text:
        """Return the text of a bar's task."""
        total = "" if task.total is None else f" / {task.total:.{self._digits}f}"
        return Text(f"{task.completed:.{self._digits}f}{total} {self._unit}")
