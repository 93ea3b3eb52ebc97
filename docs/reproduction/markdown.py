"""Numbers as Markdown, with no more digits than another machine would print alike."""

from collections.abc import Iterable, Sequence

import numpy as np

from yawdamp_ros.stepping import Response

QUANTITIES = {
    "yaw": ("yaw, rad", 3),
    "yaw_rate": ("yaw rate, rad/s", 3),
    "lateral_acceleration": ("lateral acceleration, m/s²", 2),
}


def table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Markdown table."""
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def number(value: float, digits: int) -> str:
    """Value with so many decimals, and no negative zero."""
    text = f"{value:.{digits}f}"
    return text.removeprefix("-") if float(text) == 0.0 else text


def eigenvalue(value: complex, digits: int = 4) -> str:
    """Eigenvalue, a pair by the one above the real axis."""
    real = number(value.real, digits)
    return f"{real} ± {abs(value.imag):.{digits}f}i" if value.imag else real


def ranges_row(label: str, values: np.ndarray, digits: int) -> list[str]:
    """Row of the least and greatest value of every column."""
    cells = [
        f"{number(low, digits)} to {number(high, digits)}"
        for low, high in zip(values.min(axis=0), values.max(axis=0), strict=True)
    ]
    return [label, *cells]


def ranges(runs: dict[str, Response], quantities: Iterable[str]) -> str:
    """Table of the least and greatest values that every unit reaches, by model."""
    (first, *_) = runs.values()
    rows = []
    for quantity in quantities:
        label, digits = QUANTITIES[quantity]
        for model, run in runs.items():
            name, *cells = ranges_row(label, getattr(run, quantity), digits)
            rows.append([name, model, *cells])
    return table(["", "model", *first.unit_names], rows)


def matrix(values: np.ndarray, printed: Sequence[Sequence[str]]) -> str:
    """Table of a matrix beside its printed entries, those that round otherwise in bold."""
    rows = []
    for row, texts in zip(values, printed, strict=True):
        cells = []
        for value, text in zip(row, texts, strict=True):
            decimals = len(text.partition(".")[2])
            half = 0.5 * 10.0**-decimals
            cells.append(text if abs(value - float(text)) <= half else f"**{text}** ({value:.{decimals}f})")
        rows.append(cells)
    return table([""] * len(rows[0]), rows)
