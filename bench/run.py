"""Every benchmark in one run: a table, and its figures as JSON. `make bench`."""

import json
import os
import platform
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

import pyperf
from rich.console import Console
from rich.table import Table

import nodes
from whole_run import simulated, steering_log, written_anew

HERE = Path(__file__).parent
HOUR = 3600
ROUNDS = 5


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


def in_process(directory: Path) -> list[Row]:
    """What pyperf measures, in rounds: whatever else the machine does for a while then slows all of it."""
    # One core for everybody: nothing here may win by a second one.
    threads = "OPENBLAS_NUM_THREADS"
    times: dict[str, list[float]] = {}
    for index in range(ROUNDS):
        results = directory / f"in_process_{index}.json"
        options = ["--quiet", f"--inherit-environ={threads}", "-o", str(results)]
        subprocess.run(  # noqa: S603 - this project's own script
            [sys.executable, str(HERE / "in_process.py"), *options],
            check=True,
            stdout=subprocess.DEVNULL,
            env={**os.environ, threads: "1"},
        )
        for benchmark in pyperf.BenchmarkSuite.load(str(results)):
            times.setdefault(benchmark.get_name(), []).extend(benchmark.get_values())

    def row(what: str, name: str, reference: str, wanted: str) -> Row:
        return Row(what, reference, times[name], times[reference], "s", wanted)

    return [
        row("scipy's lsim, 15 s of the interlink at 1 kHz", "lsim", "linear_response", ">= 20"),
        row("control's forced_response, the same", "forced_response", "linear_response", ">= 20"),
        row("lsim against a whole response, path and all units", "lsim", "respond", ""),
        row("one step of the node's stepper", "step", "matrix-vector product", "<= 2.5"),
        row("a sample of all outputs", "sample", "matrix-vector product", ""),
        row("100,000 eigenvalue problems in a sweep", "sweep", "eigvals", "<= 1.5"),
    ]


def of_runs(directory: Path) -> list[Row]:
    """`simulate` of an hour."""
    log = directory / "hour.csv"
    steering_log(log, HOUR)
    ours, least = [], []
    for index in range(2):
        run = directory / f"run_{index}"
        ours.append(simulated(log, run))
        least.append(written_anew(run, directory / f"copy_{index}.mcap"))
    what = f"simulate, an hour at 100 Hz ({HOUR / statistics.median(ours):.0f} times real time)"
    return [Row(what, "serialising and writing alone", ours, least, "s", "<= 1.15")]


def of_nodes(directory: Path) -> list[Row]:
    """The node beside the bare node."""
    peer = nodes.Peer()
    bare = [*nodes.BARE, "100"]

    def alternately(
        one: Callable[[], float], other: Callable[[], float], times: int
    ) -> tuple[list[float], list[float]]:
        pairs = [(one(), other()) for _ in range(times)]
        return [pair[0] for pair in pairs], [pair[1] for pair in pairs]

    starts = nodes.starts(peer, directory)
    loads = alternately(
        lambda: nodes.processor_time(peer, nodes.SIM, directory),
        lambda: nodes.processor_time(peer, bare, directory),
        3,
    )
    rates = alternately(
        lambda: nodes.highest_rate(nodes.sim_keeps_up, directory),
        lambda: nodes.highest_rate(nodes.bare_keeps_up, directory),
        1,
    )
    took = sorted(nodes.latencies(peer, directory))
    period = 0.01
    return [
        Row("processor time at 100 Hz, recording", "bare node", *loads, "cores", "<= 1.3"),
        Row("highest rate without a lost step", "bare node", *rates, "Hz", ">= 0.9"),
        Row(
            "steering to first output that shows it, 99th percentile",
            "one period",
            [took[int(0.99 * len(took))]],
            [period],
            "s",
            "<= 1.2",
        ),
        Row("start to first message", "bare node", *starts, "s", "<= 1.3"),
    ]


def of_memory(directory: Path) -> list[Row]:
    """The node's memory while it records ten minutes at 1 kHz."""
    after_one, after_ten = nodes.memory(directory)
    return [
        Row(
            "memory after 10 minutes at 1 kHz, recording",
            "after 1 minute",
            [after_ten],
            [after_one],
            "MB",
            "<= 1.05",
        )
    ]


def holds(row: Row) -> str:
    """Whether a ratio is as wanted; empty where nothing is."""
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
    """What all this ran on."""
    models = [
        line.split(":")[1].strip()
        for line in Path("/proc/cpuinfo").read_text().splitlines()
        if "model name" in line
    ]
    return f"{len(models)} cores of {models[0]}, Python {platform.python_version()}"


def main() -> None:
    """Measure everything, or the parts that are named; print the table, write bench/results.json."""
    parts = {"in_process": in_process, "runs": of_runs, "nodes": of_nodes}
    chosen = sys.argv[1:] or list(parts)
    parts["memory"] = of_memory
    rows: list[Row] = []
    with tempfile.TemporaryDirectory() as directory:
        for name in chosen:
            found = parts[name](Path(directory))
            for row in found:
                print(f"{row.what}: {row.ratio:.3g} times {row.against}", flush=True)
            rows += found
    table = Table("what", "figure", "against", "figure", "ratio", "wanted", "met", title=machine())
    for row in rows:
        table.add_row(
            row.what,
            figure(row.value, row.unit),
            row.against,
            figure(row.reference, row.unit),
            f"{row.ratio:.3g}",
            row.wanted,
            holds(row),
        )
    Console(width=160).print(table)
    results = {"machine": machine(), "rows": [row._asdict() | {"ratio": row.ratio} for row in rows]}
    (HERE / f"results{'_memory' if chosen == ['memory'] else ''}.json").write_text(
        json.dumps(results, indent=2) + "\n", encoding="utf-8"
    )


if __name__ == "__main__":
    main()
