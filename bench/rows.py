"""Results of benchmarks: one thing measured against another in the same run."""

import platform
import statistics
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple


class Row(NamedTuple):
    """One thing measured against another in the same run.

    Attributes
    ----------
    what, against : str
    value, reference : list of float
        Repetitions, of the same number.
    unit : str
    wanted : str
        Of the ratio.
    """

    what: str
    against: str
    value: list[float]
    reference: list[float]
    unit: str
    wanted: str

    @property
    def ratio(self) -> float:
        """Median over median."""
        return statistics.median(self.value) / statistics.median(self.reference)


def by_turns(
    one: Callable[[], float], other: Callable[[], float], times: int
) -> tuple[list[float], list[float]]:
    """Figures of two things, taken by turns: whatever else the machine does then slows both."""
    pairs = [(one(), other()) for _ in range(times)]
    return [pair[0] for pair in pairs], [pair[1] for pair in pairs]


def holds(row: Row) -> str:
    """Return whether a ratio keeps its limit; empty where there is none."""
    if not row.wanted:
        return ""
    sign, limit = row.wanted.split()
    met = row.ratio >= float(limit) if sign == ">=" else row.ratio <= float(limit)
    return "yes" if met else "no"


def figure(values: Sequence[float], unit: str) -> str:
    """Median and, of three values or more, half the range between the quartiles."""
    scale, unit = (1e6, "us") if unit == "s" and statistics.median(values) < 1e-3 else (1.0, unit)  # noqa: PLR2004
    scale, unit = (1e3, "ms") if unit == "s" and statistics.median(values) < 1.0 else (scale, unit)
    spread = ""
    if len(values) > 2:  # noqa: PLR2004
        low, _, high = statistics.quantiles(values, n=4)
        spread = f" ± {scale * (high - low) / 2:.2g}"
    return f"{scale * statistics.median(values):.4g}{spread} {unit}"


def machine() -> str:
    """Name the machine and its versions."""
    models = [
        line.split(":")[1].strip()
        for line in Path("/proc/cpuinfo").read_text().splitlines()
        if "model name" in line
    ]
    return f"{len(models)} cores of {models[0]}, Python {platform.python_version()}"
